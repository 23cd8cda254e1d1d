//! What a crowd of rays is followed for: the first hit of each, or any.

use super::bundle::Bundle;
use super::packet::RAYS;
use super::single::Query;
use super::stack::Stack;
use super::wide::{Bvh, Held};
use common::accel::Job;
use common::counters::Counters;
use common::geometry::Hit;
use common::math::Interval;
use common::shape::triangle_block::TriangleBlock;
use common::simd::Simd;

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
    /// The ray and what is asked of triangles.
    pub job: Job<'a>,
    /// Its number.
    pub ray: usize,
    /// Hits later than this do not matter.
    pub last: f32,
}

/// What is known of a ray when the tree is asked: its first hit so far, or whether there is any.
pub trait Known: Copy + PartialEq {
    /// Nothing yet.
    const NONE: Self;

    /// What finds out the rest.
    type Purpose<'a>: Purpose
    where
        Self: 'a;

    /// Finds out the rest of some rays.
    fn purpose<'a>(interval: Interval, known: &'a mut [Self], stack: &'a mut Stack) -> Self::Purpose<'a>;

    /// What the tree holds after this t does not matter; −∞ if nothing does. `max` is where the
    /// interval ends.
    fn last(&self, max: f32) -> f32;

    /// Looks at so many of the first triangles of a block. Hits later than `last` do not matter; returns
    /// until where they do from now on, −∞ if none does.
    fn look<S: Simd>(
        &mut self,
        simd: S,
        first: (&TriangleBlock, usize),
        last: f32,
        job: &Job,
        c: &mut Counters,
    ) -> f32;
}

impl Known for Option<Hit> {
    const NONE: Self = None;

    type Purpose<'a> = Nearest<'a>;

    #[inline(always)]
    fn purpose<'a>(interval: Interval, best: &'a mut [Self], stack: &'a mut Stack) -> Nearest<'a> {
        Nearest { interval, best, stack }
    }

    #[inline(always)]
    fn last(&self, max: f32) -> f32 {
        self.map_or(max, |hit| hit.t)
    }

    #[inline(always)]
    fn look<S: Simd>(
        &mut self,
        simd: S,
        (block, len): (&TriangleBlock, usize),
        last: f32,
        job: &Job,
        c: &mut Counters,
    ) -> f32 {
        job.nearest_of(simd, block, len, last, self, c)
    }
}

impl Known for bool {
    const NONE: Self = false;

    type Purpose<'a> = Blocked<'a>;

    #[inline(always)]
    fn purpose<'a>(interval: Interval, hit: &'a mut [Self], stack: &'a mut Stack) -> Blocked<'a> {
        Blocked { interval, hit, stack }
    }

    #[inline(always)]
    fn last(&self, max: f32) -> f32 {
        if *self { f32::NEG_INFINITY } else { max }
    }

    #[inline(always)]
    fn look<S: Simd>(
        &mut self,
        simd: S,
        (block, len): (&TriangleBlock, usize),
        last: f32,
        job: &Job,
        c: &mut Counters,
    ) -> f32 {
        *self |= job.any_of(simd, block, len, c);
        if *self { f32::NEG_INFINITY } else { last }
    }
}

/// Looks for the first hit of each ray.
pub struct Nearest<'a> {
    /// Where hits count.
    pub interval: Interval,
    /// The best so far, by ray.
    pub best: &'a mut [Option<Hit>],
    /// For rays that are not followed in slots.
    pub stack: &'a mut Stack,
}

impl Purpose for Nearest<'_> {
    #[inline(always)]
    fn is_settled(&self, _: usize) -> bool {
        false
    }

    #[inline(always)]
    fn last(&self, ray: usize) -> f32 {
        self.best[ray].last(self.interval.max)
    }

    #[inline(always)]
    fn leaf<S: Simd>(&mut self, simd: S, bvh: &Bvh, held: Held, at: &At, c: &mut Counters) -> f32 {
        bvh.nearest_held(simd, held, &at.job, at.last, &mut self.best[at.ray], c)
    }

    #[inline(always)]
    fn alone<S: Simd>(&mut self, simd: S, bvh: &Bvh, query: &Query<RAYS>, ray: usize, c: &mut Counters) {
        self.best[ray] = bvh.nearest_one(simd, query, self.stack, self.best[ray], c);
    }

    #[inline(always)]
    fn bundle<S: Simd>(&mut self, simd: S, bvh: &Bvh, bundle: &Bundle, first: usize, c: &mut Counters) {
        let best = &mut self.best[first..first + bundle.rays.len()];
        bvh.nearest_together(simd, bundle, self.stack, best, c);
    }
}

/// Looks for any hit of each ray.
pub struct Blocked<'a> {
    /// Where hits count.
    pub interval: Interval,
    /// Whether there is one, by ray.
    pub hit: &'a mut [bool],
    /// For rays that are not followed in slots.
    pub stack: &'a mut Stack,
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
        self.hit[ray] = bvh.any_one(simd, query, self.stack, c);
    }

    #[inline(always)]
    fn bundle<S: Simd>(&mut self, simd: S, bvh: &Bvh, bundle: &Bundle, first: usize, c: &mut Counters) {
        let bits = bvh.any_together(simd, bundle, self.stack, c);
        for (lane, hit) in self.hit[first..first + bundle.rays.len()].iter_mut().enumerate() {
            *hit |= bits >> lane & 1 == 1;
        }
    }
}
