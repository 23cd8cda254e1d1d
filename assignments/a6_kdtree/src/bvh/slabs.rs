//! A ray against the eight boxes of a node (the slab test of Kay & Kajiya 1986).
//!
//! Where the ray meets a side is computed in single precision and widened by a bound of the
//! error, so that a box is passed by only if the exact ray passes it by. With u = 2⁻²⁴, sides
//! |s| ≤ B and origin o along one axis, s·i − o·i carries at most u·(B + |o|)·|i| from the
//! inverse, the two products and the difference each; 8u·(B + |o|)·|i| is taken, and folded into
//! o·i once for each ray.

use super::wide::{WIDTH, WideNode};
use common::math::{Bounds, Interval, Vec3A};
use common::ray::Ray;
use common::simd::{Simd, SimdBase, SimdFloat, SimdMask, f32x8};

/// Beyond these sizes products could overflow; such rays visit everything.
const ORDINARY: f32 = (1u128 << 100) as f32;

/// Largest product of a length and an inverse: far beyond any t, far below overflow.
const LARGEST: f32 = ORDINARY * (1u64 << 20) as f32;

/// A ray prepared for boxes.
pub struct Slabs {
    inverse: [f32; 3],
    /// Origin times inverse, made larger by the error …
    near_offset: [f32; 3],
    /// … and smaller.
    far_offset: [f32; 3],
    /// A bit for every axis along which the high side comes first.
    near: usize,
}

impl Slabs {
    /// Prepares a usable ray for boxes within `bounds`, which it has left at t = ±`reach`.
    ///
    /// The first node waits for this, so nothing here waits for `reach` but a branch.
    #[inline(always)]
    pub fn new(ray: &Ray, bounds: &Bounds, reach: f32) -> Self {
        let (o, d) = (Vec3A::from(ray.origin), Vec3A::from(ray.direction));
        let size = Vec3A::from(bounds.min).abs().max(Vec3A::from(bounds.max).abs()) + o.abs();
        if !(reach < ORDINARY && size.cmplt(Vec3A::splat(ORDINARY)).all()) {
            return Self::EVERYTHING;
        }
        // A ray along the slab has no inverse. A large one does for it if the result is widened
        // by more than all of the ray that matters.
        let least = size.max(Vec3A::ONE) * (1.0 / LARGEST);
        let along = d.abs().cmplt(least);
        let inverse = d.abs().max(least).recip().copysign(d);
        let widened = Vec3A::select(along, Vec3A::splat(2.0 * ORDINARY), Vec3A::splat(f32::MIN_POSITIVE));
        let error = size * inverse.abs() * 2f32.powi(-21) + widened;
        let offset = o * inverse;
        Self {
            near: inverse.cmplt(Vec3A::ZERO).bitmask() as usize,
            inverse: inverse.to_array(),
            near_offset: (offset + error).to_array(),
            far_offset: (offset - error).to_array(),
        }
    }

    /// Meets every box.
    const EVERYTHING: Self = Self {
        inverse: [0.0; 3],
        near_offset: [f32::INFINITY; 3],
        far_offset: [f32::NEG_INFINITY; 3],
        near: 0,
    };

    /// A bit for every child whose box the ray may meet inside the interval, and where it enters
    /// them. Written without closures, see [`common::simd`].
    #[inline(always)]
    pub fn meet<S: Simd>(
        &self,
        simd: S,
        node: &WideNode,
        interval: Interval,
        enter: &mut [f32; WIDTH],
    ) -> u32 {
        let (near_x, far_x) = self.slab(simd, node, 0);
        let (near_y, far_y) = self.slab(simd, node, 1);
        let (near_z, far_z) = self.slab(simd, node, 2);
        let near = near_x.max(near_y).max(near_z.max(f32x8::splat(simd, interval.min)));
        let far = far_x.min(far_y).min(far_z.min(f32x8::splat(simd, interval.max)));
        near.store_slice(enter);
        near.simd_le(far).to_bitmask() as u32
    }

    #[inline(always)]
    fn slab<S: Simd>(&self, simd: S, node: &WideNode, axis: usize) -> (f32x8<S>, f32x8<S>) {
        let inverse = f32x8::splat(simd, self.inverse[axis]);
        let sides = &node.side[axis];
        let near = f32x8::from_slice(simd, &sides[self.near >> axis & 1]);
        let far = f32x8::from_slice(simd, &sides[!self.near >> axis & 1]);
        (
            near.mul_sub(inverse, f32x8::splat(simd, self.near_offset[axis])),
            far.mul_sub(inverse, f32x8::splat(simd, self.far_offset[axis])),
        )
    }
}
