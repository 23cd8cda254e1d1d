//! Eight rays against the triangles of a block, one triangle after the other.
//!
//! Where many rays meet one block, what does not depend on the ray is worked out once, and a vector
//! holds rays instead of triangles. The arithmetic and its bounds are those of the filter
//! ([`super::filter`]); only whether the line passes outside and whether it meets the plane before
//! the ray begins is looked at, since of most rays nothing is left then.

use super::filter::Errors;
use super::triangle_block::{LANES, TriangleBlock, cross, dot, extremes, minus, size, two_weights};
use crate::math::lanes::{Stored, Vectors, store};
use crate::simd::{Select, Simd, SimdBase, SimdFloat, SimdMask, f32x8};

/// The triangles of a block with their edges and normals.
pub struct Unfolded {
    corner: Stored<f32>,
    edges: [Stored<f32>; 2],
    normal: Stored<f32>,
    /// Largest magnitude of a component of an edge.
    size: [f32; LANES],
}

/// Eight rays side by side, prepared for triangles.
pub struct Rays<S: Simd> {
    origin: Vectors<f32x8<S>>,
    direction: Vectors<f32x8<S>>,
    /// As in [`Errors`].
    weight: f32x8<S>,
    along: f32x8<S>,
    depth: f32x8<S>,
    floor: f32x8<S>,
    /// Where hits begin to count.
    min: f32x8<S>,
}

impl<S: Simd> Rays<S> {
    /// Of these origins and directions, whose hits count from `min` on; `far` and `step`
    /// are those of [`Errors::new`].
    #[inline(always)]
    pub fn new(
        simd: S,
        origin: Vectors<f32x8<S>>,
        direction: Vectors<f32x8<S>>,
        [far, step]: [f32x8<S>; 2],
        min: f32,
    ) -> Self {
        let [reach, weight, along, depth, floor] = Errors::abreast(simd, far, step);
        // No triangle is before that, and the product with it cannot overflow.
        let min = f32x8::splat(simd, min).max(-reach);
        Self { origin, direction, weight, along, depth, floor, min }
    }
}

impl Unfolded {
    /// Of all lanes of a block.
    #[inline(always)]
    pub fn of<S: Simd>(simd: S, block: &TriangleBlock) -> Self {
        let a = block.corner(simd, 0);
        let e1 = minus(a, block.corner(simd, 1));
        let e2 = minus(block.corner(simd, 2), a);
        let mut unfolded = Self {
            corner: store(a),
            edges: [store(e1), store(e2)],
            normal: store(cross(e2, e1)),
            size: [0.0; LANES],
        };
        size(e1).max(size(e2)).store_slice(&mut unfolded.size);
        unfolded
    }

    /// A bit for every ray that does not certainly pass all of the first `len` triangles by, nor
    /// begin after them.
    #[inline(always)]
    pub fn rays_meeting<S: Simd>(&self, simd: S, rays: &Rays<S>, len: usize) -> u32 {
        let mut missed = (1 << LANES) - 1;
        for lane in 0..len.min(LANES) {
            let of = |x: f32| f32x8::splat(simd, x);
            let c = minus(of_lane(simd, &self.corner, lane), rays.origin);
            let edges = [of_lane(simd, &self.edges[0], lane), of_lane(simd, &self.edges[1], lane)];
            let normal = of_lane(simd, &self.normal, lane);
            let along = dot(normal, rays.direction);
            let (low, high) = extremes(simd, two_weights(c, rays.direction, edges), along);
            let error = of(self.size[lane]).mul_add(rays.weight, rays.floor);
            let outside = high.min(-low).simd_gt(error);
            let (size, height) = (along.abs(), dot(normal, c));
            let height = along.simd_lt(of(0.0)).select(-height, height);
            let area = of(self.size[lane] * self.size[lane]);
            let sure = size.simd_gt(area.mul_add(rays.along, rays.floor));
            let before = (size * rays.min - height).simd_gt(area.mul_add(rays.depth, rays.floor));
            missed &= (outside | (sure & before)).to_bitmask() as u32;
        }
        // What was compared with NaN is not missed.
        !missed & ((1 << LANES) - 1)
    }
}

/// One lane's vector for all.
#[inline(always)]
fn of_lane<S: Simd>(simd: S, v: &Stored<f32>, lane: usize) -> Vectors<f32x8<S>> {
    [f32x8::splat(simd, v[0][lane]), f32x8::splat(simd, v[1][lane]), f32x8::splat(simd, v[2][lane])]
}

#[cfg(test)]
mod tests;
