//! Streams of rays: all that reach a node are asked about its children before any goes on
//! (Barringer & Akenine-Möller, "Dynamic Ray Stream Traversal", 2014).
//!
//! Rays are taken eight at a time, side by side, so that no branch depends on what one of them meets
//! and a block's triangles are worked out once for all. Rays of one octant share the order of
//! children. Where a list gets short its rays go on alone.

use super::bundle::lanes_of;
use super::lists::{Lists, Task, eight};
use super::packet::RAYS;
use super::purpose::{At, Purpose};
use super::record::Record;
use super::stack::Stack;
use super::straggler::Straggler;
use super::stream::Stream;
use super::wide::{Bvh, Held, WIDTH, WideNode};
use common::accel::Job;
use common::counters::Counters;
use common::math::Interval;
use common::math::lanes::Stored;
use common::shape::triangle_block::TriangleBlock;
use common::shape::unfolded::Unfolded;
use common::simd::{Simd, SimdBase, SimdFloat, SimdMask, f32x8, u32x8};

/// Fewer rays on a list are faster one by one.
const FEW: usize = 8;

/// Of fewer each is faster asked about eight triangles than eight about each triangle.
const UNFOLD: usize = 5;

/// The sides of a node's boxes, made wider, as rays of an octant meet them.
struct Sides {
    near: Stored<f32>,
    far: Stored<f32>,
}

impl Sides {
    #[inline(always)]
    fn of<S: Simd>(simd: S, node: &WideNode, octant: usize, room: f32) -> Self {
        let mut sides = Self { near: [[0.0; WIDTH]; 3], far: [[0.0; WIDTH]; 3] };
        for axis in 0..3 {
            let backward = octant >> axis & 1;
            let room = f32x8::splat(simd, if backward == 0 { room } else { -room });
            let [near, far] = [&node.side[axis][backward], &node.side[axis][backward ^ 1]];
            (f32x8::from_slice(simd, near) - room).store_slice(&mut sides.near[axis]);
            (f32x8::from_slice(simd, far) + room).store_slice(&mut sides.far[axis]);
        }
        sides
    }
}

/// The records of eight rays.
#[inline(always)]
fn records_of<'r>(records: &'r [Record], n: &[u32; RAYS]) -> [&'r Record; RAYS] {
    let of = |i: usize| &records[n[i] as usize];
    [of(0), of(1), of(2), of(3), of(4), of(5), of(6), of(7)]
}

impl Bvh<'_> {
    /// Follows all rays of a stream.
    #[inline(always)]
    pub(super) fn flow<S: Simd>(
        &self,
        simd: S,
        stream: &mut Stream,
        interval: Interval,
        purpose: &mut impl Purpose,
        c: &mut Counters,
    ) {
        let (mut lists, mut stack) = (Lists::new(), Stack::new());
        lists.start(0..stream.rays.len() as u32);
        while let Some(task) = lists.pop() {
            if let Some(child) = lists.next() {
                self.prefetch(child);
            }
            if !task.child.is_node() {
                self.reach(simd, task.child.held(), lists.of(&task), stream, interval, purpose, c);
            } else if task.len() >= FEW {
                c.cells += task.len() as u64;
                let node = &self.nodes[task.child.index()];
                pass(simd, &mut lists, &task, node, stream, interval.min);
            } else {
                for &ray in lists.of(&task) {
                    let straggler = Straggler { ray: ray as usize, interval };
                    straggler.go_on(simd, self, task.child.index(), &mut stack, stream, purpose, c);
                }
            }
        }
    }

    /// Looks into a leaf with all rays of a list.
    #[expect(clippy::too_many_arguments, reason = "all of them belong to one loop")]
    #[inline(always)]
    fn reach<S: Simd>(
        &self,
        simd: S,
        held: Held,
        list: &[u32],
        stream: &mut Stream,
        interval: Interval,
        purpose: &mut impl Purpose,
        c: &mut Counters,
    ) {
        let block = match held {
            Held::Block(index, len) => Some((&self.blocks[index], len)),
            _ => None,
        };
        reach(simd, block, list, stream, interval, &mut Leaf { bvh: self, held, purpose }, c);
    }
}

