//! Eight pairs beside one.

use super::*;
use crate::math::Vec3;
use crate::math::lanes::load;
use crate::shape::ExactRay;
use crate::shape::triangle::{TriangleHit, intersect};
use crate::simd::{by_name, dispatch};
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Coordinates of some sizes, or on a coarse raster, where lines meet edges and corners.
fn vector(random: &mut Pcg64Mcg, raster: bool) -> Vec3 {
    Vec3::from_array(std::array::from_fn(|_| {
        let number = random.next_u32();
        if raster { (number % 5) as f32 - 2.0 } else { number as f32 / u32::MAX as f32 - 0.5 }
    }))
}

#[test]
fn a6t2_what_is_decided_for_eight_has_the_bits_of_one() {
    let mut random = Pcg64Mcg::seed_from_u64(5);
    let (mut decided, mut inside, mut all) = (0, 0, 0);
    for round in 0..4000 {
        let (raster, thin) = (round % 4 == 0, if round % 8 == 1 { 1e-9 } else { 1.0 });
        let triangles: [[Vec3; 3]; LANES] = std::array::from_fn(|_| {
            let [a, b, c] = std::array::from_fn(|_| vector(&mut random, raster));
            [a, b, a + (c - a) * thin]
        });
        let rays: [Ray; LANES] = std::array::from_fn(|lane| {
            let (origin, within) = (vector(&mut random, raster), vector(&mut random, raster).abs() / 2.0);
            let [a, b, c] = triangles[lane];
            let towards = a + (b - a) * within.x + (c - a) * within.y - origin;
            Ray::new(
                origin,
                if raster && towards != Vec3::ZERO { towards } else { towards * 0.3 + Vec3::splat(1e-3) },
            )
        });
        let corners: Corners = std::array::from_fn(|corner| {
            std::array::from_fn(|axis| std::array::from_fn(|lane| triangles[lane][corner][axis]))
        });
        for level in ["baseline", "sse4", "avx2", "avx512"].into_iter().filter_map(by_name) {
            let eight = dispatch!(level, s => {
                intersect_eight(s, rays.each_ref(), corners.each_ref().map(|v| load(s, v)))
            });
            for (lane, ray) in rays.iter().enumerate().filter(|(_, ray)| ray.is_usable()) {
                all += 1;
                if eight.decided >> lane & 1 == 0 {
                    continue;
                }
                decided += 1;
                let found = eight.hit(lane);
                let expected = intersect(&ExactRay::new(ray), &triangles[lane]);
                let bits = |hit: TriangleHit| [hit.t, hit.u, hit.v].map(f32::to_bits);
                assert_eq!(found.map(bits), expected.map(bits), "{ray:?} {:?}", triangles[lane]);
                inside += usize::from(found.is_some());
            }
        }
    }
    assert!(
        decided > all / 2 && decided < all && inside > all / 4,
        "{decided} decided, {inside} inside of {all}"
    );
}
