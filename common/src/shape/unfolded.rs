//! Rays side by side against the triangles of a block, one triangle after the other.
//!
//! Where many rays meet one block, what does not depend on the ray is worked out once, and a vector
//! holds rays instead of triangles. The arithmetic and its bounds are those of the filter
//! ([`super::filter`]). Where nothing is left of most rays, only whether the line passes outside and
//! whether it meets the plane before the ray begins is looked at.

use super::faces::{Faces, dot, extremes, minus, two_weights};
use super::triangle_block::{LANES, TriangleBlock};
use crate::math::lanes::{Stored, Vectors, store};
use crate::simd::{Floats, Select, Simd, SimdBase, SimdMask};

/// The triangles of a block with their edges and normals.
pub struct Unfolded {
    corner: Stored<f32>,
    edges: [Stored<f32>; 2],
    normal: Stored<f32>,
    /// Largest magnitude of a component of an edge.
    size: [f32; LANES],
}

/// Rays side by side, as many as a vector has lanes, prepared for triangles.
pub struct Rays<V> {
    origin: Vectors<V>,
    direction: Vectors<V>,
    /// As in [`Errors`](super::filter::Errors).
    weight: V,
    along: V,
    depth: V,
    floor: V,
    /// Where hits begin to count.
    min: V,
}

impl<V> Rays<V> {
    /// Of these origins and directions, whose hits count from `min` on; `errors` are those of
    /// [`Errors::abreast`](super::filter::Errors::abreast).
    #[inline(always)]
    pub fn new<S: Simd>(
        simd: S,
        [origin, direction]: [Vectors<V>; 2],
        [reach, weight, along, depth, floor]: [V; 5],
        min: f32,
    ) -> Self
    where
        V: Floats<S>,
    {
        // No triangle is before that, and the product with it cannot overflow.
        let min = V::splat(simd, min).max(-reach);
        Self { origin, direction, weight, along, depth, floor, min }
    }
}

/// What the filter says of rays and one triangle, a bit for each ray; see
/// [`Verdict`](super::triangle_block::Verdict).
pub struct Verdicts<V> {
    /// Rays that may hit it.
    pub possible: u32,
    /// Those of them that surely do.
    pub certain: u32,
    /// Where those that surely do hit it at the earliest …
    pub earliest: V,
    /// … and at the latest.
    pub latest: V,
}

/// How lines pass a triangle.
struct Passage<V> {
    /// From the origins to the first corner.
    from: Vectors<V>,
    normal: Vectors<V>,
    along: V,
    /// Least and greatest weight.
    low: V,
    high: V,
    /// How wrong they may be.
    error: V,
}

impl Unfolded {
    /// Of all lanes of a block.
    #[inline(always)]
    pub fn of<S: Simd>(simd: S, block: &TriangleBlock) -> Self {
        Self::from_faces(&Faces::of(simd, block))
    }

    /// The same if they are known.
    #[inline(always)]
    pub fn from_faces<S: Simd>(faces: &Faces<S>) -> Self {
        let Faces { corner, edges, normal, size } = *faces;
        let edges = [store(edges[0]), store(edges[1])];
        let mut unfolded = Self { corner: store(corner), edges, normal: store(normal), size: [0.0; LANES] };
        size.store_slice(&mut unfolded.size);
        unfolded
    }

    #[inline(always)]
    fn pass<S: Simd, V: Floats<S>>(&self, simd: S, rays: &Rays<V>, lane: usize) -> Passage<V> {
        let from = minus(of_lane(simd, &self.corner, lane), rays.origin);
        let edges = [of_lane(simd, &self.edges[0], lane), of_lane(simd, &self.edges[1], lane)];
        let normal = of_lane(simd, &self.normal, lane);
        let along = dot(normal, rays.direction);
        let (low, high) = extremes(simd, two_weights(from, rays.direction, edges), along);
        let error = V::splat(simd, self.size[lane]).mul_add(rays.weight, rays.floor);
        Passage { from, normal, along, low, high, error }
    }

    /// A bit for every ray that does not certainly pass all of the first `len` triangles by, nor
    /// begin after them.
    #[inline(always)]
    pub fn rays_meeting<S: Simd, V: Floats<S>>(&self, simd: S, rays: &Rays<V>, len: usize) -> u32 {
        let mut missed = (1 << V::LEN) - 1;
        for lane in 0..len.min(LANES) {
            let Passage { from, normal, along, low, high, error } = self.pass(simd, rays, lane);
            let outside = high.min(-low).simd_gt(error);
            let (size, height) = (along.abs(), dot(normal, from));
            let height = along.simd_lt(V::splat(simd, 0.0)).select(-height, height);
            let area = V::splat(simd, self.size[lane] * self.size[lane]);
            let sure = size.simd_gt(area.mul_add(rays.along, rays.floor));
            let before = (size * rays.min - height).simd_gt(area.mul_add(rays.depth, rays.floor));
            missed &= (outside | (sure & before)).to_bitmask() as u32;
        }
        // What was compared with NaN is not missed.
        !missed & ((1 << V::LEN) - 1)
    }

    /// What the filter says of one triangle and those of the rays that are `asked`; `None` if none of
    /// them may hit it. Hits later than `last` do not matter, which is no more than the rays' reach.
    #[inline(always)]
    pub fn judge<S: Simd, V: Floats<S>>(
        &self,
        simd: S,
        rays: &Rays<V>,
        lane: usize,
        asked: u32,
        last: V,
    ) -> Option<Verdicts<V>> {
        let Passage { from, normal, along, low, high, error } = self.pass(simd, rays, lane);
        let outside = high.min(-low).simd_gt(error);
        if asked & !(outside.to_bitmask() as u32) == 0 {
            return None;
        }
        let height = dot(normal, from);
        let area = V::splat(simd, self.size[lane] * self.size[lane]);
        let along_error = area.mul_add(rays.along, rays.floor);
        let depth_error = area.mul_add(rays.depth, rays.floor);
        let size = along.abs();
        let height = along.simd_lt(V::splat(simd, 0.0)).select(-height, height);
        let after_start = height - size * rays.min;
        let before_end = size * last - height;
        let sure = size.simd_gt(along_error);
        let off = after_start.simd_lt(-depth_error) | before_end.simd_lt(-depth_error);
        let missed = outside | (sure & off);
        let possible = asked & !(missed.to_bitmask() as u32);
        if possible == 0 {
            return None;
        }
        let inside = low.max(-high).simd_gt(error);
        let between = after_start.simd_gt(depth_error) & before_end.simd_gt(depth_error);
        let certain = (inside & sure & between).to_bitmask() as u32 & possible;
        let earliest = (height - depth_error) / (size + along_error);
        let latest = (height + depth_error) / (size - along_error);
        Some(Verdicts { possible, certain, earliest, latest })
    }
}

/// One lane's vector for all.
#[inline(always)]
fn of_lane<S: Simd, V: Floats<S>>(simd: S, v: &Stored<f32>, lane: usize) -> Vectors<V> {
    [V::splat(simd, v[0][lane]), V::splat(simd, v[1][lane]), V::splat(simd, v[2][lane])]
}

#[cfg(test)]
mod tests;
