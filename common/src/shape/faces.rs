//! The triangles of a block side by side: what does not depend on the ray, and the filter's arithmetic.
//!
//! Also that of rays side by side ([`super::unfolded`]): vectors may be of any width.

use super::filter::Filter;
use super::triangle_block::{LANES, TriangleBlock, Verdict};
use crate::math::Interval;
use crate::math::lanes::Vectors;
use crate::simd::{Floats, Select, Simd, SimdBase, SimdFloat, SimdMask, f32x8};

/// The triangles of a block, and what does not depend on the ray.
pub struct Faces<S: Simd> {
    pub(super) corner: Vectors<f32x8<S>>,
    /// The first is turned round, so that no sign need be turned below.
    pub(super) edges: [Vectors<f32x8<S>>; 2],
    pub(super) normal: Vectors<f32x8<S>>,
    /// Largest magnitude of a component of an edge.
    pub(super) size: f32x8<S>,
}

impl<S: Simd> Faces<S> {
    /// Those of a block.
    #[inline(always)]
    pub fn of(simd: S, block: &TriangleBlock) -> Self {
        let corner = block.corner(simd, 0);
        let e1 = minus(corner, block.corner(simd, 1));
        let e2 = minus(block.corner(simd, 2), corner);
        Self { corner, edges: [e1, e2], normal: cross(e2, e1), size: size(e1).max(size(e2)) }
    }

    /// See [`TriangleBlock::judge`]. Written without closures: one that is not inlined would lose the instructions that
    /// `simd` stands for.
    #[inline(always)]
    pub fn judge(&self, simd: S, filter: &Filter, interval: Interval) -> Verdict {
        let Self { corner, edges, normal, size: edge } = *self;
        let c = minus(corner, splat(simd, filter.origin));
        let d = splat(simd, filter.direction);
        let two = two_weights(c, d, edges);
        let along = dot(normal, d);
        let floor = f32x8::splat(simd, filter.errors.floor);
        let weight_error = edge.mul_add(f32x8::splat(simd, filter.errors.weight), floor);
        let (low, high) = extremes(simd, two, along);
        // All weights of one sign: inside; certainly mixed signs: outside.
        let outside = high.min(-low).simd_gt(weight_error);
        // Of most blocks nothing is left here.
        if outside.to_bitmask() as u32 == (1 << LANES) - 1 {
            return Verdict { possible: 0, certain: 0, latest: [0.0; LANES] };
        }

        let height = dot(normal, c);
        let area = edge * edge;
        let along_error = area.mul_add(f32x8::splat(simd, filter.errors.along), floor);
        let depth_error = area.mul_add(f32x8::splat(simd, filter.errors.depth), floor);
        let size = along.abs();
        let height = along.simd_lt(f32x8::splat(simd, 0.0)).select(-height, height);
        let (min, max) = filter.clamp(interval);
        let after_start = height - size * f32x8::splat(simd, min);
        let before_end = size * f32x8::splat(simd, max) - height;
        let sure = size.simd_gt(along_error);
        let off = after_start.simd_lt(-depth_error) | before_end.simd_lt(-depth_error);
        let possible = !(outside | (sure & off));

        let inside = low.max(-high).simd_gt(weight_error);
        let between = after_start.simd_gt(depth_error) & before_end.simd_gt(depth_error);
        let certain = inside & sure & between;
        let mut latest = [0.0; LANES];
        ((height + depth_error) / (size - along_error)).store_slice(&mut latest);
        Verdict { possible: possible.to_bitmask() as u32, certain: certain.to_bitmask() as u32, latest }
    }
}

/// Two weights of where a line meets a plane, times n·d. `c` is the first corner less the origin.
#[inline(always)]
pub(super) fn two_weights<S: Simd, V: Floats<S>>(
    c: Vectors<V>,
    d: Vectors<V>,
    [e1, e2]: [Vectors<V>; 2],
) -> [V; 2] {
    let r = cross(c, d);
    [dot(r, e2), dot(r, e1)]
}

/// The least and the greatest of all three weights, of which two are known and the sum is `along`; of
/// the third a quarter, because it may be wrong by four times as much.
#[inline(always)]
pub(super) fn extremes<S: Simd, V: Floats<S>>(simd: S, [v1, v2]: [V; 2], along: V) -> (V, V) {
    let v0 = (along - (v1 + v2)) * V::splat(simd, 0.25);
    (v1.min(v2).min(v0), v1.max(v2).max(v0))
}

#[inline(always)]
pub(super) fn splat<S: Simd>(simd: S, v: [f32; 3]) -> [f32x8<S>; 3] {
    [f32x8::splat(simd, v[0]), f32x8::splat(simd, v[1]), f32x8::splat(simd, v[2])]
}

#[inline(always)]
pub(super) fn minus<S: Simd, V: Floats<S>>(a: Vectors<V>, b: Vectors<V>) -> Vectors<V> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
pub(super) fn cross<S: Simd, V: Floats<S>>(a: Vectors<V>, b: Vectors<V>) -> Vectors<V> {
    [a[1].mul_sub(b[2], a[2] * b[1]), a[2].mul_sub(b[0], a[0] * b[2]), a[0].mul_sub(b[1], a[1] * b[0])]
}

#[inline(always)]
pub(super) fn dot<S: Simd, V: Floats<S>>(a: Vectors<V>, b: Vectors<V>) -> V {
    a[0].mul_add(b[0], a[1].mul_add(b[1], a[2] * b[2]))
}

/// Largest magnitude of a component.
#[inline(always)]
pub(super) fn size<S: Simd, V: Floats<S>>(a: Vectors<V>) -> V {
    a[0].abs().max(a[1].abs()).max(a[2].abs())
}
