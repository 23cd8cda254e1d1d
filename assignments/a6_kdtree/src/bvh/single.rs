//! One ray through the tree.

use super::beam::Spread;
use super::packet::Packet;
use super::stack::Stack;
use super::walk::{Visit, walk};
use super::wide::{Bvh, Held, WideNode};
use common::accel::Job;
use common::counters::Counters;
use common::geometry::Hit;
use common::math::Interval;
use common::ray::Ray;
use common::shape::ExactRay;
use common::shape::filter::MARGIN;
use common::simd::{Floats, Select, Simd};

/// More than the rounding of t at both sides of a comparison; relative to t.
const ROUNDING: f32 = 1.0 / (1 << 20) as f32;

/// A box that is entered later than this holds nothing that could come before a hit at `t`, or
/// tie with it, or lie in an interval that ends there.
#[inline(always)]
pub fn limit(t: f32, margin: f32) -> f32 {
    // A branch, so that the first node need not wait for the margin of an endless ray.
    if t == f32::INFINITY { t } else { t + t.abs() * ROUNDING + margin }
}

/// For each t the [`limit`] by the rays' reach.
#[inline(always)]
pub fn limits<S: Simd, V: Floats<S>>(simd: S, t: V, reach: V) -> V {
    let margin = reach * V::splat(simd, MARGIN);
    let later = t + t.abs() * V::splat(simd, ROUNDING) + margin;
    t.simd_eq(V::splat(simd, f32::INFINITY)).select(t, later)
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

impl<const N: usize> Query<'_, N> {
    /// The ray for box tests.
    #[inline(always)]
    fn beam<S: Simd>(&self, simd: S) -> Spread<S> {
        self.packet.beam(self.lane).spread(simd, self.interval.min)
    }

    /// Until where boxes matter if hits do until `t`.
    #[inline(always)]
    fn limit(&self, t: f32) -> f32 {
        limit(t, self.packet.margin(self.lane))
    }
}

/// Looks for the first hit of a ray.
struct First<'a, 'g> {
    bvh: &'a Bvh<'g>,
    margin: f32,
    job: Job<'a>,
    /// Hits later than this do not matter; known before the exact hit is.
    last: f32,
    best: Option<Hit>,
}

impl<S: Simd> Visit<S> for First<'_, '_> {
    #[inline(always)]
    fn leaf(&mut self, simd: S, node: &WideNode, child: usize, c: &mut Counters) -> f32 {
        let held = node.child[child].held();
        self.last = self.bvh.nearest_held(simd, held, &self.job, self.last, &mut self.best, c);
        limit(self.last, self.margin)
    }
}

/// Looks for any hit of a ray.
struct Blocked<'a, 'g> {
    bvh: &'a Bvh<'g>,
    job: Job<'a>,
    max: f32,
    hit: bool,
}

impl<S: Simd> Visit<S> for Blocked<'_, '_> {
    #[inline(always)]
    fn leaf(&mut self, simd: S, node: &WideNode, child: usize, c: &mut Counters) -> f32 {
        self.hit = self.bvh.any_held(simd, node.child[child].held(), &self.job, c);
        if self.hit { f32::NEG_INFINITY } else { self.max }
    }
}

impl Bvh<'_> {
    /// The better of `best` and the first hit of the ray.
    #[inline(always)]
    pub(super) fn nearest_one<S: Simd, const N: usize>(
        &self,
        simd: S,
        query: &Query<N>,
        stack: &mut Stack,
        best: Option<Hit>,
        c: &mut Counters,
    ) -> Option<Hit> {
        let Query { packet, lane, ray, interval } = *query;
        let filter = &packet.filter(lane);
        // Hidden, or the compiler would spread all of it out for every ray, while most rays reach
        // two blocks or none.
        let job = Job { filter: std::hint::black_box(filter), ray, interval };
        let last = best.map_or(interval.max, |b| b.t);
        let mut first = First { bvh: self, margin: packet.margin(lane), job, last, best };
        walk(simd, (self, 0), stack, query.limit(last), &query.beam(simd), &mut first, c);
        first.best
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
        // As above.
        let job = Job { filter: std::hint::black_box(filter), ray, interval };
        let max = query.limit(interval.max);
        let mut blocked = Blocked { bvh: self, job, max, hit: false };
        walk(simd, (self, 0), stack, max, &query.beam(simd), &mut blocked, c);
        blocked.hit
    }

    /// Puts the better of `best` and the first hit in a leaf into `best`; see [`Job::nearest_of`].
    #[inline(always)]
    pub(super) fn nearest_held<S: Simd>(
        &self,
        simd: S,
        held: Held,
        job: &Job,
        last: f32,
        best: &mut Option<Hit>,
        c: &mut Counters,
    ) -> f32 {
        match held {
            Held::Block(index, len) => job.nearest_of(simd, &self.blocks[index], len, last, best, c),
            Held::Solids(first, count) => {
                let solids = self.solids[first..first + count].iter().copied();
                let exact = ExactRay::new(job.ray);
                *best = self.geometry.nearest_solid(solids, &exact, job.interval, *best, c);
                best.map_or(last, |b| if b.t < last { b.t } else { last })
            }
            Held::Node(_) => last,
        }
    }

    /// Whether anything in a leaf is hit.
    #[inline(always)]
    pub(super) fn any_held<S: Simd>(&self, simd: S, held: Held, job: &Job, c: &mut Counters) -> bool {
        match held {
            Held::Block(index, len) => job.any_of(simd, &self.blocks[index], len, c),
            Held::Solids(first, count) => {
                let solids = self.solids[first..first + count].iter().copied();
                self.geometry.any_solid(solids, &ExactRay::new(job.ray), job.interval, c)
            }
            Held::Node(_) => false,
        }
    }
}
