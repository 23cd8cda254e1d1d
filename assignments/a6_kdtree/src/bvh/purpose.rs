//! What a crowd of rays is followed for: the first hit of each, or any.

use super::bundle::{Bundle, MOST};
use super::known::Known;
use super::pending::Pending;
use super::single::Query;
use super::stack::Stack;
use super::wide::{Bvh, Held};
use common::accel::Job;
use common::counters::Counters;
use common::geometry::Hit;
use common::math::Interval;
use common::ray::Ray;
use common::simd::{Simd, prefetch_all};

/// What rays are followed for.
pub trait Purpose {
    /// Whether it pays to visit the child of a node first that is entered first; see [`nearest_child`](super::children::nearest_child).
    const BY_DISTANCE: bool;

    /// Whether a ray need not be followed.
    fn is_settled(&self, ray: usize) -> bool;

    /// Hits of a ray later than this do not matter.
    fn last(&self, ray: usize) -> f32;

    /// Looks into a leaf. Returns until where hits matter from now on; −∞ if none do.
    fn leaf<S: Simd>(&mut self, simd: S, bvh: &Bvh, held: Held, at: &At, c: &mut Counters) -> f32;

    /// Follows one ray all the way.
    fn alone<S: Simd>(&mut self, simd: S, bvh: &Bvh, query: &Query<MOST>, ray: usize, c: &mut Counters);

    /// Follows rays from number `first` on, which run alongside each other. What is then pending may
    /// still be hit.
    fn bundle<S: Simd>(&mut self, simd: S, bvh: &Bvh, bundle: &Bundle, first: usize, c: &mut Counters);

    /// Asks the memory for as many rays of those that come after all these, as far behind the first of them as `first`.
    fn look_ahead(&self, first: usize, count: usize);

    /// Decides what is pending if that is much or all is over.
    fn decide<S: Simd>(&mut self, simd: S, bvh: &Bvh, rays: &[Ray], is_over: bool, c: &mut Counters);
}

/// What is noted on the way.
pub struct Notes {
    /// Nodes with children still to be visited.
    pub stack: Stack,
    /// Triangles still to be asked.
    pub pending: Pending,
}

impl Notes {
    /// Nothing.
    pub fn new() -> Self {
        Self { stack: Stack::new(), pending: Pending::default() }
    }
}

/// Rays that come after those at hand, and where what is known of them is going to be.
#[derive(Clone, Copy)]
pub struct Ahead<'a, T> {
    /// The rays.
    pub rays: &'a [Ray],
    /// What is known of each.
    pub known: &'a [T],
}

impl<T> Ahead<'_, T> {
    /// There are none.
    pub const NOTHING: Self = Self { rays: &[], known: &[] };

    /// Asks the memory for some of them, without waiting.
    #[inline(always)]
    fn prefetch(&self, first: usize, count: usize) {
        prefetch_all(self.rays, first..first + count);
        prefetch_all(self.known, first..first + count);
    }
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

/// Looks for the first hit of each ray.
pub struct Nearest<'a> {
    /// Where hits count.
    pub interval: Interval,
    /// The best so far, by ray.
    pub best: &'a mut [Option<Hit>],
    /// For rays that are not followed in slots.
    pub notes: &'a mut Notes,
    /// The rays that come next.
    pub ahead: Ahead<'a, Option<Hit>>,
}

impl Purpose for Nearest<'_> {
    const BY_DISTANCE: bool = true;

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
    fn alone<S: Simd>(&mut self, simd: S, bvh: &Bvh, query: &Query<MOST>, ray: usize, c: &mut Counters) {
        self.best[ray] = bvh.nearest_one(simd, query, &mut self.notes.stack, self.best[ray], c);
    }

    #[inline(always)]
    fn bundle<S: Simd>(&mut self, simd: S, bvh: &Bvh, bundle: &Bundle, first: usize, c: &mut Counters) {
        let best = &mut self.best[first..first + bundle.rays.len()];
        bvh.nearest_together(simd, (bundle, first), self.notes, best, c);
    }

    #[inline(always)]
    fn look_ahead(&self, first: usize, count: usize) {
        self.ahead.prefetch(first, count);
    }

    #[inline(always)]
    fn decide<S: Simd>(&mut self, simd: S, bvh: &Bvh, rays: &[Ray], is_over: bool, c: &mut Counters) {
        if is_over || self.notes.pending.are_enough() {
            self.notes.pending.decide(simd, (bvh, rays), (self.interval, is_over), self.best, c);
        }
    }
}

/// Looks for any hit of each ray.
pub struct Blocked<'a> {
    /// Where hits count.
    pub interval: Interval,
    /// Whether there is one, by ray.
    pub hit: &'a mut [bool],
    /// For rays that are not followed in slots.
    pub notes: &'a mut Notes,
    /// The rays that come next.
    pub ahead: Ahead<'a, bool>,
}

impl Purpose for Blocked<'_> {
    const BY_DISTANCE: bool = false;

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
    fn alone<S: Simd>(&mut self, simd: S, bvh: &Bvh, query: &Query<MOST>, ray: usize, c: &mut Counters) {
        self.hit[ray] = bvh.any_one(simd, query, &mut self.notes.stack, c);
    }

    #[inline(always)]
    fn bundle<S: Simd>(&mut self, simd: S, bvh: &Bvh, bundle: &Bundle, first: usize, c: &mut Counters) {
        let bits = bvh.any_together(simd, bundle, &mut self.notes.stack, c);
        for (lane, hit) in self.hit[first..first + bundle.rays.len()].iter_mut().enumerate() {
            *hit |= bits >> lane & 1 == 1;
        }
    }

    #[inline(always)]
    fn look_ahead(&self, first: usize, count: usize) {
        self.ahead.prefetch(first, count);
    }

    #[inline(always)]
    fn decide<S: Simd>(&mut self, _: S, _: &Bvh, _: &[Ray], _: bool, _: &mut Counters) {}
}
