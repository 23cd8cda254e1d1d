//! Rays side by side against the triangles of a block, one triangle after the other.
//!
//! Where many rays meet one block, what does not depend on the ray is worked out once, and a vector
//! holds rays instead of triangles. The arithmetic and its bounds are those of the filter
//! ([`super::filter`]). Where nothing is left of most rays, only whether the line passes outside and
//! whether it meets the plane before the ray begins is looked at.

use super::faces::{Faces, Rays};
use super::triangle_block::LANES;
use crate::math::lanes::{Stored, Vectors, store};
use crate::simd::{Floats, Simd, SimdBase, SimdMask, f32x8};

/// The triangles of a block with their edges and normals.
pub struct Unfolded {
    corner: Stored<f32>,
    edges: [Stored<f32>; 2],
    normal: Stored<f32>,
    /// Largest magnitude of a component of an edge.
    size: [f32; LANES],
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

impl Unfolded {
    /// Of eight triangles side by side.
    #[inline(always)]
    pub fn of<S: Simd>(faces: &Faces<f32x8<S>>) -> Self {
        let Faces { corner, edges, normal, size } = *faces;
        let edges = [store(edges[0]), store(edges[1])];
        let mut unfolded = Self { corner: store(corner), edges, normal: store(normal), size: [0.0; LANES] };
        size.store_slice(&mut unfolded.size);
        unfolded
    }

    /// One of them in all lanes.
    #[inline(always)]
    fn face<S: Simd, V: Floats<S>>(&self, simd: S, lane: usize) -> Faces<V> {
        Faces {
            corner: of_lane(simd, &self.corner, lane),
            edges: [of_lane(simd, &self.edges[0], lane), of_lane(simd, &self.edges[1], lane)],
            normal: of_lane(simd, &self.normal, lane),
            size: V::splat(simd, self.size[lane]),
        }
    }

    /// A bit for every ray that does not certainly pass all of the first `len` triangles by, nor
    /// begin after them.
    #[inline(always)]
    pub fn rays_meeting<S: Simd, V: Floats<S>>(&self, simd: S, rays: &Rays<V>, len: usize) -> u32 {
        let mut missed = (1 << V::LEN) - 1;
        for lane in 0..len.min(LANES) {
            let face = self.face(simd, lane);
            let passages = face.pass(simd, rays);
            let depths = face.depths(simd, rays, &passages);
            missed &= (passages.outside() | (depths.sure() & depths.before_start())).to_bitmask() as u32;
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
        let face = self.face(simd, lane);
        let passages = face.pass(simd, rays);
        let outside = passages.outside();
        if asked & !(outside.to_bitmask() as u32) == 0 {
            return None;
        }
        let depths = face.depths(simd, rays, &passages);
        let (after, between) = depths.after_and_between(last);
        let missed = outside | (depths.sure() & (depths.before_start() | after));
        let possible = asked & !(missed.to_bitmask() as u32);
        if possible == 0 {
            return None;
        }
        let certain = (passages.inside() & depths.sure() & between).to_bitmask() as u32 & possible;
        Some(Verdicts { possible, certain, earliest: depths.earliest(), latest: depths.latest() })
    }
}

/// One lane's vector for all.
#[inline(always)]
fn of_lane<S: Simd, V: Floats<S>>(simd: S, v: &Stored<f32>, lane: usize) -> Vectors<V> {
    [V::splat(simd, v[0][lane]), V::splat(simd, v[1][lane]), V::splat(simd, v[2][lane])]
}

#[cfg(test)]
mod tests;
