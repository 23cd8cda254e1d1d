//! Streams of rays: all of one octant that reach a node go to its children in lists, eight side by
//! side, so that no branch depends on what one of them does.
//!
//! Rays of one octant agree on which side of every plane is near, so all pass all leaves from near to
//! far. Planes are widened as the hierarchy's boxes are (see [`crate::bvh`]'s pool): where a ray meets
//! a plane within the error of either end of its stretch, it goes to both sides.

use super::ask::Answer;
use super::lists::{Lists, Task};
use super::query::Prepared;
use super::stack::{Stack, Waiting};
use super::tree::{KdTree, Node};
use crate::bvh::flow::{self, Reached};
use crate::bvh::lists::Lists as Blocks;
use crate::bvh::packet::RAYS;
use crate::bvh::purpose::At;
use crate::bvh::record::{Record, columns, rows};
use crate::bvh::stream::{MANY, Stream};
use common::counters::Counters;
use common::math::Interval;
use common::shape::triangle_block::TriangleBlock;
use common::simd::{Simd, SimdBase, SimdFloat, SimdMask, f32x8, u32x8};

/// Fewer rays on a list are faster one by one.
const FEW: usize = 4;

/// What planes want to know of the rays of a stream, and who waits where.
pub struct Current {
    /// By axis and ray: inverse of the direction; origin times inverse; until where planes matter.
    rows: [Vec<[f32; 4]>; 3],
    lists: Lists,
    /// Who waits at the blocks of one leaf.
    blocks: Blocks,
    stack: Stack,
}

impl Current {
    /// Nobody.
    pub fn new() -> Self {
        let rows = [const { Vec::new() }; 3];
        Self { rows, lists: Lists::new(), blocks: Blocks::new(), stack: Stack::new() }
    }

    /// For rays that go alone.
    pub fn stack(&mut self) -> &mut Stack {
        &mut self.stack
    }
}

/// One block of a leaf.
struct Block<'a, T> {
    block: &'a TriangleBlock,
    len: usize,
    answers: &'a mut [T],
}

impl<T: Answer> Reached for Block<'_, T> {
    #[inline(always)]
    fn ask<S: Simd>(&mut self, simd: S, at: &At, c: &mut Counters) -> f32 {
        self.answers[at.ray].look(simd, (self.block, self.len), at.last, &at.job, c)
    }
}

