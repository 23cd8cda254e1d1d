//! A stream of rays on its way through a kd-tree.

use super::lists::Lists;
use super::stack::Stack;
use crate::bvh::lists::Lists as Blocks;
use crate::bvh::packet::RAYS;
use crate::bvh::record::{Record, rows};
use crate::bvh::stream::{MANY, Stream};
use common::math::Bounds;
use common::simd::{Simd, SimdBase, SimdFloat, SimdMask, f32x8, u32x8};

/// What planes want to know of the rays of a stream, by axis and ray: inverse of the direction; origin
/// times inverse; until where planes matter.
pub struct Rows(pub [Vec<[f32; 4]>; 3]);

impl Rows {
    /// Planes that a ray meets after `limit` do not matter from now on.
    #[inline(always)]
    pub fn end_at(&mut self, ray: usize, limit: f32) {
        for rows in &mut self.0 {
            rows[ray][2] = limit;
        }
    }
}

/// The rays of a stream under way, and who waits where.
pub struct Current {
    /// What planes want to know of rays.
    pub rows: Rows,
    /// Who waits at nodes.
    pub lists: Lists,
    /// Who waits at the blocks of one leaf.
    pub blocks: Blocks,
    /// For rays that go on alone.
    pub stack: Stack,
}

impl Current {
    /// Nobody.
    pub fn new() -> Self {
        let rows = Rows([const { Vec::new() }; 3]);
        Self { rows, lists: Lists::new(), blocks: Blocks::new(), stack: Stack::new() }
    }

    /// Sends the rays that pass the tree's box after `min` to the root.
    #[inline(always)]
    pub fn enter<S: Simd>(&mut self, simd: S, stream: &Stream, bounds: &Bounds, min: f32) {
        let of = |x: f32| f32x8::splat(simd, x);
        let Self { rows: Rows(all), lists, .. } = self;
        for row in all.iter_mut() {
            // Numbers behind the end of a list may be of any stream.
            row.resize(MANY, [0.0; 4]);
        }
        let (places, rays) = (lists.start(stream.rays.len()), stream.rays.len());
        let mut end = 0;
        for (first, records) in (0..).step_by(RAYS).zip(stream.records.chunks_exact(RAYS)) {
            let [r0, r1, r2, r3, r4, r5, r6, r7] = [0, 1, 2, 3, 4, 5, 6, 7].map(|i: usize| &records[i]);
            let [ix, iy, iz, x, y, z, limit] = Record::beams(simd, [r0, r1, r2, r3, r4, r5, r6, r7]);
            let (mut enter, mut exit) = (of(min), limit);
            for axis in 0..3 {
                let (inverse, offset) = ([ix, iy, iz][axis], [x, y, z][axis]);
                let backward = stream.octant >> axis & 1;
                let sides = [bounds.min[axis] - stream.room, bounds.max[axis] + stream.room];
                enter = enter.max(of(sides[backward]).mul_sub(inverse, offset));
                exit = exit.min(of(sides[backward ^ 1]).mul_sub(inverse, offset));
                let [low, high] = rows(simd, [inverse, offset, limit, limit]);
                let row = &mut all[axis][first..first + RAYS];
                for lane in 0..RAYS / 2 {
                    low[lane].store_slice(&mut row[lane]);
                    high[lane].store_slice(&mut row[lane + RAYS / 2]);
                }
            }
            let numbers = number_from(simd, first as u32);
            let inside = enter.simd_le(exit) & numbers.simd_lt(u32x8::splat(simd, rays as u32));
            simd.compress_u32x8(numbers, inside).store_slice(&mut places.rays[end..end + RAYS]);
            simd.compress_f32x8(enter, inside).store_slice(&mut places.enter[end..end + RAYS]);
            simd.compress_f32x8(exit, inside).store_slice(&mut places.exit[end..end + RAYS]);
            end += inside.to_bitmask().count_ones() as usize;
        }
        lists.at_root(end);
    }
}

/// Eight numbers, one after the other.
#[inline(always)]
pub fn number_from<S: Simd>(simd: S, first: u32) -> u32x8<S> {
    u32x8::from_slice(simd, &[0, 1, 2, 3, 4, 5, 6, 7]) + u32x8::splat(simd, first)
}