/// What is asked of a leaf.
struct Leaf<'a, 'g, P> {
    bvh: &'a Bvh<'g>,
    held: Held,
    purpose: &'a mut P,
}

impl<P: Purpose> Reached for Leaf<'_, '_, P> {
    #[inline(always)]
    fn ask<S: Simd>(&mut self, simd: S, at: &At, c: &mut Counters) -> f32 {
        self.purpose.leaf(simd, self.bvh, self.held, at, c)
    }
}

/// What rays of a stream have reached.
pub trait Reached {
    /// Asks it about one ray. Returns until where hits matter from now on, −∞ if none does.
    fn ask<S: Simd>(&mut self, simd: S, at: &At, c: &mut Counters) -> f32;
}

/// Asks what all rays of a list have reached about each: if it is so many triangles of a block, about
/// those that do not certainly pass them by.
#[inline(always)]
pub fn reach<S: Simd>(
    simd: S,
    block: Option<(&TriangleBlock, usize)>,
    list: &[u32],
    stream: &mut Stream,
    interval: Interval,
    reached: &mut impl Reached,
    c: &mut Counters,
) {
    let unfolded = match block {
        Some((block, len)) if list.len() >= UNFOLD => Some((Unfolded::of(&block.faces(simd)), len)),
        _ => None,
    };
    for list in list.chunks(RAYS) {
        let (rays, count) = eight(list);
        let mut left = (1 << count) - 1;
        if let Some((unfolded, len)) = &unfolded {
            let lines = Record::lines(simd, records_of(&stream.records, &rays), interval.min);
            left &= unfolded.rays_meeting(simd, &lines, *len);
            // Those that are left are counted when they are looked at.
            c.intersections += (len * (count - left.count_ones() as usize)) as u64;
        }
        for lane in lanes_of(left) {
            let ray = rays[lane] as usize;
            let record = &mut stream.records[ray];
            let filter = record.filter();
            let job = Job { filter: &filter, ray: &stream.rays[ray], interval };
            let last = reached.ask(simd, &At { job, ray, last: record.last() }, c);
            record.end_at(last, filter.errors.margin());
        }
    }
}

/// Sends the rays of a list to the children of a node whose boxes they meet.
#[inline(always)]
pub fn pass<S: Simd>(simd: S, lists: &mut Lists, task: &Task, node: &WideNode, stream: &Stream, min: f32) {
    let octant = stream.octant;
    let Sides { near, far } = Sides::of(simd, node, octant, stream.room);
    let (list, places, mut ends) = lists.split(task);
    let children = node.children();
    let of = |number: f32| f32x8::splat(simd, number);
    for list in list.chunks(RAYS) {
        let (records, count) = eight(list);
        let [ix, iy, iz, x, y, z, limit] = Record::beams(simd, records_of(&stream.records, &records));
        let records = u32x8::from_slice(simd, &records);
        for (child, end) in ends.iter_mut().enumerate().take(children) {
            let enter = of(near[0][child]).mul_sub(ix, x).max(of(near[1][child]).mul_sub(iy, y));
            let enter = enter.max(of(near[2][child]).mul_sub(iz, z)).max(of(min));
            let leave = of(far[0][child]).mul_sub(ix, x).min(of(far[1][child]).mul_sub(iy, y));
            let leave = leave.min(of(far[2][child]).mul_sub(iz, z)).min(limit);
            let met = enter.simd_le(leave);
            simd.compress_u32x8(records, met).store_slice(&mut places[*end..*end + RAYS]);
            *end += (met.to_bitmask() as u32 & ((1 << count) - 1)).count_ones() as usize;
        }
    }
    lists.push(task, &node.child, &ends, octant >> node.axis & 1 == 0);
}
