//! Planes and discs, eight rays at a time.
//!
//! The arithmetic is that of [`common::shape::plane::intersect`], step by step: without fused
//! operations, so that side by side every ray gets the bits that it would get alone.

use super::abreast::{Abreast, Firsts, RAYS};
use common::counters::Counters;
use common::geometry::{Geometry, Sheet};
use common::math::Interval;
use common::math::lanes::{Vectors, each, load, multiply, narrow, sum3, widen};
use common::ray::Ray;
use common::shape::ExactRay;
use common::shape::plane::Plane;
use common::simd::{Select, Simd, SimdBase, SimdMask, f32x8, f64x8, mask32x8, u32x8};

/// Rays widened, one axis after the other.
struct Widened<S: Simd> {
    origin: Vectors<f64x8<S>>,
    direction: Vectors<f64x8<S>>,
    /// Those that can hit anything at all.
    usable: mask32x8<S>,
    /// What they leave.
    home: u32x8<S>,
}

impl<S: Simd> Widened<S> {
    /// Of rays side by side.
    #[inline(always)]
    fn of(simd: S, rays: &Abreast) -> Self {
        let (origin, direction) = (load(simd, &rays.origin), load(simd, &rays.direction));
        Self {
            origin: each(origin, |x| widen(simd, x)),
            direction: each(direction, |x| widen(simd, x)),
            usable: Ray::are_usable(simd, origin, direction),
            home: u32x8::from_slice(simd, &rays.home),
        }
    }

    /// Where each ray crosses a plane without a rim, rounded once; what is no number in the range
    /// of single precision, or not even that, lies in no interval.
    #[inline(always)]
    fn crossings(&self, simd: S, plane: &Plane) -> f32x8<S> {
        let of = |x: f64| f64x8::splat(simd, x);
        let normal = [of(plane.normal.x), of(plane.normal.y), of(plane.normal.z)];
        let start = sum3(multiply(normal, self.origin));
        narrow(simd, (of(plane.offset) - start) / sum3(multiply(normal, self.direction)))
    }

    /// Which rays may hit a sheet: those that can hit anything, and leave another.
    #[inline(always)]
    fn asked(&self, simd: S, sheet: &Sheet) -> mask32x8<S> {
        self.usable & !self.home.simd_eq(u32x8::splat(simd, sheet.primitive))
    }

    /// Where each ray meets one of the sheets inside an interval; NaN where it does not.
    #[inline(always)]
    fn meet(&self, simd: S, rays: &[Ray], geometry: &Geometry, index: usize, interval: Interval) -> f32x8<S> {
        let sheet = &geometry.sheets()[index];
        let plane = &sheet.plane;
        let asked = self.asked(simd, sheet);
        if plane.disc.is_some() {
            let (mut t, asked) = ([f32::NAN; RAYS], asked.to_bitmask());
            for (lane, ray) in rays.iter().enumerate().filter(|(lane, _)| asked >> lane & 1 == 1) {
                let hit = geometry.hit_sheet(index, &ExactRay::new(ray), interval);
                t[lane] = hit.map_or(f32::NAN, |hit| hit.t);
            }
            return f32x8::from_slice(simd, &t);
        }
        let t = self.crossings(simd, plane);
        let of = |x: f32| f32x8::splat(simd, x);
        (asked & t.simd_gt(of(interval.min)) & t.simd_lt(of(interval.max))).select(t, of(f32::NAN))
    }
}

/// Whether none of the rays can meet any plane or disc: there is none, or all leave the only one.
#[inline(always)]
pub fn all_leave(sheets: &[Sheet], rays: &[Ray]) -> bool {
    match sheets {
        [] => true,
        [only] => rays.iter().all(|ray| ray.home == only.primitive),
        _ => false,
    }
}

/// Takes the better of what is there and the first hit of each of up to eight rays among planes and
/// discs, as [`Geometry::nearest_sheet`] finds it.
#[inline(always)]
pub fn nearest<S: Simd>(
    simd: S,
    geometry: &Geometry,
    (rays, abreast): (&[Ray], &Abreast),
    interval: Interval,
    firsts: &mut Firsts,
    c: &mut Counters,
) {
    let wide = Widened::of(simd, abreast);
    for (index, sheet) in geometry.sheets().iter().enumerate() {
        c.intersections += u64::from(wide.asked(simd, sheet).to_bitmask().count_ones());
        firsts.take(simd, wide.meet(simd, rays, geometry, index, interval), sheet.primitive);
    }
}

/// Whether each of up to eight rays hits any plane or disc, as [`Geometry::any_sheet`] finds it.
#[inline(always)]
pub fn any<S: Simd>(
    simd: S,
    geometry: &Geometry,
    (rays, abreast): (&[Ray], &Abreast),
    interval: Interval,
    hit: &mut [bool],
    c: &mut Counters,
) {
    let wide = Widened::of(simd, abreast);
    let mut blocked = 0;
    for (index, sheet) in geometry.sheets().iter().enumerate() {
        let t = wide.meet(simd, rays, geometry, index, interval);
        c.intersections += u64::from((wide.asked(simd, sheet).to_bitmask() & !blocked).count_ones());
        blocked |= t.simd_eq(t).to_bitmask();
    }
    for (lane, hit) in hit.iter_mut().enumerate() {
        *hit = blocked >> lane & 1 == 1;
    }
}
