//! Rays through the tree: the near side first, the far side only if it can matter.
//!
//! Everything is computed in `f64` from `f32` inputs: the distance to a plane is exact but for
//! three roundings of 2⁻⁵³, however far or oblique the ray, and nothing can overflow. Where a
//! plane is met within `slack` of either end of the stretch in question, both sides are
//! visited, so no rounding can lose a leaf that the ray passes.

use super::ask::Asker;
use super::query::{Prepared, Query};
use super::stack::{Stack, Waiting};
use super::tree::{KdTree, Node};
use crate::bvh::packet::{Packet, RAYS};
use common::accel::Accel;
use common::counters::Counters;
use common::geometry::{Geometry, Hit};
use common::math::Interval;
use common::ray::Ray;
use common::simd::{self, Simd, dispatch};

impl KdTree<'_> {
    /// The next leaf that the ray passes no later than `last`.
    ///
    /// Not inlined, so that all that it works with stays in registers. A third of the branches on
    /// which children are passed are mispredicted; yet without them every step waits for the one
    /// before, which takes longer.
    #[inline(never)]
    fn next_leaf(&self, query: &Query, stack: &mut Stack, last: f64, c: &mut Counters) -> Option<Node> {
        let Waiting { enter, mut exit, node } = stack.pop(last)?;
        if last < exit {
            exit = last;
        }
        let (mut node, mut steps, slack) = (self.nodes[node as usize], 0, query.slack);
        while !node.is_leaf() {
            steps += 1;
            let axis = node.axis();
            let t = query.meets(f64::from(node.at()), axis);
            let (before, after) = (t - slack, t + slack);
            let first = node.child() + query.backward[axis];
            let second = node.child() + (query.backward[axis] ^ 1);
            // NaN, a ray in the plane, compares false: both sides, all the way.
            node = if before > exit {
                self.nodes[first]
            } else if after < enter {
                self.nodes[second]
            } else {
                let from = if before > enter { before } else { enter };
                stack.push(Waiting { enter: from, exit, node: second as u32 });
                exit = if after < exit { after } else { exit };
                self.nodes[first]
            };
        }
        c.cells += steps;
        Some(node)
    }

    #[inline(always)]
    fn nearest_in<S: Simd>(
        &self,
        simd: S,
        (ray, prepared): (&Ray, Prepared),
        interval: Interval,
        stack: &mut Stack,
        mut best: Option<Hit>,
        c: &mut Counters,
    ) -> Option<Hit> {
        let query = Query::new(self, ray, prepared, interval);
        if query.passes_by() {
            return best;
        }
        let asker = Asker::new(simd, ray, interval, &query);
        stack.restart(query.enter, query.exit);
        let mut last = best.map_or(interval.max, |b| b.t);
        while let Some(leaf) = self.next_leaf(&query, stack, f64::from(last) + query.margin, c) {
            last = asker.nearest(self, self.held(leaf), last, &mut best, c);
        }
        best
    }

    #[inline(always)]
    fn any_in<S: Simd>(
        &self,
        simd: S,
        (ray, prepared): (&Ray, Prepared),
        interval: Interval,
        stack: &mut Stack,
        c: &mut Counters,
    ) -> bool {
        let query = Query::new(self, ray, prepared, interval);
        if query.passes_by() {
            return false;
        }
        let asker = Asker::new(simd, ray, interval, &query);
        stack.restart(query.enter, query.exit);
        while let Some(leaf) = self.next_leaf(&query, stack, f64::INFINITY, c) {
            if asker.any(self, self.held(leaf), c) {
                return true;
            }
        }
        false
    }

    /// One ray after the other, all with one stack.
    #[inline(always)]
    fn each_nearest<S: Simd>(
        &self,
        simd: S,
        rays: &[Ray],
        interval: Interval,
        hits: &mut [Option<Hit>],
        c: &mut Counters,
    ) {
        let mut stack = Stack::new();
        for (rays, hits) in rays.chunks(RAYS).zip(hits.chunks_mut(RAYS)) {
            let packet = self.packet(simd, rays);
            for (lane, (ray, hit)) in rays.iter().zip(hits).enumerate() {
                *hit = None;
                if ray.is_usable() {
                    let sheet = self.geometry.nearest_sheet(ray, interval, c);
                    let ready = (ray, self.prepare(simd, packet.as_ref(), lane, ray));
                    *hit = match self.nodes.is_empty() {
                        true => sheet,
                        false => self.nearest_in(simd, ready, interval, &mut stack, sheet, c),
                    };
                }
            }
        }
    }

    /// Some rays prepared together, if they are enough for that to pay.
    #[inline(always)]
    fn packet<S: Simd>(&self, simd: S, rays: &[Ray]) -> Option<Packet> {
        (rays.len() > RAYS / 4).then(|| Packet::of(simd, rays, &self.triangle_bounds))
    }

    /// One of those, or a ray by itself.
    #[inline(always)]
    fn prepare<S: Simd>(&self, simd: S, packet: Option<&Packet>, lane: usize, ray: &Ray) -> Prepared {
        match packet {
            Some(packet) => Prepared::of(packet, lane),
            None => Prepared::of(&Packet::alone(simd, ray, &self.triangle_bounds), 0),
        }
    }

    #[inline(always)]
    fn each_any<S: Simd>(
        &self,
        simd: S,
        rays: &[Ray],
        interval: Interval,
        hit: &mut [bool],
        c: &mut Counters,
    ) {
        let mut stack = Stack::new();
        for (rays, hits) in rays.chunks(RAYS).zip(hit.chunks_mut(RAYS)) {
            let packet = self.packet(simd, rays);
            for (lane, (ray, hit)) in rays.iter().zip(hits).enumerate() {
                *hit = ray.is_usable() && self.geometry.any_sheet(ray, interval, c);
                if ray.is_usable() && !*hit && !self.nodes.is_empty() {
                    let ready = (ray, self.prepare(simd, packet.as_ref(), lane, ray));
                    *hit = self.any_in(simd, ready, interval, &mut stack, c);
                }
            }
        }
    }
}

impl Accel for KdTree<'_> {
    fn nearest(&self, ray: &Ray, interval: Interval, counters: &mut Counters) -> Option<Hit> {
        let mut hit = [None];
        self.nearest_many(std::slice::from_ref(ray), interval, &mut hit, counters);
        hit[0]
    }

    fn any(&self, ray: &Ray, interval: Interval, counters: &mut Counters) -> bool {
        let mut hit = [false];
        self.any_many(std::slice::from_ref(ray), interval, &mut hit, counters);
        hit[0]
    }

    fn nearest_many(
        &self,
        rays: &[Ray],
        interval: Interval,
        hits: &mut [Option<Hit>],
        counters: &mut Counters,
    ) {
        assert_eq!(rays.len(), hits.len());
        dispatch!(simd::level(), s => self.each_nearest(s, rays, interval, hits, counters));
    }

    fn any_many(&self, rays: &[Ray], interval: Interval, hit: &mut [bool], counters: &mut Counters) {
        assert_eq!(rays.len(), hit.len());
        dispatch!(simd::level(), s => self.each_any(s, rays, interval, hit, counters));
    }

    fn geometry(&self) -> &Geometry {
        self.geometry
    }

    fn validate(&self) -> Result<(), String> {
        self.check()
    }
}
