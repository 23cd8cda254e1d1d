//! One ray through the tree.

use super::packet::{Packet, first_child};
use super::stack::{Stack, Waiting};
use super::wide::{Bvh, Held, WIDTH};
use common::accel::Job;
use common::counters::Counters;
use common::geometry::Hit;
use common::math::Interval;
use common::ray::Ray;
use common::shape::ExactRay;
use common::simd::{Simd, SimdBase, SimdMask, f32x8};

/// More than the rounding of t at both sides of a comparison; relative to t.
const ROUNDING: f32 = 1.0 / (1 << 20) as f32;

/// A box that is entered later than this holds nothing that could come before a hit at `t`, or
/// tie with it, or lie in an interval that ends there.
#[inline(always)]
pub fn limit(t: f32, margin: f32) -> f32 {
    // A branch, so that the first node need not wait for the margin of an endless ray.
    if t == f32::INFINITY { t } else { t + t.abs() * ROUNDING + margin }
}

/// A bit for every child that is entered no later than `max`.
#[inline(always)]
pub fn entered_before<S: Simd>(simd: S, enter: &[f32; WIDTH], max: f32) -> u32 {
    f32x8::from_slice(simd, enter).simd_le(f32x8::splat(simd, max)).to_bitmask() as u32
}

/// One ray of a packet, and the stretch in which hits count.
pub struct Query<'p, const N: usize> {
    /// Its packet.
    pub packet: &'p Packet<N>,
    /// Its place there.
    pub lane: usize,
    /// The ray itself.
    pub ray: &'p Ray,
    /// Where hits count.
    pub interval: Interval,
}

impl Bvh<'_> {
    /// The better of `best` and the first hit of the ray.
    #[inline(always)]
    pub(super) fn nearest_one<S: Simd, const N: usize>(
        &self,
        simd: S,
        query: &Query<N>,
        stack: &mut Stack,
        mut best: Option<Hit>,
        c: &mut Counters,
    ) -> Option<Hit> {
        let Query { packet, lane, ray, interval } = *query;
        let filter = &packet.filter(lane);
        // Hidden, or the compiler would spread all of it out for every ray, while most rays reach
        // two blocks or none.
        let filter = std::hint::black_box(filter);
        let margin = packet.margin(lane);
        let backward = packet.backward[lane];
        let job = Job { filter, ray, interval };
        stack.clear();
        let mut last = best.map_or(interval.max, |b| b.t);
        let mut max = limit(last, margin);
        let mut at = Waiting { enter: [0.0; WIDTH], node: 0, lanes: 0 };
        at.lanes = packet.meet(simd, lane, &self.nodes[0], Interval { max, ..interval }, &mut at.enter);
        c.cells += 1;
        loop {
            if at.lanes == 0 {
                let Some(next) = stack.pop() else { return best };
                at = next;
                at.lanes &= entered_before(simd, &at.enter, max);
                continue;
            }
            let node = &self.nodes[at.node];
            let child = first_child(at.lanes, node.axis, backward);
            at.lanes &= !(1 << child);
            if self.is_large() {
                self.prefetch(node.child[first_child(at.lanes, node.axis, backward)]);
            }
            match node.child[child].held() {
                Held::Node(below) => {
                    stack.push(&at);
                    c.cells += 1;
                    let (node, stretch) = (&self.nodes[below], Interval { max, ..interval });
                    at.node = below;
                    at.lanes = packet.meet(simd, lane, node, stretch, &mut at.enter);
                    continue;
                }
                Held::Block(index, len) => {
                    last = job.nearest_of(simd, &self.blocks[index], len, last, &mut best, c);
                }
                Held::Solids(first, count) => {
                    let solids = self.solids[first..first + count].iter().copied();
                    best = self.geometry.nearest_solid(solids, &ExactRay::new(ray), interval, best, c);
                    last = best.map_or(last, |b| if b.t < last { b.t } else { last });
                }
            }
            max = limit(last, margin);
            at.lanes &= entered_before(simd, &at.enter, max);
        }
    }

    /// Whether the ray hits anything.
    #[inline(always)]
    pub(super) fn any_one<S: Simd, const N: usize>(
        &self,
        simd: S,
        query: &Query<N>,
        stack: &mut Stack,
        c: &mut Counters,
    ) -> bool {
        let Query { packet, lane, ray, interval } = *query;
        let filter = &packet.filter(lane);
        // Hidden, or the compiler would spread all of it out for every ray, while most rays reach
        // two blocks or none.
        let filter = std::hint::black_box(filter);
        let backward = packet.backward[lane];
        let job = Job { filter, ray, interval };
        stack.clear();
        let stretch = Interval { max: limit(interval.max, packet.margin(lane)), ..interval };
        let mut at = Waiting { enter: [0.0; WIDTH], node: 0, lanes: 0 };
        at.lanes = packet.meet(simd, lane, &self.nodes[0], stretch, &mut at.enter);
        c.cells += 1;
        loop {
            if at.lanes == 0 {
                let Some(next) = stack.pop() else { return false };
                at = next;
            }
            let node = &self.nodes[at.node];
            let child = first_child(at.lanes, node.axis, backward);
            at.lanes &= !(1 << child);
            if self.is_large() {
                self.prefetch(node.child[first_child(at.lanes, node.axis, backward)]);
            }
            match node.child[child].held() {
                Held::Node(below) => {
                    stack.push(&at);
                    c.cells += 1;
                    at.node = below;
                    at.lanes = packet.meet(simd, lane, &self.nodes[below], stretch, &mut at.enter);
                }
                Held::Block(index, len) => {
                    if job.any_of(simd, &self.blocks[index], len, c) {
                        return true;
                    }
                }
                Held::Solids(first, count) => {
                    let solids = self.solids[first..first + count].iter().copied();
                    if self.geometry.any_solid(solids, &ExactRay::new(ray), interval, c) {
                        return true;
                    }
                }
            }
        }
    }
}
