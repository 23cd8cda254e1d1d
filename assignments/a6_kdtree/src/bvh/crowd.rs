//! Rays that go their own ways, a step of each in turn.
//!
//! A ray alone waits for memory, and no processor guesses whether a node or a leaf comes next.
//! Here some rays are under way at a time: all that are at a node take a step, then all that are
//! at a leaf. Meanwhile the memory is asked for what each of them needs next.

use super::bundle::{Bundle, lanes_of};
use super::frustum::starts_together;
use super::packet::{Packet, RAYS};
use super::single::Query;
use super::slot::{DEEPEST, Slot};
use super::stack::Stack;
use super::wide::{Bvh, Held};
use common::accel::Job;
use common::counters::Counters;
use common::geometry::Hit;
use common::math::Interval;
use common::ray::Ray;
use common::simd::Simd;

/// Rays under way at a time, a power of two.
const SLOTS: usize = 16;

/// What rays are followed for.
pub trait Purpose {
    /// Whether a ray need not be followed.
    fn is_settled(&self, ray: usize) -> bool;

    /// Hits of a ray later than this do not matter.
    fn last(&self, ray: usize) -> f32;

    /// Looks into a leaf. Returns until where hits matter from now on; −∞ if none do.
    fn leaf<S: Simd>(&mut self, simd: S, bvh: &Bvh, held: Held, at: &At, c: &mut Counters) -> f32;

    /// Follows one ray all the way.
    fn alone<S: Simd>(&mut self, simd: S, bvh: &Bvh, query: &Query<RAYS>, ray: usize, c: &mut Counters);

    /// Follows rays from number `first` on, which run alongside each other.
    fn bundle<S: Simd>(&mut self, simd: S, bvh: &Bvh, bundle: &Bundle, first: usize, c: &mut Counters);
}

/// A ray at a leaf.
pub struct At<'a> {
    job: Job<'a>,
    /// Its number.
    ray: usize,
    /// Hits later than this do not matter.
    last: f32,
}

/// Looks for the first hit of each ray.
pub struct Nearest<'a> {
    /// Where hits count.
    pub interval: Interval,
    /// The best so far, by ray.
    pub best: &'a mut [Option<Hit>],
    /// For rays that are not followed in slots.
    pub stack: Stack,
}

impl Purpose for Nearest<'_> {
    #[inline(always)]
    fn is_settled(&self, _: usize) -> bool {
        false
    }

    #[inline(always)]
    fn last(&self, ray: usize) -> f32 {
        self.best[ray].map_or(self.interval.max, |b| b.t)
    }

    #[inline(always)]
    fn leaf<S: Simd>(&mut self, simd: S, bvh: &Bvh, held: Held, at: &At, c: &mut Counters) -> f32 {
        bvh.nearest_held(simd, held, &at.job, at.last, &mut self.best[at.ray], c)
    }

    #[inline(always)]
    fn alone<S: Simd>(&mut self, simd: S, bvh: &Bvh, query: &Query<RAYS>, ray: usize, c: &mut Counters) {
        self.best[ray] = bvh.nearest_one(simd, query, &mut self.stack, self.best[ray], c);
    }

    #[inline(always)]
    fn bundle<S: Simd>(&mut self, simd: S, bvh: &Bvh, bundle: &Bundle, first: usize, c: &mut Counters) {
        let best = &mut self.best[first..first + bundle.rays.len()];
        bvh.nearest_together(simd, bundle, &mut self.stack, best, c);
    }
}

/// Looks for any hit of each ray.
pub struct Blocked<'a> {
    /// Where hits count.
    pub interval: Interval,
    /// Whether there is one, by ray.
    pub hit: &'a mut [bool],
    /// For rays that are not followed in slots.
    pub stack: Stack,
}

impl Purpose for Blocked<'_> {
    #[inline(always)]
    fn is_settled(&self, ray: usize) -> bool {
        self.hit[ray]
    }

    #[inline(always)]
    fn last(&self, _: usize) -> f32 {
        self.interval.max
    }

    #[inline(always)]
    fn leaf<S: Simd>(&mut self, simd: S, bvh: &Bvh, held: Held, at: &At, c: &mut Counters) -> f32 {
        if bvh.any_held(simd, held, &at.job, c) {
            self.hit[at.ray] = true;
            return f32::NEG_INFINITY;
        }
        at.last
    }

    #[inline(always)]
    fn alone<S: Simd>(&mut self, simd: S, bvh: &Bvh, query: &Query<RAYS>, ray: usize, c: &mut Counters) {
        self.hit[ray] = bvh.any_one(simd, query, &mut self.stack, c);
    }

    #[inline(always)]
    fn bundle<S: Simd>(&mut self, simd: S, bvh: &Bvh, bundle: &Bundle, first: usize, c: &mut Counters) {
        let bits = bvh.any_together(simd, bundle, &mut self.stack, c);
        for (lane, hit) in self.hit[first..first + bundle.rays.len()].iter_mut().enumerate() {
            *hit |= bits >> lane & 1 == 1;
        }
    }
}

/// Numbers of slots.
#[derive(Clone, Copy)]
struct Line {
    slots: [u8; SLOTS],
    len: usize,
}

impl Line {
    const EMPTY: Self = Self { slots: [0; SLOTS], len: 0 };

    /// Adds one, if `really`; no branch is made of it.
    #[inline(always)]
    fn push(&mut self, slot: u8, really: bool) {
        self.slots[self.len % SLOTS] = slot;
        self.len += usize::from(really);
    }

    #[inline(always)]
    fn pop(&mut self) -> Option<u8> {
        self.len = self.len.checked_sub(1)?;
        Some(self.slots[self.len % SLOTS])
    }

