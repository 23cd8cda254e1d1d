//! Up to eight rays side by side.

use common::geometry::Hit;
use common::math::Vec3;
use common::math::lanes::{Vectors, store};
use common::ray::Ray;
use common::simd::{Select, Simd, SimdBase, f32x8, u32x8};

/// Rays side by side.
pub const RAYS: usize = 8;

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
        let [origin, direction] = columns(simd, rays, Ray::new(Vec3::ZERO, Vec3::ZERO));
        let mut home = [Ray::ANYWHERE; RAYS];
        for (home, ray) in home.iter_mut().zip(rays) {
            *home = ray.home;
        }
        Self { origin: store(origin), direction: store(direction), home }
    }
}

/// First hits of eight rays among what has no weights; t is infinite where there is none.
pub struct Firsts {
    /// Where.
    pub t: [f32; RAYS],
    /// What is hit.
    pub primitive: [u32; RAYS],
}

impl Firsts {
    /// None yet.
    pub const NONE: Self = Self { t: [f32::INFINITY; RAYS], primitive: [0; RAYS] };

    /// That of one ray.
    #[inline(always)]
    pub fn hit(&self, lane: usize) -> Option<Hit> {
        let hit = Hit { t: self.t[lane], primitive: self.primitive[lane], u: 0.0, v: 0.0 };
        (hit.t < f32::INFINITY).then_some(hit)
    }

    /// Takes the better of what is there and of where the rays meet one primitive, NaN for those that do not.
    #[inline(always)]
    pub fn take<S: Simd>(&mut self, simd: S, t: f32x8<S>, primitive: u32) {
        let (first, number) = (f32x8::from_slice(simd, &self.t), u32x8::from_slice(simd, &self.primitive));
        let this = u32x8::splat(simd, primitive);
        let better = t.simd_lt(first) | t.simd_eq(first) & this.simd_lt(number);
        better.select(t, first).store_slice(&mut self.t);
        better.select(this, number).store_slice(&mut self.primitive);
    }
}

/// [`Ray::columns`] of one to eight rays; unused places hold another.
#[inline(always)]
pub fn columns<S: Simd>(simd: S, rays: &[Ray], filler: Ray) -> [Vectors<f32x8<S>>; 2] {
    let padded;
    let rays: &[Ray; RAYS] = match rays.first_chunk() {
        Some(all) => all,
        None => {
            let mut some = [filler; RAYS];
            some[..rays.len()].copy_from_slice(rays);
            padded = some;
            &padded
        }
    };
    Ray::columns(simd, rays.each_ref())
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
