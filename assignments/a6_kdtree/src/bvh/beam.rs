//! One ray against the eight boxes of a node.

use super::walk::Way;
use super::wide::{WIDTH, WideNode};
use common::simd::{Simd, SimdBase, SimdFloat, SimdMask, f32x8};

/// What box tests know of a ray; see [`super::packet::Packet`].
#[derive(Clone, Copy)]
pub struct Beam {
    /// Inverse of the direction.
    inverse: [f32; 3],
    /// Origin times inverse, made larger by the error …
    near_offset: [f32; 3],
    /// … and smaller.
    far_offset: [f32; 3],
    /// Where among both sides of an axis, one after the other, those begin that come first.
    near: [u32; 3],
    /// A bit for every axis along which the high side comes first.
    pub backward: u32,
}

impl Beam {
    /// No ray.
    pub const NONE: Self = Self::new([0.0; 3], [0.0; 3], [0.0; 3], 0);

    /// Puts it together.
    #[inline(always)]
    pub const fn new(inverse: [f32; 3], near_offset: [f32; 3], far_offset: [f32; 3], backward: u32) -> Self {
        let width = WIDTH as u32;
        let near = [(backward & 1) * width, (backward >> 1 & 1) * width, (backward >> 2 & 1) * width];
        Self { inverse, near_offset, far_offset, near, backward }
    }

    /// The same for eight boxes at once, from `min` on.
    #[inline(always)]
    pub fn spread<S: Simd>(&self, simd: S, min: f32) -> Spread<S> {
        Spread {
            inverse: spread(simd, &self.inverse),
            near_offset: spread(simd, &self.near_offset),
            far_offset: spread(simd, &self.far_offset),
            min: f32x8::splat(simd, min),
            near: self.near,
            backward: self.backward,
        }
    }
}

#[inline(always)]
fn spread<S: Simd>(simd: S, [x, y, z]: &[f32; 3]) -> [f32x8<S>; 3] {
    [f32x8::splat(simd, *x), f32x8::splat(simd, *y), f32x8::splat(simd, *z)]
}

/// A beam in vectors. Whoever asks for many nodes makes it once.
pub struct Spread<S: Simd> {
    inverse: [f32x8<S>; 3],
    near_offset: [f32x8<S>; 3],
    far_offset: [f32x8<S>; 3],
    min: f32x8<S>,
    near: [u32; 3],
    backward: u32,
}

impl<S: Simd> Way<S> for Spread<S> {
    #[inline(always)]
    fn backward(&self) -> u32 {
        self.backward
    }

    #[inline(always)]
    fn meet(&self, simd: S, node: &WideNode, max: f32, enter: &mut [f32; WIDTH]) -> u32 {
        let (near, lanes) = self.boxes(simd, node, max);
        near.store_slice(enter);
        lanes
    }
}

impl<S: Simd> Spread<S> {
    /// Where the ray enters each child's box, and a bit for those that it may meet, no later than
    /// `max`. Written without closures, see [`common::simd`].
    #[inline(always)]
    pub fn boxes(&self, simd: S, node: &WideNode, max: f32) -> (f32x8<S>, u32) {
        let (near_x, far_x) = self.slab(simd, node, 0);
        let (near_y, far_y) = self.slab(simd, node, 1);
        let (near_z, far_z) = self.slab(simd, node, 2);
        let near = near_x.max(near_y).max(near_z.max(self.min));
        let far = far_x.min(far_y).min(far_z.min(f32x8::splat(simd, max)));
        (near, near.simd_le(far).to_bitmask() as u32)
    }

    #[inline(always)]
    fn slab(&self, simd: S, node: &WideNode, axis: usize) -> (f32x8<S>, f32x8<S>) {
        let sides = node.side[axis].as_flattened();
        // Masked so that the compiler need not be told that it is in range.
        let first = self.near[axis] as usize & WIDTH;
        let near = f32x8::from_slice(simd, &sides[first..][..WIDTH]);
        let far = f32x8::from_slice(simd, &sides[first ^ WIDTH..][..WIDTH]);
        let inverse = self.inverse[axis];
        (near.mul_sub(inverse, self.near_offset[axis]), far.mul_sub(inverse, self.far_offset[axis]))
    }
}
