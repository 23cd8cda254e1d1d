//! Up to eight rays that run alongside each other through the tree together.

use super::frustum::Frustum;
use super::packet::{Lanes, Packet, RAYS, first_child};
use super::single::{entered_before, limit};
use super::stack::{Stack, Waiting};
use super::wide::{Bvh, Held, WIDTH};
use common::accel::Job;
use common::counters::Counters;
use common::geometry::Hit;
use common::math::Interval;
use common::ray::Ray;
use common::shape::ExactRay;
use common::simd::Simd;

/// Rays that go together.
pub struct Bundle<'p> {
    /// The rays, prepared.
    pub packet: &'p Packet,
    /// What encloses them.
    pub frustum: &'p Frustum,
    /// The rays themselves.
    pub rays: &'p [Ray],
    /// A bit for each that is asked for.
    pub asked: u32,
    /// Where hits count.
    pub interval: Interval,
}

impl Bvh<'_> {
    /// Puts the better of what is there and the first hit of each ray into `best`.
    #[inline(always)]
    pub(super) fn nearest_together<S: Simd>(
        &self,
        simd: S,
        bundle: &Bundle,
        stack: &mut Stack,
        best: &mut [Option<Hit>],
        c: &mut Counters,
    ) {
        let Bundle { packet, frustum, rays, asked, interval } = *bundle;
        let mut last: Lanes = [f32::NEG_INFINITY; RAYS];
        let mut limits: Lanes = [f32::NEG_INFINITY; RAYS];
        let mut max = f32::NEG_INFINITY;
        for lane in lanes_of(asked) {
            last[lane] = best[lane].map_or(interval.max, |b| b.t);
            limits[lane] = limit(last[lane], packet.margin(lane));
            max = max.max(limits[lane]);
        }
        stack.clear();
        let mut at = Waiting { enter: [0.0; WIDTH], node: 0, lanes: 0 };
        at.lanes = frustum.meet(simd, &self.nodes[0], interval.min, max, &mut at.enter);
        c.cells += 1;
        loop {
            if at.lanes == 0 {
                let Some(next) = stack.pop() else { return };
                at = next;
                at.lanes &= entered_before(simd, &at.enter, max);
                continue;
            }
            let node = &self.nodes[at.node];
            let child = first_child(at.lanes, node.axis, frustum.backward);
            at.lanes &= !(1 << child);
            if self.is_large() {
                self.prefetch(node.child[first_child(at.lanes, node.axis, frustum.backward)]);
            }
            let held = node.child[child].held();
            if let Held::Node(below) = held {
                stack.push(&at);
                c.cells += 1;
                at.node = below;
                at.lanes = frustum.meet(simd, &self.nodes[below], interval.min, max, &mut at.enter);
                continue;
            }
            let meeting = packet.rays_meeting(simd, node, child, frustum.backward, interval.min, &limits);
            for lane in lanes_of(meeting & asked) {
                let ray = &rays[lane];
                match held {
                    Held::Block(index, len) => {
                        let job = Job { filter: &packet.filter(lane), ray, interval };
                        let block = &self.blocks[index];
                        last[lane] = job.nearest_of(simd, block, len, last[lane], &mut best[lane], c);
                    }
                    Held::Solids(first, count) => {
                        let (solids, exact) = (&self.solids[first..first + count], ExactRay::new(ray));
                        let solids = solids.iter().copied();
                        best[lane] = self.geometry.nearest_solid(solids, &exact, interval, best[lane], c);
                        last[lane] = best[lane].map_or(last[lane], |b| b.t.min(last[lane]));
                    }
                    Held::Node(_) => {}
                }
                limits[lane] = limit(last[lane], packet.margin(lane));
            }
            max = limits.iter().fold(f32::NEG_INFINITY, |m, &l| if l > m { l } else { m });
            at.lanes &= entered_before(simd, &at.enter, max);
        }
    }

    /// A bit for each of the asked rays that hits anything.
    #[inline(always)]
    pub(super) fn any_together<S: Simd>(
        &self,
        simd: S,
        bundle: &Bundle,
        stack: &mut Stack,
        c: &mut Counters,
    ) -> u32 {
        let Bundle { packet, frustum, rays, asked, interval } = *bundle;
        let mut limits: Lanes = [f32::NEG_INFINITY; RAYS];
        let mut max = f32::NEG_INFINITY;
        for lane in lanes_of(asked) {
            limits[lane] = limit(interval.max, packet.margin(lane));
            max = max.max(limits[lane]);
        }
        let mut hit = 0;
        stack.clear();
        let mut at = Waiting { enter: [0.0; WIDTH], node: 0, lanes: 0 };
        at.lanes = frustum.meet(simd, &self.nodes[0], interval.min, max, &mut at.enter);
        c.cells += 1;
        loop {
            if at.lanes == 0 {
                let Some(next) = stack.pop() else { return hit };
                at = next;
            }
            let node = &self.nodes[at.node];
            let child = first_child(at.lanes, node.axis, frustum.backward);
            at.lanes &= !(1 << child);
            if self.is_large() {
                self.prefetch(node.child[first_child(at.lanes, node.axis, frustum.backward)]);
            }
            let held = node.child[child].held();
            if let Held::Node(below) = held {
                stack.push(&at);
                c.cells += 1;
                at.node = below;
                at.lanes = frustum.meet(simd, &self.nodes[below], interval.min, max, &mut at.enter);
                continue;
            }
            let meeting = packet.rays_meeting(simd, node, child, frustum.backward, interval.min, &limits);
            for lane in lanes_of(meeting & asked & !hit) {
                let ray = &rays[lane];
                let blocked = match held {
                    Held::Block(index, len) => {
                        let job = Job { filter: &packet.filter(lane), ray, interval };
                        job.any_of(simd, &self.blocks[index], len, c)
                    }
                    Held::Solids(first, count) => {
                        let solids = self.solids[first..first + count].iter().copied();
                        self.geometry.any_solid(solids, &ExactRay::new(ray), interval, c)
                    }
                    Held::Node(_) => false,
                };
                hit |= u32::from(blocked) << lane;
            }
            if hit == asked {
                return hit;
            }
        }
    }
}

/// The numbers of the bits that are set.
#[inline(always)]
fn lanes_of(mut bits: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lane = bits.trailing_zeros() as usize;
        (bits != 0).then(|| {
            bits &= bits - 1;
            lane % RAYS
        })
    })
}
