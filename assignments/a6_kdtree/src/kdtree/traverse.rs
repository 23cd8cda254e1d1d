//! Rays through the tree: the near side first, the far side only if it can matter.
//!
//! Everything is computed in `f64` from `f32` inputs: the distance to a plane is exact but for
//! three roundings of 2⁻⁵³, however far or oblique the ray, and nothing can overflow. Where a
//! plane is met within `slack` of either end of the stretch in question, both sides are
//! visited, so no rounding can lose a leaf that the ray passes.

use super::stack::{Stack, Waiting};
use super::tree::{KdTree, Node};
use common::accel::{Accel, Job};
use common::counters::Counters;
use common::geometry::{Geometry, Hit};
use common::math::Interval;
use common::ray::Ray;
use common::shape::ExactRay;
use common::shape::filter::Filter;
use common::simd::{self, Simd, dispatch};

/// One ray on its way through the tree.
struct Query {
    interval: Interval,
    exact: ExactRay,
    filter: Filter,
    /// By axis; the fourth is there for the index of leaves.
    origin: [f64; 4],
    inverse: [f64; 4],
    /// 1 if the ray meets the upper child first.
    backward: [usize; 4],
    /// See [`ExactRay::margin`].
    margin: f64,
    /// More than the rounding of where the ray meets planes.
    slack: f64,
    /// The stretch of the ray inside the box and the interval.
    enter: f64,
    exit: f64,
}

impl Query {
    /// `None` if the ray surely passes the box by.
    #[inline]
    fn new(tree: &KdTree, ray: &Ray, interval: Interval) -> Option<Self> {
        let exact = ExactRay::new(ray);
        let [x, y, z] = exact.direction.to_array().map(|d| (d + 0.0).recip());
        let [ox, oy, oz] = exact.origin.to_array();
        let mut query = Self {
            interval,
            exact,
            filter: Filter::new(ray, &tree.triangle_bounds),
            origin: [ox, oy, oz, 0.0],
            inverse: [x, y, z, 0.0],
            backward: [x, y, z, 0.0].map(|i| usize::from(i < 0.0)),
            margin: exact.margin(&tree.bounds),
            slack: 0.0,
            enter: f64::NEG_INFINITY,
            exit: f64::INFINITY,
        };
        query.clip(tree);
        // Written so that a NaN, of which there should be none, is a miss.
        (query.enter <= query.exit).then_some(query)
    }

    fn clip(&mut self, tree: &KdTree) {
        for axis in 0..3 {
            let sides = [tree.bounds.min[axis], tree.bounds.max[axis]];
            let [near, far] = [self.backward[axis], 1 - self.backward[axis]]
                .map(|side| self.meets(f64::from(sides[side]), axis));
            // A ray in a side of the box gives NaN, which compares false: no limit.
            if near > self.enter {
                self.enter = near;
            }
            if far < self.exit {
                self.exit = far;
            }
        }
        self.slack = self.enter.abs().max(self.exit.abs()) * 2f64.powi(-48);
        let (min, max) = (f64::from(self.interval.min), f64::from(self.interval.max));
        self.enter = (self.enter - self.slack).max(min - self.margin);
        self.exit = (self.exit + self.slack).min(max + self.margin);
    }

    /// Where the ray meets a plane; ±∞ on its way along the plane, NaN inside it.
    #[inline(always)]
    fn meets(&self, plane: f64, axis: usize) -> f64 {
        (plane - self.origin[axis]) * self.inverse[axis]
    }
}

impl KdTree<'_> {
    /// The next leaf that the ray passes no later than `last`.
    #[inline(always)]
    fn next_leaf(&self, query: &Query, stack: &mut Stack, last: f64, c: &mut Counters) -> Option<Node> {
        let Waiting { enter, mut exit, node } = stack.pop(last)?;
        if last < exit {
            exit = last;
        }
        let mut node = self.nodes[node as usize];
        while !node.is_leaf() {
            c.cells += 1;
            let axis = node.axis();
            let t = query.meets(f64::from(node.at()), axis);
            let (before, after) = (t - query.slack, t + query.slack);
            let first = node.child() + query.backward[axis];
            let second = node.child() + 1 - query.backward[axis];
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
        Some(node)
    }

    #[inline(always)]
    fn nearest_in<S: Simd>(
        &self,
        simd: S,
        ray: &Ray,
        interval: Interval,
        stack: &mut Stack,
        mut best: Option<Hit>,
        c: &mut Counters,
    ) -> Option<Hit> {
        let Some(query) = Query::new(self, ray, interval) else { return best };
        let job = Job { filter: &query.filter, ray, interval };
        stack.restart(query.enter, query.exit);
        let mut last = best.map_or(interval.max, |b| b.t);
        while let Some(leaf) = self.next_leaf(&query, stack, f64::from(last) + query.margin, c) {
            let (blocks, solids) = self.held(leaf);
            for block in blocks {
                last = job.nearest_of(simd, block, block.len(), last, &mut best, c);
            }
            if !solids.is_empty() {
                let solids = solids.iter().copied();
                best = self.geometry.nearest_solid(solids, &query.exact, interval, best, c);
                last = best.map_or(last, |b| b.t.min(last));
            }
        }
        best
    }

    #[inline(always)]
    fn any_in<S: Simd>(
        &self,
        simd: S,
        ray: &Ray,
        interval: Interval,
        stack: &mut Stack,
        c: &mut Counters,
    ) -> bool {
        let Some(query) = Query::new(self, ray, interval) else { return false };
        let job = Job { filter: &query.filter, ray, interval };
        stack.restart(query.enter, query.exit);
        while let Some(leaf) = self.next_leaf(&query, stack, f64::INFINITY, c) {
            let (blocks, solids) = self.held(leaf);
            let solids = solids.iter().copied();
            if job.any(simd, blocks, c) || self.geometry.any_solid(solids, &query.exact, interval, c) {
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
        for (ray, hit) in rays.iter().zip(hits) {
            *hit = None;
            if ray.is_usable() {
                let sheet = self.geometry.nearest_sheet(ray, interval, c);
                *hit = match self.nodes.is_empty() {
                    true => sheet,
                    false => self.nearest_in(simd, ray, interval, &mut stack, sheet, c),
                };
            }
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
        for (ray, hit) in rays.iter().zip(hit) {
            *hit = ray.is_usable()
                && (self.geometry.any_sheet(ray, interval, c)
                    || !self.nodes.is_empty() && self.any_in(simd, ray, interval, &mut stack, c));
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
