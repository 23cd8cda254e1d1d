//! Rays through the wide tree.

use super::wide::{Bvh, Child, Held, WIDTH, WideNode};
use common::accel::{Accel, Job};
use common::counters::Counters;
use common::geometry::{Geometry, Hit};
use common::math::Interval;
use common::ray::Ray;
use common::shape::ExactRay;
use common::shape::triangle_block::Filter;
use common::simd::{self, Simd, SimdBase, SimdMask, dispatch, f32x8};

/// More than the rounding of a difference, an inverse and a product, three units of 2⁻²⁴ each,
/// at both sides of a comparison; relative to t.
const ROUNDING: f32 = 1.0 / (1 << 20) as f32;

/// A ray prepared for boxes.
struct Slabs {
    origin: [f32; 3],
    inverse: [f32; 3],
    /// 0 if the low side comes first, 1 if the high side does.
    near: [usize; 3],
}

impl Slabs {
    fn new(ray: &Ray) -> Self {
        let inverse = ray.direction.to_array().map(|d| 1.0 / d);
        Self { origin: ray.origin.to_array(), inverse, near: inverse.map(|i| usize::from(i < 0.0)) }
    }

    /// A bit for every child whose box the ray may meet inside the interval, whose upper end is
    /// already a [`Query::limit`], and where it enters them. Written without closures, see [`common::simd`].
    #[inline(always)]
    fn meet<S: Simd>(&self, simd: S, node: &WideNode, interval: Interval, enter: &mut [f32; WIDTH]) -> u32 {
        let [nx, ny, nz] = self.near;
        let ox = f32x8::splat(simd, self.origin[0]);
        let oy = f32x8::splat(simd, self.origin[1]);
        let oz = f32x8::splat(simd, self.origin[2]);
        let ix = f32x8::splat(simd, self.inverse[0]);
        let iy = f32x8::splat(simd, self.inverse[1]);
        let iz = f32x8::splat(simd, self.inverse[2]);
        let near_x = (f32x8::from_slice(simd, &node.side[0][nx]) - ox) * ix;
        let near_y = (f32x8::from_slice(simd, &node.side[1][ny]) - oy) * iy;
        let near_z = (f32x8::from_slice(simd, &node.side[2][nz]) - oz) * iz;
        let far_x = (f32x8::from_slice(simd, &node.side[0][1 - nx]) - ox) * ix;
        let far_y = (f32x8::from_slice(simd, &node.side[1][1 - ny]) - oy) * iy;
        let far_z = (f32x8::from_slice(simd, &node.side[2][1 - nz]) - oz) * iz;
        let near = near_x.max(near_y).max(near_z).max(f32x8::splat(simd, interval.min));
        let far = far_x.min(far_y).min(far_z);
        // Later by the rounding, for t of either sign; unlike a sum this keeps the −∞ of unused
        // places, which must stay missed.
        let later = (far * f32x8::splat(simd, 1.0 + ROUNDING)).max(far * f32x8::splat(simd, 1.0 - ROUNDING));
        let far = later.min(f32x8::splat(simd, interval.max));
        near.store_slice(enter);
        near.simd_le(far).to_bitmask() as u32
    }
}

impl Bvh<'_> {
    #[inline(always)]
    fn nearest_in<S: Simd>(
        &self,
        simd: S,
        query: &Query,
        mut best: Option<Hit>,
        c: &mut Counters,
    ) -> Option<Hit> {
        let job = Job { filter: &query.filter, exact: &query.exact, interval: query.interval };
        let mut stack = Stack::new(query.interval.min);
        let mut enter = [0.0; WIDTH];
        while let Some(child) = stack.pop(query.limit(best.as_ref())) {
            match child.held() {
                Held::Node(index) => {
                    c.cells += 1;
                    let node = &self.nodes[index];
                    let interval = Interval { max: query.limit(best.as_ref()), ..query.interval };
                    let lanes = query.slabs.meet(simd, node, interval, &mut enter);
                    stack.push_sorted(node, lanes, &enter);
                }
                Held::Blocks(first, count) => {
                    let blocks = &self.blocks[first..first + count];
                    c.intersections += blocks.iter().map(|b| u64::from(b.len)).sum::<u64>();
                    best = job.nearest(simd, blocks, best, c);
                }
                Held::Solids(first, count) => {
                    let solids = self.solids[first..first + count].iter().copied();
                    best = self.geometry.nearest_solid(solids, &query.exact, query.interval, best, c);
                }
            }
        }
        best
    }

    #[inline(always)]
    fn any_in<S: Simd>(&self, simd: S, query: &Query, c: &mut Counters) -> bool {
        let job = Job { filter: &query.filter, exact: &query.exact, interval: query.interval };
        let mut stack = Stack::new(query.interval.min);
        let mut enter = [0.0; WIDTH];
        let interval = Interval { max: query.limit(None), ..query.interval };
        while let Some(child) = stack.pop(interval.max) {
            match child.held() {
                Held::Node(index) => {
                    c.cells += 1;
                    let node = &self.nodes[index];
                    let lanes = query.slabs.meet(simd, node, interval, &mut enter);
                    stack.push_all(node, lanes, &enter);
                }
                Held::Blocks(first, count) => {
                    if job.any(simd, &self.blocks[first..first + count], c) {
                        return true;
                    }
                }
                Held::Solids(first, count) => {
                    let solids = self.solids[first..first + count].iter().copied();
                    if self.geometry.any_solid(solids, &query.exact, query.interval, c) {
                        return true;
                    }
                }
            }
        }
        false
    }
}

