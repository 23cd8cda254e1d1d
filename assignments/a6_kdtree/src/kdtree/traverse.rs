//! Rays through the tree: the near side first, the far side only if it can matter.
//!
//! Everything is computed in `f64` from `f32` inputs: the distance to a plane is exact but for
//! three roundings of 2⁻⁵³, however far or oblique the ray, and nothing can overflow. Where a
//! plane is met within `slack` of either end of the stretch in question, both sides are
//! visited, so no rounding can lose a leaf that the ray passes.

use super::ask::{Answer, Asker};
use super::current::Current;
use super::query::{Prepared, Query};
use super::stack::{Stack, Waiting};
use super::tree::{KdTree, Node};
use crate::bvh::abreast::columns;
use crate::bvh::bundle::lanes_of;
use crate::bvh::packet::{Packet, RAYS};
use crate::bvh::pool::Pool;
use crate::bvh::wide::WIDTH;
use common::accel::Accel;
use common::counters::Counters;
use common::geometry::{Geometry, Hit};
use common::math::Interval;
use common::ray::Ray;
use common::simd::{self, Simd, dispatch};

/// Rays that are looked at before those that wait may flow.
const PART: usize = 256;

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

    /// Follows a ray from the root, or from a node and with a bound of where hits matter.
    #[expect(clippy::too_many_arguments, reason = "all of them belong to one loop")]
    #[inline(always)]
    pub(super) fn follow<S: Simd, T: Answer>(
        &self,
        simd: S,
        (ray, prepared): (&Ray, Prepared),
        interval: Interval,
        from: Option<(Waiting, f32)>,
        stack: &mut Stack,
        answer: &mut T,
        c: &mut Counters,
    ) -> f32 {
        let query = Query::new(self, ray, prepared, interval);
        let (first, mut last) = from.unwrap_or((query.start(), answer.last(interval.max)));
        if query.passes_by() {
            return last;
        }
        let asker = Asker::new(simd, ray, interval, &query);
        stack.restart(first);
        while last > f32::NEG_INFINITY
            && let Some(leaf) = self.next_leaf(&query, stack, f64::from(last) + query.margin, c)
        {
            last = asker.leaf(self, self.held(leaf), last, answer, c);
        }
        last
    }

    /// Asks about up to eight rays, but those that wait in the pool.
    #[expect(clippy::too_many_arguments, reason = "all of them belong to one loop")]
    #[inline(always)]
    fn eight<S: Simd, T: Answer>(
        &self,
        simd: S,
        rays: &[Ray],
        interval: Interval,
        answers: &mut [T],
        (pool, first): (Option<&mut Pool>, usize),
        stack: &mut Stack,
        c: &mut Counters,
    ) {
        let mut asked = 0;
        for (lane, (ray, answer)) in rays.iter().zip(&mut *answers).enumerate() {
            *answer = T::NONE;
            if ray.is_usable() {
                *answer = T::beside(self.geometry, ray, interval, c);
                let is_open = answer.last(interval.max) > f32::NEG_INFINITY && !self.nodes.is_empty();
                asked |= u32::from(is_open) << lane;
            }
        }
        if let Some(pool) = pool {
            let numbers = [0, 1, 2, 3, 4, 5, 6, 7].map(|lane| first as u32 + lane);
            asked = pool.take(simd, columns(simd, rays, rays[0]), asked, &numbers);
        }
        if asked == 0 {
            return;
        }
        let packet = self.packet(simd, rays);
        for lane in lanes_of(asked) {
            let ready = (&rays[lane], self.prepare(simd, packet.as_ref(), lane, &rays[lane]));
            self.follow(simd, ready, interval, None, stack, &mut answers[lane], c);
        }
    }

    /// Asks about all rays.
    fn ask<T: Answer>(&self, rays: &[Ray], interval: Interval, answers: &mut [T], c: &mut Counters) {
        assert_eq!(rays.len(), answers.len());
        let mut current = Current::new();
        // A node of the hierarchy, by which pools count, stands for so many planes.
        let nodes = self.nodes.len() / WIDTH;
        let mut pool = match self.mixed.is_empty() {
            true => Pool::of_many(rays.len(), nodes, &self.triangle_bounds),
            false => None,
        };
        for first in (0..rays.len()).step_by(PART) {
            let part = first..rays.len().min(first + PART);
            let is_last = part.end == rays.len();
            dispatch!(simd::level(), s => {
                for first in part.step_by(RAYS) {
                    let eight = first..rays.len().min(first + RAYS);
                    let (rays, answers) = (&rays[eight.clone()], &mut answers[eight]);
                    self.eight(s, rays, interval, answers, (pool.as_mut(), first), &mut current.stack, c);
                }
            });
            if let Some(pool) = pool.as_mut().filter(|pool| pool.is_full() || is_last) {
                let is_new = self.geometry.sheets().is_empty();
                pool.let_flow(rays, interval.max, (answers, is_new), |stream, answers| {
                    dispatch!(simd::level(), s => self.flow(s, stream, interval, answers, &mut current, c));
                });
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
}

impl Accel for KdTree<'_> {
    fn nearest(&self, ray: &Ray, interval: Interval, counters: &mut Counters) -> Option<Hit> {
        let mut hit = [None];
        self.ask(std::slice::from_ref(ray), interval, &mut hit, counters);
        hit[0]
    }

    fn any(&self, ray: &Ray, interval: Interval, counters: &mut Counters) -> bool {
        let mut hit = [false];
        self.ask(std::slice::from_ref(ray), interval, &mut hit, counters);
        hit[0]
    }

    fn nearest_many(
        &self,
        rays: &[Ray],
        interval: Interval,
        hits: &mut [Option<Hit>],
        counters: &mut Counters,
    ) {
        self.ask(rays, interval, hits, counters);
    }

    fn any_many(&self, rays: &[Ray], interval: Interval, hit: &mut [bool], counters: &mut Counters) {
        self.ask(rays, interval, hit, counters);
    }

    fn geometry(&self) -> &Geometry {
        self.geometry
    }

    fn validate(&self) -> Result<(), String> {
        self.check()
    }
}
