//! Questions to the tree: one ray, or many.

use super::inlet::Inlet;
use super::known::Known;
use super::packet::Packet;
use super::pool::Pool;
use super::purpose::{Ahead, Notes, Purpose};
use super::single::Query;
use super::stack::Stack;
use super::stream::MANY;
use super::wide::Bvh;
use common::accel::Accel;
use common::counters::Counters;
use common::geometry::{Geometry, Hit};
use common::math::Interval;
use common::ray::Ray;
use common::simd::{self, Simd, dispatch};
use std::ops::Range;

impl Bvh<'_> {
    /// The better of `best` and the first hit of what is in the tree, without planes and what else
    /// stands beside it.
    #[inline(always)]
    pub(crate) fn nearest_alone<S: Simd>(
        &self,
        simd: S,
        ray: &Ray,
        interval: Interval,
        best: Option<Hit>,
        c: &mut Counters,
    ) -> Option<Hit> {
        let packet = &Packet::alone(simd, ray, &self.bounds);
        self.nearest_one(simd, &Query { packet, lane: 0, ray, interval }, &mut Stack::new(), best, c)
    }

    /// Whether anything in the tree is hit, without what stands beside it.
    #[inline(always)]
    pub(crate) fn any_alone<S: Simd>(
        &self,
        simd: S,
        ray: &Ray,
        interval: Interval,
        c: &mut Counters,
    ) -> bool {
        let packet = &Packet::alone(simd, ray, &self.bounds);
        self.any_one(simd, &Query { packet, lane: 0, ray, interval }, &mut Stack::new(), c)
    }

    /// Asks about all rays.
    fn ask<T: Known>(&self, rays: &[Ray], interval: Interval, known: &mut [T], c: &mut Counters) {
        let pool = Pool::of_many(rays.len(), self.nodes.len(), &self.bounds);
        let mut desk = Desk { notes: Notes::new(), pool };
        // Where other things stand beside the tree it is asked of few rays, which had better be put
        // together.
        let size = if self.stands_alone() { PART } else { MANY };
        for first in (0..rays.len()).step_by(size) {
            let part = first..rays.len().min(first + size);
            let is_last = part.end == rays.len();
            dispatch!(simd::level(), s => self.ask_part(s, rays, part, interval, known, &mut desk, c));
            if let Some(pool) = desk.pool.as_mut().filter(|pool| pool.is_full() || is_last) {
                pool.let_flow(rays, interval.max, (known, self.stands_alone()), |stream, known| {
                    dispatch!(simd::level(), s => {
                        let purpose = &mut T::purpose(interval, known, &mut desk.notes, Ahead::NOTHING);
                        self.flow(s, stream, interval, purpose, c);
                    });
                });
            }
        }
    }

    /// Asks about some of all rays: first what stands beside the tree, then the tree about all but those that
    /// wait for a stream.
    #[expect(clippy::too_many_arguments, reason = "all of them belong to one loop")]
    #[inline(always)]
    fn ask_part<S: Simd, T: Known>(
        &self,
        simd: S,
        rays: &[Ray],
        part: Range<usize>,
        interval: Interval,
        known: &mut [T],
        desk: &mut Desk,
        c: &mut Counters,
    ) {
        let first = part.start;
        let Desk { notes, pool } = desk;
        let (known, after) = known.split_at_mut(part.end);
        let (known, ahead) = (&mut known[part.clone()], Ahead { rays: &rays[part.end..], known: after });
        self.ask_beside(simd, &rays[part.clone()], interval, known, c);
        if self.nodes.is_empty() {
            return;
        }
        self.ask_for(
            simd,
            &rays[part],
            interval,
            known,
            #[inline(always)]
            |rays, known, numbers, c| {
                let inlet = pool.as_mut().map(|pool| Inlet { pool, first, numbers });
                let purpose = &mut T::purpose(interval, known, notes, ahead);
                self.follow(simd, rays, inlet, interval, purpose, c);
                purpose.decide(simd, self, rays, true, c);
            },
            c,
        );
    }
}

/// What a call works with.
struct Desk {
    notes: Notes,
    pool: Option<Pool>,
}

/// Rays of one call that are looked at before the next are: so many stay in the nearest cache.
const PART: usize = 256;

impl Accel for Bvh<'_> {
    fn nearest(&self, ray: &Ray, interval: Interval, counters: &mut Counters) -> Option<Hit> {
        if !ray.is_usable() {
            return None;
        }
        let best = self.geometry.nearest_sheet(ray, interval, counters);
        if self.nodes.is_empty() {
            return best;
        }
        dispatch!(simd::level(), s => {
            let best = self.balls.nearest_alone(s, self.geometry, ray, interval, best, counters);
            self.nearest_alone(s, ray, interval, best, counters)
        })
    }

    fn any(&self, ray: &Ray, interval: Interval, counters: &mut Counters) -> bool {
        if !ray.is_usable() {
            return false;
        }
        if self.geometry.any_sheet(ray, interval, counters) {
            return true;
        }
        !self.nodes.is_empty()
            && dispatch!(simd::level(), s => {
                self.balls.any_alone(s, self.geometry, ray, interval, counters)
                    || self.any_alone(s, ray, interval, counters)
            })
    }

    fn nearest_many(
        &self,
        rays: &[Ray],
        interval: Interval,
        hits: &mut [Option<Hit>],
        counters: &mut Counters,
    ) {
        assert_eq!(rays.len(), hits.len());
        self.ask(rays, interval, hits, counters);
    }

    fn any_many(&self, rays: &[Ray], interval: Interval, hit: &mut [bool], counters: &mut Counters) {
        assert_eq!(rays.len(), hit.len());
        self.ask(rays, interval, hit, counters);
    }

    fn geometry(&self) -> &Geometry {
        self.geometry
    }

    fn validate(&self) -> Result<(), String> {
        self.check()
    }
}
