//! Rays that go their own ways, a step of each in turn.
//!
//! A ray alone waits for memory, and no processor guesses whether a node or a leaf comes next.
//! Here some rays are under way at a time: all that are at a node take a step, then all that are
//! at a leaf. Meanwhile the memory is asked for what each of them needs next.

use super::inlet::Inlet;
use super::lines::{Line, Lines, SLOTS};
use super::packet::RAYS;
use super::purpose::{At, Purpose};
use super::queue::Queue;
use super::slot::Slot;
use super::wide::Bvh;
use common::accel::Job;
use common::counters::Counters;
use common::math::Interval;
use common::ray::Ray;
use common::simd::Simd;

impl Bvh<'_> {
    /// Follows all rays but those that it puts into a stream, if there is one.
    #[inline(always)]
    pub(super) fn follow<S: Simd, P: Purpose>(
        &self,
        simd: S,
        rays: &[Ray],
        inlet: Option<Inlet>,
        interval: Interval,
        purpose: &mut P,
        c: &mut Counters,
    ) {
        let mut queue = Queue::of(rays, inlet);
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
                let under_way = slot.enter::<S, P>(simd, &self.nodes, interval.min);
                next.put(number, slot, under_way);
            }
            for &number in now.leaf.slots() {
                let slot = &mut slots[number as usize % SLOTS];
                let job = Job { filter: &slot.filter, ray: &rays[slot.ray], interval };
                let at = At { job, ray: slot.ray, last: slot.last };
                let last = purpose.leaf(simd, self, slot.next.held(), &at, c);
                slot.end_at(last);
                let under_way = last > f32::NEG_INFINITY && slot.pop::<S, P>(simd, &self.nodes);
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
}
