//! Balls in double precision: one ray after the other, or eight side by side with the same bits.

use super::abreast::Abreast;
use super::balls::MOST;
use common::counters::Counters;
use common::geometry::{Geometry, Hit, SolidShape};
use common::math::Interval;
use common::math::lanes::{add, each, load, multiply, narrow, scale, subtract, sum3, widen};
use common::ray::Ray;
use common::shape::ExactRay;
use common::simd::{Select, Simd, SimdBase, SimdFloat, f32x8, f64x8};

/// The numbers of the bits that are set.
#[inline(always)]
pub fn places_of(bits: u32) -> impl Iterator<Item = u32> {
    (0..MOST as u32).filter(move |place| bits >> place & 1 == 1)
}

/// Where each of eight rays first meets the ball at `place` inside an interval, as
/// [`Geometry::hit_solid`] finds it, and the ball's number; NaN for those that do not, or are no rays.
#[inline(always)]
pub fn all_met<S: Simd>(
    simd: S,
    geometry: &Geometry,
    place: usize,
    rays: &Abreast,
    interval: Interval,
) -> (f32x8<S>, u32) {
    let solid = &geometry.solids()[place];
    let SolidShape::Sphere(ball) = &solid.shape else {
        return (f32x8::splat(simd, f32::NAN), solid.primitive);
    };
    let of = |x: f64| f64x8::splat(simd, x);
    let (origin, direction) = (load(simd, &rays.origin), load(simd, &rays.direction));
    let usable = Ray::are_usable(simd, origin, direction);
    let origin = each(origin, |x| widen(simd, x));
    let direction = each(direction, |x| widen(simd, x));
    let length_squared = sum3(multiply(direction, direction));
    let center = [of(ball.center.x), of(ball.center.y), of(ball.center.z)];
    let (radius, zero) = (of(ball.radius), of(0.0));
    let to_origin = subtract(origin, center);
    let closest = -sum3(multiply(to_origin, direction)) / length_squared;
    let offset = add(to_origin, scale(direction, closest));
    let distance_squared = sum3(multiply(offset, offset));
    let inside = distance_squared.simd_le(radius * radius);
    let distance = distance_squared.sqrt();
    let gap = radius - distance;
    let gap = gap.simd_gt(zero).select(gap, zero);
    let half_chord = (gap * (radius + distance) / length_squared).sqrt();
    let (none, min, max) =
        (f32x8::splat(simd, f32::NAN), f32x8::splat(simd, interval.min), f32x8::splat(simd, interval.max));
    let counts = |t: f64x8<S>, instead: f32x8<S>| {
        let t = narrow(simd, inside.select(t, of(f64::NAN)));
        (t.simd_gt(min) & t.simd_lt(max)).select(t, instead)
    };
    let t = counts(closest - half_chord, counts(closest + half_chord, none));
    (usable.select(t, none), solid.primitive)
}

/// The better of `best` and the first hit among solids at these places.
pub fn nearest_of(
    geometry: &Geometry,
    places: impl Iterator<Item = u32>,
    ray: &Ray,
    interval: Interval,
    best: Option<Hit>,
    c: &mut Counters,
) -> Option<Hit> {
    if !ray.is_usable() {
        return best;
    }
    geometry.nearest_solid(places, &ExactRay::new(ray), interval, best, c)
}

/// Whether any of the solids at these places is hit.
pub fn any_of(
    geometry: &Geometry,
    places: impl Iterator<Item = u32>,
    ray: &Ray,
    interval: Interval,
    c: &mut Counters,
) -> bool {
    ray.is_usable() && geometry.any_solid(places, &ExactRay::new(ray), interval, c)
}