impl KdTree<'_> {
    /// Follows all rays of a stream.
    #[inline(always)]
    pub(super) fn flow<S: Simd, T: Answer>(
        &self,
        simd: S,
        stream: &mut Stream,
        interval: Interval,
        answers: &mut [T],
        current: &mut Current,
        c: &mut Counters,
    ) {
        self.enter(simd, stream, interval, current);
        while let Some(task) = current.lists.pop() {
            let node = self.nodes[task.node as usize];
            if let Some(next) = current.lists.next() {
                self.prefetch(self.nodes[next as usize]);
            }
            if node.is_leaf() {
                self.leaf_of(simd, (node, &task), stream, interval, answers, current, c);
            } else if task.len() >= FEW {
                c.cells += task.len() as u64;
                pass(simd, (node, &task), stream, current);
            } else {
                for place in 0..task.len() {
                    self.go_on(simd, (&task, place), stream, interval, answers, current, c);
                }
            }
        }
    }

    /// Sends the rays that pass the tree's box to the root.
    #[inline(always)]
    fn enter<S: Simd>(&self, simd: S, stream: &Stream, interval: Interval, current: &mut Current) {
        let of = |x: f32| f32x8::splat(simd, x);
        let Current { rows: all, lists, .. } = current;
        for row in all.iter_mut() {
            // Numbers behind the end of a list may be of any stream.
            row.resize(MANY, [0.0; 4]);
        }
        let (places, rays) = (lists.start(stream.rays.len()), stream.rays.len());
        let mut end = 0;
        for (first, records) in (0..).step_by(RAYS).zip(stream.records.chunks_exact(RAYS)) {
            let [r0, r1, r2, r3, r4, r5, r6, r7] = [0, 1, 2, 3, 4, 5, 6, 7].map(|i: usize| &records[i]);
            let [ix, iy, iz, x, y, z, limit] = Record::beams(simd, [r0, r1, r2, r3, r4, r5, r6, r7]);
            let (mut enter, mut exit) = (of(interval.min), limit);
            for axis in 0..3 {
                let (inverse, offset) = ([ix, iy, iz][axis], [x, y, z][axis]);
                let backward = stream.octant >> axis & 1;
                let sides = [self.bounds.min[axis] - stream.room, self.bounds.max[axis] + stream.room];
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

    /// Looks into a leaf with all rays of a list.
    #[expect(clippy::too_many_arguments, reason = "all of them belong to one loop")]
    #[inline(always)]
    fn leaf_of<S: Simd, T: Answer>(
        &self,
        simd: S,
        (leaf, task): (Node, &Task),
        stream: &mut Stream,
        interval: Interval,
        answers: &mut [T],
        current: &mut Current,
        c: &mut Counters,
    ) {
        let (list, held) = (current.lists.of(task), self.held(leaf));
        for block in held.blocks {
            let len = block.len();
            let reached = &mut Block { block, len, answers };
            flow::reach(simd, Some((block, len)), list, stream, interval, reached, c);
        }
        for node in held.boxes {
            c.cells += list.len() as u64;
            current.blocks.start(list.iter().copied());
            while let Some(task) = current.blocks.pop() {
                if let Some(next) = current.blocks.next() {
                    self.blocks[next.block_and_len().0].prefetch();
                }
                if task.child.is_node() {
                    flow::pass(simd, &mut current.blocks, &task, node, stream, interval.min);
                    continue;
                }
                let (block, len) = task.child.block_and_len();
                let (block, list) = (&self.blocks[block], current.blocks.of(&task));
                let reached = &mut Block { block, len, answers };
                flow::reach(simd, Some((block, len)), list, stream, interval, reached, c);
            }
        }
        for &ray in list {
            let limit = stream.records[ray as usize].limit();
            for rows in &mut current.rows {
                rows[ray as usize][2] = limit;
            }
        }
    }

    /// Lets one ray of a list go on alone.
    #[expect(clippy::too_many_arguments, reason = "all of them belong to one loop")]
    #[inline(always)]
    fn go_on<S: Simd, T: Answer>(
        &self,
        simd: S,
        (task, place): (&Task, usize),
        stream: &mut Stream,
        interval: Interval,
        answers: &mut [T],
        current: &mut Current,
        c: &mut Counters,
    ) {
        let ray = current.lists.of(task)[place] as usize;
        let [enter, exit] = current.lists.stretch(task, place).map(f64::from);
        let record = &mut stream.records[ray];
        if enter > f64::from(record.limit()) {
            return;
        }
        let filter = record.filter();
        let margin = filter.errors.margin();
        let prepared = Prepared { beam: record.beam(stream.room, stream.octant as u32), filter, margin };
        let from = Waiting { enter, exit, node: task.node };
        let ready = (&stream.rays[ray], prepared);
        let last = self.follow(
            simd,
            ready,
            interval,
            Some((from, record.last())),
            &mut current.stack,
            &mut answers[ray],
            c,
        );
        record.end_at(last, margin);
        for rows in &mut current.rows {
            rows[ray][2] = record.limit();
        }
    }
}

/// Eight numbers, one after the other.
#[inline(always)]
fn number_from<S: Simd>(simd: S, first: u32) -> u32x8<S> {
    u32x8::from_slice(simd, &[0, 1, 2, 3, 4, 5, 6, 7]) + u32x8::splat(simd, first)
}

/// Sends the rays of a list to the sides of a node's plane that they pass.
#[inline(always)]
fn pass<S: Simd>(simd: S, (node, task): (Node, &Task), stream: &Stream, current: &mut Current) {
    let (axis, at) = (node.axis(), node.at());
    let backward = stream.octant >> axis & 1;
    let room = if backward == 0 { stream.room } else { -stream.room };
    let (before_at, after_at) = (f32x8::splat(simd, at - room), f32x8::splat(simd, at + room));
    let rows = &current.rows[axis];
    let row = |ray: u32| &rows[ray as usize];
    let [list, near, far] = current.lists.split(task);
    let (mut near_end, mut far_end) = (0, 0);
    for first in (0..task.len()).step_by(RAYS) {
        let [a, b, c, d, e, f, g, h] = *list.rays[first..].first_chunk().expect("whole eights");
        let all = [row(a), row(b), row(c), row(d), row(e), row(f), row(g), row(h)];
        let [inverse, offset, limit, _] = columns(simd, all);
        let rays = u32x8::from_slice(simd, &list.rays[first..first + RAYS]);
        let enter = f32x8::from_slice(simd, &list.enter[first..first + RAYS]);
        let exit = f32x8::from_slice(simd, &list.exit[first..first + RAYS]).min(limit);
        let on_list = number_from(simd, first as u32).simd_lt(u32x8::splat(simd, task.len() as u32));
        let inside = enter.simd_le(exit) & on_list;
        let (before, after) = (before_at.mul_sub(inverse, offset), after_at.mul_sub(inverse, offset));
        let (nearer, farther) = (inside & after.simd_ge(enter), inside & before.simd_le(exit));
        simd.compress_u32x8(rays, nearer).store_slice(&mut near.rays[near_end..near_end + RAYS]);
        simd.compress_f32x8(enter, nearer).store_slice(&mut near.enter[near_end..near_end + RAYS]);
        simd.compress_f32x8(exit.min(after), nearer).store_slice(&mut near.exit[near_end..near_end + RAYS]);
        simd.compress_u32x8(rays, farther).store_slice(&mut far.rays[far_end..far_end + RAYS]);
        simd.compress_f32x8(enter.max(before), farther).store_slice(&mut far.enter[far_end..far_end + RAYS]);
        simd.compress_f32x8(exit, farther).store_slice(&mut far.exit[far_end..far_end + RAYS]);
        near_end += nearer.to_bitmask().count_ones() as usize;
        far_end += farther.to_bitmask().count_ones() as usize;
    }
    let child = node.child() as u32;
    let children = [child + backward as u32, child + (backward as u32 ^ 1)];
    current.lists.push(task, children, [near_end, far_end]);
}
