//! Eight triangles against one ray, in `f32`, to discard what is surely missed.
//!
//! The filter evaluates Cramer's rule for origin + t·d = a + u·e₁ + v·e₂ (Möller & Trumbore 1997)
//! in single precision beside bounds of its errors. A lane is discarded only if the line
//! certainly passes outside, or t certainly lies outside the interval; every other lane is
//! decided by [`super::triangle::intersect`]. So the filter may use any instructions, fused ones
//! too: it cannot change a picture.
//!
//! What bounds its errors is derived in [`super::filter`].

use super::faces::{Faces, Rays, dot, splat};
use super::filter::Filter;
use super::triangle::abreast::Corners;
use crate::math::lanes::Vectors;
use crate::math::{Interval, Vec3};
use crate::simd::{self, Simd, SimdBase, SimdMask, f32x8, u32x8};

/// How many triangles a block holds.
pub const LANES: usize = 8;

/// Eight triangles, coordinates side by side: `corner[vertex][axis][lane]`; five cache lines.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub struct TriangleBlock {
    corner: Corners,
    /// Index of each lane's triangle in the caller's array, no two the same; lanes that are not
    /// in use repeat the last.
    pub index: [u32; LANES],
}

/// What the filter says about the lanes of a block, a bit for each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Verdict {
    /// Lanes that it cannot discard.
    pub possible: u32,
    /// Those of them that are hit inside the interval beyond doubt.
    pub certain: u32,
    /// Where those that are certain are hit at the latest; meaningless for the others. Known long
    /// before the exact test has its answer, so that the search can go on meanwhile.
    pub latest: [f32; LANES],
}

impl TriangleBlock {
    /// Packs up to eight triangles with their indices. Unused lanes are NaN-free copies.
    ///
    /// # Panics
    /// If `triangles` yields nothing.
    pub fn pack(triangles: impl IntoIterator<Item = (u32, [Vec3; 3])>) -> Self {
        let mut block = Self { corner: [[[0.0; LANES]; 3]; 3], index: [0; LANES] };
        let mut len = 0;
        for (lane, (index, vertices)) in triangles.into_iter().take(LANES).enumerate() {
            block.set(lane, index, &vertices);
            len = lane + 1;
        }
        assert!(len > 0, "a block needs a triangle");
        for lane in len..LANES {
            block.copy_lane(len - 1, lane);
        }
        block
    }

    fn set(&mut self, lane: usize, index: u32, vertices: &[Vec3; 3]) {
        for (corner, vertex) in self.corner.iter_mut().zip(vertices) {
            for axis in 0..3 {
                corner[axis][lane] = vertex[axis];
            }
        }
        self.index[lane] = index;
    }

    fn copy_lane(&mut self, from: usize, to: usize) {
        for corner in &mut self.corner {
            for axis in corner {
                axis[to] = axis[from];
            }
        }
        self.index[to] = self.index[from];
    }

    /// Asks the memory for it, without waiting.
    #[inline(always)]
    pub fn prefetch(&self) {
        // Two coordinates to a cache line.
        let coordinates = self.corner.as_flattened();
        for pair in 0..4 {
            simd::prefetch(&coordinates[2 * pair]);
        }
        simd::prefetch(&coordinates[8]);
    }

    /// How many lanes are in use, 1 to 8.
    #[inline(always)]
    #[expect(clippy::len_without_is_empty, reason = "a block is never empty")]
    pub fn len(&self) -> usize {
        let mut len = 1;
        for lane in 1..LANES {
            len += usize::from(self.index[lane] != self.index[lane - 1]);
        }
        len
    }

    /// A bit for each lane that holds the triangle of this index.
    #[inline(always)]
    pub fn lanes_of<S: Simd>(&self, simd: S, index: u32) -> u32 {
        let held = u32x8::from_slice(simd, &self.index);
        held.simd_eq(u32x8::splat(simd, index)).to_bitmask() as u32
    }

    /// A bit for each lane whose triangle is not on one side of all that is between `low` and `high` along a vector.
    #[inline(always)]
    pub fn reaching<S: Simd>(&self, simd: S, along: Vec3, low: f32, high: f32) -> u32 {
        let along = splat(simd, along.to_array());
        let (a, b) = (dot(self.corner(simd, 0), along), dot(self.corner(simd, 1), along));
        let c = dot(self.corner(simd, 2), along);
        let (least, most) = (a.min(b).min(c), a.max(b).max(c));
        // Written so that NaN is not outside.
        let outside = least.simd_gt(f32x8::splat(simd, high)) | most.simd_lt(f32x8::splat(simd, low));
        !outside.to_bitmask() as u32
    }

    /// The corners of one lane.
    #[inline]
    pub fn vertices(&self, lane: usize) -> [Vec3; 3] {
        let at =
            |v: usize| Vec3::new(self.corner[v][0][lane], self.corner[v][1][lane], self.corner[v][2][lane]);
        [at(0), at(1), at(2)]
    }

    /// Copies the corners of one lane to a place beside others.
    #[inline(always)]
    pub fn copy_corners(&self, lane: usize, to: &mut Corners, place: usize) {
        let (lane, place) = (lane % LANES, place % LANES);
        for (corner, to) in self.corner.iter().zip(to) {
            for axis in 0..3 {
                to[axis][place] = corner[axis][lane];
            }
        }
    }

    /// What the filter says about every lane, whether in use or not, for `interval`.
    #[inline(always)]
    pub fn judge<S: Simd>(&self, simd: S, filter: &Filter, interval: Interval) -> Verdict {
        judge(simd, &self.faces(simd), filter, interval)
    }

    /// What does not depend on the ray.
    #[inline(always)]
    pub fn faces<S: Simd>(&self, simd: S) -> Faces<f32x8<S>> {
        Faces::new(self.corners(simd))
    }

    /// The corners of all lanes.
    #[inline(always)]
    pub fn corners<S: Simd>(&self, simd: S) -> [Vectors<f32x8<S>>; 3] {
        [self.corner(simd, 0), self.corner(simd, 1), self.corner(simd, 2)]
    }

    #[inline(always)]
    fn corner<S: Simd>(&self, simd: S, vertex: usize) -> Vectors<f32x8<S>> {
        [
            f32x8::from_slice(simd, &self.corner[vertex][0]),
            f32x8::from_slice(simd, &self.corner[vertex][1]),
            f32x8::from_slice(simd, &self.corner[vertex][2]),
        ]
    }
}

/// [`TriangleBlock::judge`] if the block's [faces](TriangleBlock::faces) are known.
#[inline(always)]
pub fn judge<S: Simd>(simd: S, faces: &Faces<f32x8<S>>, filter: &Filter, interval: Interval) -> Verdict {
    let (min, max) = filter.clamp(interval);
    let ray = Rays::everywhere(simd, filter, min);
    let passages = faces.pass(simd, &ray);
    let outside = passages.outside();
    // Of most blocks nothing is left here.
    if outside.to_bitmask() as u32 == (1 << LANES) - 1 {
        return Verdict { possible: 0, certain: 0, latest: [0.0; LANES] };
    }
    let depths = faces.depths(simd, &ray, &passages);
    let (after, between) = depths.after_and_between(f32x8::splat(simd, max));
    let possible = !(outside | (depths.sure() & (depths.before_start() | after)));
    let certain = passages.inside() & depths.sure() & between;
    let mut latest = [0.0; LANES];
    depths.latest().store_slice(&mut latest);
    Verdict { possible: possible.to_bitmask() as u32, certain: certain.to_bitmask() as u32, latest }
}
