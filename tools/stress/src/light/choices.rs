//! Property 13 for trees of lights: which light is asked.

use super::chi::Family;
use super::lights::sample_count;
use crate::Stress;
use crate::kit::Draw;
use a8_path_tracing::light::{Cluster, Leaf, LightTree, Receiver};
use common::math::{Bounds, Vec3};

fn cluster(draw: &mut Draw) -> Cluster {
    let low = draw.point(Vec3::splat(-3.0), Vec3::splat(3.0));
    let size = draw.point(Vec3::ZERO, Vec3::ONE);
    let power = draw.magnitude(-3.0, 3.0) as f32;
    let (axis, cos_spread) =
        if draw.chance(0.5) { (draw.direction().as_vec3(), 1.0 - 1e-6) } else { (Vec3::Z, -1.0) };
    Cluster { bounds: Bounds { min: low, max: low + size }, power, axis, cos_spread }
}

/// Trees choose lights as often as they say.
pub fn trees(stress: &Stress) {
    stress.case("p13 choices of light trees, χ²", || {
        let mut family = Family::default();
        let (mut draw, samples) = (stress.draw(0xa819), sample_count(stress));
        for count in [1u32, 2, 3, 17, 100, 1000] {
            let leaves = (0..count).map(|light| Leaf { light, cluster: cluster(&mut draw) }).collect();
            let tree = LightTree::new(leaves, count as usize);
            for place in 0..4 {
                let at = Receiver {
                    point: draw.point(Vec3::splat(-9.0), Vec3::splat(9.0)),
                    normal: draw.direction().as_vec3(),
                };
                let due: Vec<f64> = (0..count).map(|light| f64::from(tree.probability(&at, light))).collect();
                let mut counts = vec![0u64; count as usize + 1];
                for _ in 0..samples {
                    match tree.choose(&at, draw.unit()) {
                        None => counts[count as usize] += 1,
                        Some((light, probability, rest)) => {
                            counts[light as usize] += 1;
                            let said = due[light as usize];
                            assert!(
                                (f64::from(probability) / said - 1.0).abs() < 1e-5,
                                "{probability} {said}"
                            );
                            assert!((0.0..1.0).contains(&rest));
                        }
                    }
                }
                // On the way down it may turn out that no light of a group reaches the point.
                let sum: f64 = due.iter().sum();
                assert!(sum <= 1.0 + 1e-5, "{sum}");
                let nothing = (1.0 - sum).max(0.0);
                let due: Vec<f64> =
                    due.iter().copied().chain([nothing]).map(|p| p * samples as f64).collect();
                family.test(format!("{count} lights, place {place}"), &counts, &due);
            }
        }
        family.judge()
    });
}
