//! Rays that meet slabs, the spaces between two opposite sides of a box (Kay & Kajiya 1986).
//!
//! Where a ray meets a side is computed in single precision and widened by a bound of the error,
//! so that a box is passed by only if the exact ray passes it by. With u = 2⁻²⁴, sides |s| ≤ B
//! and origin o along one axis, s·i − o·i carries at most u·(B + |o|)·|i| from the inverse, the
//! two products and the difference each; 8u·(B + |o|)·|i| is taken, and folded into o·i once for
//! each ray.

use common::simd::{Select, Simd, SimdBase, SimdFloat, f32x8};

/// Beyond these sizes products could overflow; such rays visit everything.
pub const ORDINARY: f32 = (1u128 << 100) as f32;

/// Largest product of a length and an inverse: far beyond any t, far below overflow.
const LARGEST: f32 = ORDINARY * (1u64 << 20) as f32;

/// Eight slabs and the rays that meet them.
pub struct Slabs<S: Simd> {
    /// Inverse of the direction; large but finite where the ray runs along the slab.
    pub inverse: f32x8<S>,
    /// Bound of the error of where the ray meets a side, in units of t.
    pub error: f32x8<S>,
    /// Origin times inverse, made larger by the error …
    pub near_offset: f32x8<S>,
    /// … and smaller.
    pub far_offset: f32x8<S>,
    /// Distance of the farther side from the origin.
    pub far: f32x8<S>,
}

impl<S: Simd> Slabs<S> {
    /// For origins `o`, directions `d` and sides `min` and `max`, lane by lane.
    #[inline(always)]
    pub fn new(simd: S, o: f32x8<S>, d: f32x8<S>, min: f32x8<S>, max: f32x8<S>) -> Self {
        let size = min.abs().max(max.abs()) + o.abs();
        // A ray along the slab has no inverse. A large one does for it if the result is widened
        // by more than all of the ray that matters.
        let least = size.max(f32x8::splat(simd, 1.0)) * f32x8::splat(simd, 1.0 / LARGEST);
        let along = d.abs().simd_lt(least);
        let inverse = (f32x8::splat(simd, 1.0) / d.abs().max(least)).copysign(d);
        let widened = along.select(f32x8::splat(simd, 2.0 * ORDINARY), f32x8::splat(simd, f32::MIN_POSITIVE));
        let error = (size * inverse.abs()).mul_add(f32x8::splat(simd, 2f32.powi(-21)), widened);
        let near_offset = o.mul_add(inverse, error);
        let far_offset = o.mul_sub(inverse, error);
        let far = (min - o).abs().max((max - o).abs());
        Self { inverse, error, near_offset, far_offset, far }
    }
}
