//! Property 10: far from the origin.

use super::any_interval;
use crate::Stress;
use crate::kit::{agree, aim, geometry_of, lumpy_sphere, structures};
use a5_grid::Fit;
use common::accel::List;
use common::math::Vec3;

/// Meshes far away and of any size, where the grid's planes and the triangles' corners are both
/// coarse.
pub fn far_away(stress: &Stress) {
    let far = Vec3::new(148_376.0, 1234.0, -223_423.0);
    let mut places = [1e-6f32, 1.0, 1e6, 2f32.powi(60), 2f32.powi(-60)].map(|s| (s, Vec3::ZERO)).to_vec();
    places.extend([(16.0, far), (1000.0, far), (1000.0, Vec3::splat(1e7)), (1e6, far * 10.0)]);
    for (scale, offset) in places {
        let mesh = lumpy_sphere(2, 21);
        let place = |i: &u32| mesh.positions[*i as usize] * scale + offset;
        let triangles: Vec<_> =
            mesh.triangles.iter().map(|t| [place(&t[0]), place(&t[1]), place(&t[2])]).collect();
        let geometry = geometry_of(&triangles);
        let around = geometry.bounds().expect("finite");
        let list = List::new(&geometry);
        let others = structures(&geometry, &[[1, 1, 1], [10, 7, 3], [33, 32, 31]].map(|n| (n, Fit::Exact)));
        let margin = (around.size() * 2.0).max(around.max.abs() * 1e-6);
        stress.run(format!("p10 × {scale:e} + {offset}"), 1002, 10_000, |draw| {
            let origin = draw.point(around.min - margin, around.max + margin);
            let ray = aim(draw, &triangles, origin);
            let unit = ray.direction.length();
            let interval = any_interval(draw, around.size().max_element() / unit);
            agree(&list, &others, &ray, interval)
        });
    }
}
