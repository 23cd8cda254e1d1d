//! Triangles for tests: of all sizes, all over a cube.

use crate::collapse::build::build;
use crate::collapse::surface::Surface;
use common::math::Vec3;

/// Numbers from 0 to 1 by a multiplicative generator, always the same.
pub(super) fn random() -> impl FnMut() -> f32 {
    let mut state = 1u32;
    move || {
        state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        (state >> 8) as f32 / (1 << 24) as f32
    }
}

/// So many triangles that share no corners.
pub(super) fn scattered(count: u32, random: &mut impl FnMut() -> f32) -> Surface {
    let mut point = |size: f32| Vec3::new(random(), random(), random()) * size;
    let triangle = |i: u32| {
        let (at, size) = (point(1.0), 0.5f32.powi(i as i32 % 8));
        [at, at + point(size), at + point(size)]
    };
    let places: Vec<Vec3> = (0..count).flat_map(triangle).collect();
    build(&places, (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2])).surface
}
