//! Streams of rays: all of one octant that reach a node go to its children in lists, eight side by
//! side, so that no branch depends on what one of them does.
//!
//! Rays of one octant agree on which side of every plane is near, so all pass all leaves from near to
//! far. Planes are widened as the hierarchy's boxes are (see [`crate::bvh`]'s pool): where a ray meets
//! a plane within the error of either end of its stretch, it goes to both sides.

use super::ask::Answer;
use super::current::{Current, number_from};
use super::lists::Task;
use super::query::Prepared;
use super::stack::Waiting;
use super::tree::{KdTree, Node};
use crate::bvh::flow::{self, Reached};
use crate::bvh::packet::RAYS;
use crate::bvh::purpose::At;
use crate::bvh::record::columns;
use crate::bvh::stream::Stream;
use common::counters::Counters;
use common::math::Interval;
use common::shape::triangle_block::TriangleBlock;
use common::simd::{Simd, SimdBase, SimdFloat, SimdMask, f32x8, u32x8};

/// Fewer rays on a list are faster one by one.
const FEW: usize = 4;

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
        current.enter(simd, stream, &self.bounds, interval.min);
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
        let held = self.held(leaf);
        let list = current.lists.of(task);
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
            current.rows.end_at(ray as usize, stream.records[ray as usize].limit());
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
        current.rows.end_at(ray, record.limit());
    }
}

/// Sends the rays of a list to the sides of a node's plane that they pass.
#[inline(always)]
fn pass<S: Simd>(simd: S, (node, task): (Node, &Task), stream: &Stream, current: &mut Current) {
    let (axis, at) = (node.axis(), node.at());
    let backward = stream.octant >> axis & 1;
    let room = if backward == 0 { stream.room } else { -stream.room };
    let (before_at, after_at) = (f32x8::splat(simd, at - room), f32x8::splat(simd, at + room));
    let rows = &current.rows.0[axis];
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
