//! Rays through the wide tree.

use super::slabs::Slabs;
use super::stack::Stack;
use super::wide::{Bvh, Child, Held, WIDTH};
use common::accel::{Accel, Job};
use common::counters::Counters;
use common::geometry::{Geometry, Hit};
use common::math::Interval;
use common::ray::Ray;
use common::shape::ExactRay;
use common::shape::triangle_block::Filter;
use common::simd::{self, Simd, dispatch};

/// More than the rounding of a difference, an inverse and a product, three units of 2⁻²⁴ each,
/// at both sides of a comparison; relative to t.
const ROUNDING: f32 = 1.0 / (1 << 20) as f32;

impl Bvh<'_> {
    #[inline(always)]
    fn nearest_in<S: Simd>(
        &self,
        simd: S,
        ray: &Ray,
        interval: Interval,
        mut best: Option<Hit>,
        c: &mut Counters,
    ) -> Option<Hit> {
        let query = self.query(ray, interval);
        let job = Job { filter: &query.filter, ray, interval: query.interval };
        let mut stack = Stack::new();
        let mut enter = [0.0; WIDTH];
        let mut interval = Interval { max: query.limit(best.as_ref()), ..query.interval };
        let mut child = Child::ROOT;
        loop {
            match child.held() {
                Held::Node(index) => {
                    c.cells += 1;
                    let node = &self.nodes[index];
                    let lanes = query.slabs.meet(simd, node, interval, &mut enter);
                    if lanes != 0 {
                        child = stack.descend(node, lanes, &enter);
                        continue;
                    }
                }
                Held::Block(index, len) => {
                    best = job.nearest_of(simd, &self.blocks[index], len, best, c);
                    interval.max = query.limit(best.as_ref());
                }
                Held::Solids(first, count) => {
                    let solids = self.solids[first..first + count].iter().copied();
                    best = self.geometry.nearest_solid(solids, &ExactRay::new(ray), query.interval, best, c);
                    interval.max = query.limit(best.as_ref());
                }
            }
            let Some(next) = stack.pop(interval.max) else { return best };
            child = next;
        }
    }

    #[inline(always)]
    fn any_in<S: Simd>(&self, simd: S, ray: &Ray, interval: Interval, c: &mut Counters) -> bool {
        let query = self.query(ray, interval);
        let job = Job { filter: &query.filter, ray, interval: query.interval };
        let mut stack = Stack::new();
        let mut enter = [0.0; WIDTH];
        let interval = Interval { max: query.limit(None), ..query.interval };
        let mut child = Child::ROOT;
        loop {
            match child.held() {
                Held::Node(index) => {
                    c.cells += 1;
                    let node = &self.nodes[index];
                    let lanes = query.slabs.meet(simd, node, interval, &mut enter);
                    if lanes != 0 {
                        child = stack.descend(node, lanes, &enter);
                        continue;
                    }
                }
                Held::Block(index, len) => {
                    if job.any_of(simd, &self.blocks[index], len, c) {
                        return true;
                    }
                }
                Held::Solids(first, count) => {
                    let solids = self.solids[first..first + count].iter().copied();
                    if self.geometry.any_solid(solids, &ExactRay::new(ray), query.interval, c) {
                        return true;
                    }
                }
            }
            let Some(next) = stack.pop(interval.max) else { return false };
            child = next;
        }
    }
}

/// One ray on its way through the tree.
struct Query {
    interval: Interval,
    filter: Filter,
    slabs: Slabs,
    /// See [`ExactRay::margin`].
    margin: f32,
}

impl Query {
    /// A box that is entered later than this holds nothing that could come before `best`, or
    /// tie with it, or lie in the interval.
    #[inline(always)]
    fn limit(&self, best: Option<&Hit>) -> f32 {
        let t = best.map_or(self.interval.max, |hit| hit.t);
        // A branch, so that the first node need not wait for the margin of an endless ray.
        if t == f32::INFINITY { t } else { t + t.abs() * ROUNDING + self.margin }
    }
}

impl Accel for Bvh<'_> {
    fn nearest(&self, ray: &Ray, interval: Interval, counters: &mut Counters) -> Option<Hit> {
        if !ray.is_usable() {
            return None;
        }
        let sheets = self.geometry.sheets();
        let best = if sheets.is_empty() { None } else {
            self.geometry.nearest_sheet(&ExactRay::new(ray), interval, counters)
        };
        if self.nodes.is_empty() {
            return best;
        }
        dispatch!(simd::level(), s => self.nearest_in(s, ray, interval, best, counters))
    }

    fn any(&self, ray: &Ray, interval: Interval, counters: &mut Counters) -> bool {
        if !ray.is_usable() {
            return false;
        }
        let sheets = self.geometry.sheets();
        if !sheets.is_empty() && self.geometry.any_sheet(&ExactRay::new(ray), interval, counters) {
            return true;
        }
        !self.nodes.is_empty() && dispatch!(simd::level(), s => self.any_in(s, ray, interval, counters))
    }

    fn geometry(&self) -> &Geometry {
        self.geometry
    }

    fn validate(&self) -> Result<(), String> {
        self.check()
    }
}

impl Bvh<'_> {
    #[inline(always)]
    fn query(&self, ray: &Ray, interval: Interval) -> Query {
        let filter = Filter::new(ray, &self.bounds);
        let slabs = Slabs::new(ray, &self.bounds, filter.reach);
        Query { interval, filter, slabs, margin: filter.reach * 2f32.powi(-20) }
    }
}