/// Children still to be visited, the nearest on top. What does not fit the array waits in
/// `spill`, farthest first; balanced trees never get there.
struct Stack {
    entries: [(f32, Child); STACK],
    len: usize,
    spill: Vec<(f32, Child)>,
}

/// Entries kept beside the ray: seven children may wait at each of eight levels.
const STACK: usize = 64;

impl Stack {
    #[inline(always)]
    fn new(enter: f32) -> Self {
        let mut entries = [(0.0, Child::ROOT); STACK];
        entries[0] = (enter, Child::ROOT);
        Self { entries, len: 1, spill: Vec::new() }
    }

    /// The next child that is entered no later than `max`.
    #[inline(always)]
    fn pop(&mut self, max: f32) -> Option<Child> {
        while self.len > 0 || self.refill() {
            self.len -= 1;
            let (enter, child) = self.entries[self.len];
            if enter <= max {
                return Some(child);
            }
        }
        None
    }

    /// Moves the farthest half away if eight more would not fit.
    #[inline(always)]
    fn make_room(&mut self) {
        if self.len > STACK - WIDTH {
            self.spill_half();
        }
    }

    #[cold]
    fn spill_half(&mut self) {
        self.spill.extend_from_slice(&self.entries[..STACK / 2]);
        self.entries.copy_within(STACK / 2..self.len, 0);
        self.len -= STACK / 2;
    }

    /// Takes the nearest spilt half back; false if there is none.
    #[cold]
    fn refill(&mut self) -> bool {
        let keep = self.spill.len().saturating_sub(STACK / 2);
        self.len = self.spill.len() - keep;
        self.entries[..self.len].copy_from_slice(&self.spill[keep..]);
        self.spill.truncate(keep);
        self.len > 0
    }

    #[inline(always)]
    fn push_all(&mut self, node: &WideNode, mut lanes: u32, enter: &[f32; WIDTH]) {
        self.make_room();
        while lanes != 0 {
            let lane = lanes.trailing_zeros() as usize;
            lanes &= lanes - 1;
            self.entries[self.len] = (enter[lane], node.child[lane]);
            self.len += 1;
        }
    }

    /// Pushes the children so that the one entered first comes out first.
    #[inline(always)]
    fn push_sorted(&mut self, node: &WideNode, mut lanes: u32, enter: &[f32; WIDTH]) {
        self.make_room();
        let base = self.len;
        while lanes != 0 {
            let lane = lanes.trailing_zeros() as usize;
            lanes &= lanes - 1;
            let mut i = self.len;
            while i > base && self.entries[i - 1].0 < enter[lane] {
                self.entries[i] = self.entries[i - 1];
                i -= 1;
            }
            self.entries[i] = (enter[lane], node.child[lane]);
            self.len += 1;
        }
    }
}

/// One ray on its way through the tree.
struct Query {
    interval: Interval,
    exact: ExactRay,
    filter: Filter,
    slabs: Slabs,
    /// See [`ExactRay::margin`].
    margin: f32,
}

impl Query {
    /// A box that is entered later than this holds nothing that could come before `best`, or
    /// tie with it, or lie in the interval.
    #[inline]
    fn limit(&self, best: Option<&Hit>) -> f32 {
        let t = best.map_or(self.interval.max, |hit| hit.t);
        t + t.abs() * ROUNDING + self.margin
    }
}

impl Accel for Bvh<'_> {
    fn nearest(&self, ray: &Ray, interval: Interval, counters: &mut Counters) -> Option<Hit> {
        if !ray.is_usable() {
            return None;
        }
        let query = self.query(ray, interval);
        let best = self.geometry.nearest_sheet(&query.exact, interval, counters);
        if self.nodes.is_empty() {
            return best;
        }
        dispatch!(simd::level(), s => self.nearest_in(s, &query, best, counters))
    }

    fn any(&self, ray: &Ray, interval: Interval, counters: &mut Counters) -> bool {
        if !ray.is_usable() {
            return false;
        }
        let query = self.query(ray, interval);
        if self.geometry.any_sheet(&query.exact, interval, counters) {
            return true;
        }
        !self.nodes.is_empty() && dispatch!(simd::level(), s => self.any_in(s, &query, counters))
    }

    fn geometry(&self) -> &Geometry {
        self.geometry
    }

    fn validate(&self) -> Result<(), String> {
        self.check()
    }
}

impl Bvh<'_> {
    fn query(&self, ray: &Ray, interval: Interval) -> Query {
        let exact = ExactRay::new(ray);
        let margin = self.geometry.bounds().map_or(0.0, |b| exact.margin(&b)) as f32;
        let filter = Filter::new(ray, &self.triangle_bounds);
        Query { interval, exact, filter, slabs: Slabs::new(ray), margin }
    }
}
