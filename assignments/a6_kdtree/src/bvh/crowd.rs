//! Rays that go their own ways, a step of each in turn.
//!
//! A ray alone waits for memory, and no processor guesses whether a node or a leaf comes next.
//! Here some rays are under way at a time: all that are at a node take a step, then all that are
//! at a leaf. Meanwhile the memory is asked for what each of them needs next.

use super::abreast::columns;
use super::bundle::{Bundle, lanes_of};
use super::frustum::{go_one_way, starts_together};
use super::inlet::Inlet;
use super::lines::{Line, Lines, SLOTS};
use super::packet::{Packet, RAYS};
use super::purpose::{At, Purpose};
use super::single::Query;
use super::slot::{DEEPEST, Slot};
use super::wide::Bvh;
use common::accel::Job;
use common::counters::Counters;
use common::math::Interval;
use common::math::lanes::load;
use common::ray::Ray;
use common::simd::Simd;

/// Nodes of a tree that the nearest cache holds beside all else.
const FEW: usize = 8;

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
    /// Where those go that are better off in a stream.
    inlet: Option<Inlet<'a>>,
}

impl Bvh<'_> {
    /// Follows all rays but those that it puts into a stream, if there is one.
    #[inline(always)]
    pub(super) fn follow<S: Simd>(
        &self,
        simd: S,
        rays: &[Ray],
        inlet: Option<Inlet>,
        interval: Interval,
        purpose: &mut impl Purpose,
        c: &mut Counters,
    ) {
        let mut queue = Queue { rays, packet: Packet::EMPTY, first: 0, asked: 0, seen: 0, inlet };
        if rays.len() < SLOTS {
            // Too few to hide behind each other.
            while queue.seen < rays.len() {
                self.prepare(simd, &mut queue, true, interval, purpose, c);
            }
            return;
        }
        // Where all rays go in bundles no slot is needed, and setting them up takes as long as some rays.
        while queue.asked == 0 {
            if queue.seen == rays.len() {
                return;
            }
            self.prepare(simd, &mut queue, false, interval, purpose, c);
        }
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
                self.nodes[slots[number as usize % SLOTS].next.index()].prefetch();
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
    fn is_alone_better<S: Simd>(&self, simd: S, packet: &Packet) -> bool {
        self.depth > DEEPEST
            || self.nodes.len() <= FEW
            || !self.is_large() && starts_together(simd, packet, &self.bounds)
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
                self.prepare(simd, queue, false, interval, purpose, c);
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

    /// Lets the next rays join those that wait for a stream, if all that are no bundle are better off so,
    /// before more is worked out of them.
    #[inline(always)]
    fn join_at_once<S: Simd>(&self, simd: S, queue: &mut Queue) {
        let Queue { rays, first, seen, asked, inlet: Some(inlet), .. } = queue else { return };
        if !inlet.pool.takes_all() {
            return;
        }
        let rays = &rays[*first..*seen];
        let all = columns(simd, rays, rays[0]);
        if !go_one_way(simd, all[1]) {
            *asked = inlet.pool.take(simd, all, *asked, &inlet.eight(*first, rays.len()));
        }
    }

    /// The same for prepared rays that are no bundle.
    #[inline(always)]
    fn join<S: Simd>(&self, simd: S, queue: &mut Queue) {
        let Queue { packet, first, seen, asked, inlet: Some(inlet), .. } = queue else { return };
        if inlet.pool.takes_all() || starts_together(simd, packet, &self.bounds) {
            let all = [load(simd, &packet.origin), load(simd, &packet.direction)];
            *asked = inlet.pool.take(simd, all, *asked, &inlet.eight(*first, *seen - *first));
        }
    }

    /// Prepares the next eight rays; follows them at once if they are a bundle, or are to go alone,
    /// and lets them join the stream if that is better.
    #[inline(always)]
    fn prepare<S: Simd>(
        &self,
        simd: S,
        queue: &mut Queue,
        alone: bool,
        interval: Interval,
        purpose: &mut impl Purpose,
        c: &mut Counters,
    ) {
        queue.first = queue.seen;
        queue.seen = queue.rays.len().min(queue.first + RAYS);
        let rays = &queue.rays[queue.first..queue.seen];
        queue.asked = (1 << rays.len()) - 1;
        for lane in 0..rays.len() {
            queue.asked &= !(u32::from(purpose.is_settled(queue.first + lane)) << lane);
        }
        self.join_at_once(simd, queue);
        if queue.asked == 0 {
            return;
        }
        queue.packet = Packet::of(simd, rays, &self.bounds);
        queue.asked &= queue.packet.usable;
        if queue.asked == 0 {
            return;
        }
        if let Some(frustum) = self.frustum(simd, &queue.packet, rays.len()) {
            let bundle =
                Bundle { packet: &queue.packet, frustum: &frustum, rays, asked: queue.asked, interval };
            purpose.bundle(simd, self, &bundle, queue.first, c);
            queue.asked = 0;
            return;
        }
        self.join(simd, queue);
        if alone || self.is_alone_better(simd, &queue.packet) {
            for lane in lanes_of(queue.asked) {
                let query = Query { packet: &queue.packet, lane, ray: &rays[lane], interval };
                purpose.alone(simd, self, &query, queue.first + lane, c);
            }
            queue.asked = 0;
        }
    }
}