    #[inline(always)]
    fn slots(&self) -> &[u8] {
        &self.slots[..self.len.min(SLOTS)]
    }
}

/// The slots, by what their rays do next.
#[derive(Clone, Copy)]
struct Lines {
    node: Line,
    leaf: Line,
    idle: Line,
}

impl Lines {
    /// Puts a slot where it belongs.
    #[inline(always)]
    fn put(&mut self, number: u8, slot: &Slot, under_way: bool) {
        if under_way {
            let is_node = slot.next.is_node();
            self.node.push(number, is_node);
            self.leaf.push(number, !is_node);
        } else {
            self.idle.push(number, true);
        }
    }
}

/// Rays that have not started.
struct Queue<'a> {
    rays: &'a [Ray],
    /// Eight of them, prepared …
    packet: Packet,
    /// … the first of which has this number …
    first: usize,
    /// … and those still to start, a bit for each.
    asked: u32,
    /// How many were looked at.
    seen: usize,
}

impl Bvh<'_> {
    /// Follows all rays.
    #[inline(always)]
    pub(super) fn follow<S: Simd>(
        &self,
        simd: S,
        rays: &[Ray],
        interval: Interval,
        purpose: &mut impl Purpose,
        c: &mut Counters,
    ) {
        let mut queue = Queue { rays, packet: Packet::EMPTY, first: 0, asked: 0, seen: 0 };
        let mut slots = [const { Slot::EMPTY }; SLOTS];
        let all = Line { slots: std::array::from_fn(|i| i as u8), len: SLOTS };
        let mut now = Lines { node: Line::EMPTY, leaf: Line::EMPTY, idle: all };
        loop {
            self.start(simd, &mut queue, interval, purpose, &mut slots, &mut now, c);
            if now.node.len + now.leaf.len == 0 {
                return;
            }
            let mut next = Lines { node: Line::EMPTY, leaf: Line::EMPTY, idle: now.idle };
            c.cells += now.node.len as u64;
            for &number in now.node.slots() {
                let slot = &mut slots[number as usize % SLOTS];
                let under_way = slot.enter(simd, &self.nodes, interval.min);
                next.put(number, slot, under_way);
            }
            for &number in now.leaf.slots() {
                let slot = &mut slots[number as usize % SLOTS];
                let job = Job { filter: &slot.filter, ray: &rays[slot.ray], interval };
                let at = At { job, ray: slot.ray, last: slot.last };
                let last = purpose.leaf(simd, self, slot.next.held(), &at, c);
                slot.end_at(last);
                let under_way = last > f32::NEG_INFINITY && slot.pop(simd, &self.nodes);
                next.put(number, slot, under_way);
            }
            for &number in next.node.slots() {
                self.prefetch_node(slots[number as usize % SLOTS].next.index());
            }
            for &number in next.leaf.slots() {
                self.prefetch(slots[number as usize % SLOTS].next);
            }
            now = next;
        }
    }

    /// Whether rays had better be followed one after the other. Those that start beside each
    /// other find what they need in the nearest cache, if all of the tree is in some cache.
    #[inline(always)]
    fn is_alone_better(&self, packet: &Packet) -> bool {
        self.depth > DEEPEST || !self.is_large() && starts_together(packet, &self.bounds)
    }

    /// Gives rays to idle slots.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "all of them belong to one loop")]
    fn start<S: Simd>(
        &self,
        simd: S,
        queue: &mut Queue,
        interval: Interval,
        purpose: &mut impl Purpose,
        slots: &mut [Slot; SLOTS],
        lines: &mut Lines,
        c: &mut Counters,
    ) {
        while lines.idle.len > 0 {
            if queue.asked == 0 {
                if queue.seen == queue.rays.len() {
                    return;
                }
                self.prepare(simd, queue, interval, purpose, c);
                continue;
            }
            let lane = queue.asked.trailing_zeros() as usize % RAYS;
            queue.asked &= queue.asked - 1;
            let Some(number) = lines.idle.pop() else { return };
            let (slot, ray) = (&mut slots[number as usize % SLOTS], queue.first + lane);
            slot.start(&queue.packet, lane, ray, purpose.last(ray));
            lines.node.push(number, true);
        }
    }

    /// Prepares the next eight rays; follows them at once if they are a bundle.
    #[inline(always)]
    fn prepare<S: Simd>(
        &self,
        simd: S,
        queue: &mut Queue,
        interval: Interval,
        purpose: &mut impl Purpose,
        c: &mut Counters,
    ) {
        queue.first = queue.seen;
        queue.seen = queue.rays.len().min(queue.first + RAYS);
        let rays = &queue.rays[queue.first..queue.seen];
        queue.packet = Packet::of(simd, rays, &self.bounds);
        queue.asked = queue.packet.usable;
        for lane in 0..RAYS {
            let settled = lane >= rays.len() || purpose.is_settled(queue.first + lane);
            queue.asked &= !(u32::from(settled) << lane);
        }
        if let Some(frustum) = self.frustum(&queue.packet, rays.len()) {
            let bundle =
                Bundle { packet: &queue.packet, frustum: &frustum, rays, asked: queue.asked, interval };
            purpose.bundle(simd, self, &bundle, queue.first, c);
            queue.asked = 0;
        } else if self.is_alone_better(&queue.packet) {
            for lane in lanes_of(queue.asked) {
                let query = Query { packet: &queue.packet, lane, ray: &rays[lane], interval };
                purpose.alone(simd, self, &query, queue.first + lane, c);
            }
            queue.asked = 0;
        }
    }
}
