//! Property 2: the instructions do not matter.

use super::from_inside;
use super::passages::Blocks;
use super::placed::placements;
use crate::Stress;
use crate::kit::{lattice_sphere, placed, ray_bits, simd_levels};
use common::geometry::Hit;
use common::math::Interval;
use common::shape::ExactRay;

/// The filter may keep what it likes, but the nearest hit has the scalar kernel's bits.
pub fn instructions(stress: &Stress) {
    let levels = simd_levels();
    assert!(!levels.is_empty());
    // A lattice: half of the rays meet a corner or an edge exactly.
    let mesh = lattice_sphere(2, 2);
    for (scale, offset) in placements() {
        let place = placed(&mesh, scale, offset, 32);
        let blocks = Blocks::new(&place.triangles);
        stress.run(format!("p02 levels, × {scale:.1e} + {offset:.0}"), 202, 2_000, |draw| {
            let ray = from_inside(draw, &place.triangles, &place.inside);
            let exact = ExactRay::new(&ray);
            let mut best: Option<Hit> = None;
            for (i, t) in (0u32..).zip(&place.triangles) {
                let hit = common::geometry::hit_triangle(t, i, &exact, Interval::FORWARD);
                best = hit.filter(|h| h.precedes(best.as_ref())).or(best);
            }
            match levels.iter().find(|(_, level)| blocks.nearest(*level, &ray) != best) {
                None => Ok(0.0),
                Some((name, _)) => Err(format!("{name} differs from {best:?}\n{}", ray_bits(&ray))),
            }
        });
    }
}
