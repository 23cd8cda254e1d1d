//! Up to eight rays side by side.

use common::math::Vec3;
use common::math::lanes::{Vectors, store};
use common::ray::Ray;
use common::simd::{Simd, SimdBase, f32x4, f32x8};

/// Rays side by side.
pub const RAYS: usize = 8;

/// As many rays are turned at a time.
const HALF: usize = RAYS / 2;

/// The rays, one axis after the other, as planes and balls beside the tree see them.
pub struct Abreast {
    /// Origins, by axis.
    pub origin: [[f32; RAYS]; 3],
    /// Directions, by axis.
    pub direction: [[f32; RAYS]; 3],
    /// What they leave.
    pub home: [u32; RAYS],
}

impl Abreast {
    /// One to eight rays; unused places hold rays without a direction, which hit nothing.
    #[inline(always)]
    pub fn of<S: Simd>(simd: S, rays: &[Ray]) -> Self {
        let padded;
        let rays = match rays.first_chunk() {
            Some(all) => all,
            None => {
                padded = pad(rays, Ray::new(Vec3::ZERO, Vec3::ZERO));
                &padded
            }
        };
        let [origin, direction] = columns(simd, rays);
        let mut home = [Ray::ANYWHERE; RAYS];
        for (home, ray) in home.iter_mut().zip(rays) {
            *home = ray.home;
        }
        Self { origin: store(origin), direction: store(direction), home }
    }
}

/// Fewer rays and as many of another as make eight.
#[inline(always)]
pub fn pad(rays: &[Ray], filler: Ray) -> [Ray; RAYS] {
    let mut padded = [filler; RAYS];
    padded[..rays.len()].copy_from_slice(rays);
    padded
}

/// Origins and directions of eight rays.
#[inline(always)]
pub fn columns<S: Simd>(simd: S, rays: &[Ray; RAYS]) -> [Vectors<f32x8<S>>; 2] {
    let (low, high) = (coordinates(simd, &rays[..HALF]), coordinates(simd, &rays[HALF..]));
    let both = |column: usize| simd.combine_f32x4(low[column], high[column]);
    [[both(0), both(1), both(2)], [both(3), both(4), both(5)]]
}

/// The six coordinates of four rays, each in its vector: what lies side by side in memory is loaded
/// at once, and turned in registers.
#[inline(always)]
fn coordinates<S: Simd>(simd: S, rays: &[Ray]) -> [f32x4<S>; 6] {
    let front = |i: usize| {
        let Ray { origin: o, direction: d, .. } = &rays[i];
        f32x4::from_slice(simd, &[o.x, o.y, o.z, d.x])
    };
    let back = |i: usize| {
        let Ray { origin: o, direction: d, .. } = &rays[i];
        f32x4::from_slice(simd, &[o.z, d.x, d.y, d.z])
    };
    let [ox, oy, oz, dx] = turn(simd, [front(0), front(1), front(2), front(3)]);
    let [_, _, dy, dz] = turn(simd, [back(0), back(1), back(2), back(3)]);
    [ox, oy, oz, dx, dy, dz]
}

/// Four vectors of four numbers, turned so that the first numbers make one vector, and so on.
#[inline(always)]
pub fn turn<S: Simd>(simd: S, [a, b, c, d]: [f32x4<S>; 4]) -> [f32x4<S>; 4] {
    let (even, odd) = (simd.zip_low_f32x4(a, c), simd.zip_low_f32x4(b, d));
    let (first, second) = (simd.zip_low_f32x4(even, odd), simd.zip_high_f32x4(even, odd));
    let (even, odd) = (simd.zip_high_f32x4(a, c), simd.zip_high_f32x4(b, d));
    [first, second, simd.zip_low_f32x4(even, odd), simd.zip_high_f32x4(even, odd)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use common::simd::{by_name, dispatch};

    #[test]
    fn rays_are_turned_on_all_levels() {
        let number = |i: usize| Vec3::new(i as f32, i as f32 + 0.25, i as f32 + 0.5);
        let rays: [Ray; RAYS] =
            std::array::from_fn(|i| Ray::leaving(100 + i as u32, number(i), number(10 + i)));
        let levels = || ["baseline", "sse4", "avx2", "avx512"].into_iter().filter_map(by_name);
        for (len, level) in (1..=RAYS).flat_map(|len| levels().map(move |level| (len, level))) {
            let abreast = dispatch!(level, s => s.vectorize(
                #[inline(always)]
                || Abreast::of(s, &rays[..len]),
            ));
            for (lane, ray) in rays.into_iter().enumerate() {
                let nowhere = Ray::new(Vec3::ZERO, Vec3::ZERO);
                let expected = if lane < len { ray } else { nowhere };
                let origin: [f32; 3] = std::array::from_fn(|axis| abreast.origin[axis][lane]);
                let direction: [f32; 3] = std::array::from_fn(|axis| abreast.direction[axis][lane]);
                let found = Ray::leaving(abreast.home[lane], origin.into(), direction.into());
                assert_eq!(found, expected, "{len} {lane}");
            }
        }
    }
}
