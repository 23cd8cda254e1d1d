//! What the filter of [`super::triangle_block`] knows of a ray, and how wrong it may be.
//!
//! Error bounds, with u = 2⁻²⁴, M ≥ |vertex − origin|∞, D = |d|∞, E = largest |e₁|∞, |e₂|∞ of the
//! lane, which is at most 2M. Differences carry u of their size, products and sums their own
//! roundings; counting all of them in the worst case:
//!
//! | quantity | size at most | error at most | taken |
//! |---|---|---|---|
//! | c×d·e (two weights) | 6·M·D·E | 42u·M·D·E | 64u·M·D·E |
//! | n·d, n = e₁×e₂ | 6·D·E² | 42u·D·E² | 64u·D·E² |
//! | third weight, n·d less the others | 24·M·D·E | 216u·M·D·E | 256u·M·D·E |
//! | n·c − t·(n·d), for \|t\|·D ≤ 1.01·M | 13·M·E² | 120u·M·E² | 256u·M·E² |
//!
//! and to each the floor 2⁻¹²⁰·max(1, M, D)² for underflow, which loses 2⁻¹⁴⁹ at a time (a floor
//! below 2⁻¹²⁶ would cost a hundred cycles for being subnormal). Of the third weight a quarter is
//! computed, which is exact, to be held against the other weights' bound.
//! Overflow and NaN compare false, and so keep the lane.

use crate::math::{Bounds, Interval, Vec3A};
use crate::ray::Ray;
use crate::simd::{Floats, Select, Simd};

const UNIT: f32 = 1.0 / (1 << 24) as f32;

/// What part of [`Errors::reach`] the margin is; see [`Errors::margin`].
pub const MARGIN: f32 = 1.0 / (1 << 20) as f32;

/// A ray prepared for [`TriangleBlock::judge`](super::triangle_block::TriangleBlock::judge).
#[derive(Clone, Copy, Debug)]
pub struct Filter {
    /// The ray's origin.
    pub origin: [f32; 3],
    /// Its direction.
    pub direction: [f32; 3],
    /// How wrong the filter may be.
    pub errors: Errors,
}

/// What bounds the errors of the filter for one ray.
#[derive(Clone, Copy, Debug)]
pub struct Errors {
    /// Where the ray has left the bounds for certain, in units of t; never NaN.
    pub reach: f32,
    /// 64u·M·D, to be multiplied with E.
    pub weight: f32,
    /// 64u·D, to be multiplied with E².
    pub along: f32,
    /// 256u·M, to be multiplied with E².
    pub depth: f32,
    /// Of underflow.
    pub floor: f32,
}

impl Filter {
    /// Prepares a usable ray for triangles that lie within `bounds`.
    #[inline(always)]
    pub fn new(ray: &Ray, bounds: &Bounds) -> Self {
        let origin = Vec3A::from(ray.origin);
        let sides = (Vec3A::from(bounds.min) - origin).abs().max((Vec3A::from(bounds.max) - origin).abs());
        let step = Vec3A::from(ray.direction).abs().max_element();
        Self {
            origin: ray.origin.to_array(),
            direction: ray.direction.to_array(),
            errors: Errors::new(sides.max_element(), step),
        }
    }

    /// The part of the interval in which the triangles are.
    #[inline(always)]
    pub(super) fn clamp(&self, interval: Interval) -> (f32, f32) {
        (interval.min.max(-self.errors.reach), interval.max.min(self.errors.reach))
    }
}

impl Errors {
    /// For a ray whose direction has no component above `step`, and whose origin is no farther
    /// than `far` from any triangle, along any axis, both as `f32` arithmetic has them.
    #[inline(always)]
    pub fn new(far: f32, step: f32) -> Self {
        let far = far * (1.0 + 4.0 * UNIT);
        let larger = if far > step { far } else { step };
        let largest = if larger > 1.0 { larger } else { 1.0 };
        Self {
            reach: far / step * 1.001,
            weight: 64.0 * UNIT * far * step,
            along: 64.0 * UNIT * step,
            depth: 256.0 * UNIT * far,
            floor: largest * largest * 2f32.powi(-120),
        }
    }

    /// Of rays side by side, in the order of the fields.
    #[inline(always)]
    pub fn abreast<S: Simd, V: Floats<S>>(simd: S, far: V, step: V) -> [V; 5] {
        let of = |x: f32| V::splat(simd, x);
        let far = far * of(1.0 + 4.0 * UNIT);
        let larger = far.simd_gt(step).select(far, step);
        let largest = larger.simd_gt(of(1.0)).select(larger, of(1.0));
        let weight = of(64.0 * UNIT) * far * step;
        let floor = largest * largest * of(2f32.powi(-120));
        [far / step * of(1.001), weight, of(64.0 * UNIT) * step, of(256.0 * UNIT) * far, floor]
    }

    /// By how much of t two hits must differ for their order to be certain, beside the rounding
    /// of t itself; as [`crate::shape::ExactRay::margin`], but not smaller.
    #[inline(always)]
    pub fn margin(&self) -> f32 {
        self.reach * MARGIN
    }
}
