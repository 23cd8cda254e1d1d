//! Rays before they are followed: which go together, which alone, which wait for a stream.

use super::abreast::columns;
use super::bundle::{Bundle, MOST, lanes_of};
use super::frustum::{Frustum, go_one_way, may_be_bundle, starts_together};
use super::inlet::Inlet;
use super::packet::{Lanes, Packet, RAYS};
use super::purpose::Purpose;
use super::single::Query;
use super::slot::DEEPEST;
use super::wide::Bvh;
use common::counters::Counters;
use common::math::Interval;
use common::math::lanes::Vectors;
use common::ray::Ray;
use common::simd::{Simd, SimdBase, f32x8};

/// Nodes of a tree that the nearest cache holds beside all else.
const FEW: usize = 8;

/// Fewer rays are faster one by one.
const BUNDLE: usize = 4;

/// Rays that have not started.
pub struct Queue<'a> {
    /// All rays.
    pub rays: &'a [Ray],
    /// Those before this number are no large bundle.
    apart: usize,
    /// Those of a bundle, or eight of them, prepared …
    pub packet: Packet<MOST>,
    /// … the first of which has this number …
    pub first: usize,
    /// … and those still to start, a bit for each.
    pub asked: u32,
    /// How many were looked at.
    pub seen: usize,
    /// Where those go that are better off in a stream.
    inlet: Option<Inlet<'a>>,
}

impl<'a> Queue<'a> {
    /// Of all these.
    pub fn of(rays: &'a [Ray], inlet: Option<Inlet<'a>>) -> Self {
        Self { rays, apart: 0, packet: Packet::EMPTY, first: 0, asked: 0, seen: 0, inlet }
    }
}

/// A bit for each of some rays, the first of which has this number, that must be followed.
#[inline(always)]
fn unsettled(purpose: &impl Purpose, first: usize, count: usize) -> u32 {
    let mut bits = 0;
    for lane in 0..count {
        bits |= u32::from(!purpose.is_settled(first + lane)) << lane;
    }
    bits
}

/// The first eight.
#[inline(always)]
fn eight<S: Simd>(simd: S, v: &[Lanes<MOST>; 3]) -> Vectors<f32x8<S>> {
    [
        f32x8::from_slice(simd, &v[0][..RAYS]),
        f32x8::from_slice(simd, &v[1][..RAYS]),
        f32x8::from_slice(simd, &v[2][..RAYS]),
    ]
}

impl Bvh<'_> {
    /// Whether rays had better be followed one after the other. Those that start beside each
    /// other find what they need in the nearest cache, if all of the tree is in some cache.
    #[inline(always)]
    fn is_alone_better<S: Simd>(&self, simd: S, packet: &Packet<MOST>) -> bool {
        self.depth > DEEPEST
            || self.nodes.len() <= FEW
            || !self.is_large() && starts_together(simd, packet, &self.bounds)
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
            let all = [eight(simd, &packet.origin), eight(simd, &packet.direction)];
            *asked = inlet.pool.take(simd, all, *asked, &inlet.eight(*first, *seen - *first));
        }
    }

    /// Follows the next rays if as many as can be are a bundle.
    #[inline(always)]
    fn bundle<S: Simd>(
        &self,
        simd: S,
        queue: &mut Queue,
        interval: Interval,
        purpose: &mut impl Purpose,
        c: &mut Counters,
    ) -> bool {
        let first = queue.first;
        let Some(rays) = queue.rays.get(first..first + MOST) else { return false };
        if first < queue.apart || !may_be_bundle(&rays[0], &rays[MOST - 1], &self.bounds) {
            return false;
        }
        purpose.look_ahead(first, MOST);
        for at in (0..MOST).step_by(RAYS) {
            queue.packet.put(simd, at, &rays[at..at + RAYS], &self.bounds);
        }
        let Some(frustum) = Frustum::around(simd, &queue.packet, MOST, &self.bounds) else {
            queue.apart = first + MOST;
            return false;
        };
        queue.seen = first + MOST;
        let asked = unsettled(purpose, first, MOST);
        if asked != 0 {
            let bundle = Bundle::new(simd, (&queue.packet, &frustum), rays, asked, interval, &self.bounds);
            purpose.bundle(simd, self, &bundle, first, c);
        }
        purpose.decide(simd, self, queue.rays, false, c);
        true
    }

    /// Prepares the next eight rays; follows them at once if they are a bundle, or are to go alone,
    /// and lets them join the stream if that is better.
    #[inline(always)]
    pub(super) fn prepare<S: Simd>(
        &self,
        simd: S,
        queue: &mut Queue,
        alone: bool,
        interval: Interval,
        purpose: &mut impl Purpose,
        c: &mut Counters,
    ) {
        queue.first = queue.seen;
        if self.bundle(simd, queue, interval, purpose, c) {
            return;
        }
        queue.seen = queue.rays.len().min(queue.first + RAYS);
        let rays = &queue.rays[queue.first..queue.seen];
        queue.asked = unsettled(purpose, queue.first, rays.len());
        self.join_at_once(simd, queue);
        if queue.asked == 0 {
            return;
        }
        queue.packet.put(simd, 0, rays, &self.bounds);
        queue.asked &= queue.packet.usable;
        if queue.asked == 0 {
            return;
        }
        if rays.len() >= BUNDLE
            && let Some(frustum) = Frustum::around(simd, &queue.packet, RAYS, &self.bounds)
        {
            let asked = std::mem::take(&mut queue.asked);
            let bundle = Bundle::new(simd, (&queue.packet, &frustum), rays, asked, interval, &self.bounds);
            return purpose.bundle(simd, self, &bundle, queue.first, c);
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
