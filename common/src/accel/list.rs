//! Brute force: every primitive is asked, triangles eight at a time.

use super::Accel;
use crate::counters::Counters;
use crate::geometry::{Geometry, Hit, hit_triangle_with};
use crate::math::{Bounds, Interval};
use crate::ray::Ray;
use crate::shape::ExactRay;
use crate::shape::filter::Filter;
use crate::shape::triangle_block::{LANES, TriangleBlock};
use crate::simd::{self, Simd, dispatch};

/// All primitives in a row. The right structure for a handful, and the oracle for the others.
pub struct List<'g> {
    geometry: &'g Geometry,
    blocks: Vec<TriangleBlock>,
    triangle_bounds: Bounds,
}

impl<'g> List<'g> {
    /// Packs the triangles into blocks.
    pub fn new(geometry: &'g Geometry) -> Self {
        let numbered: Vec<(u32, _)> =
            geometry.triangle_numbers().iter().copied().zip(geometry.triangles().iter().copied()).collect();
        let blocks = numbered.chunks(LANES).map(|c| TriangleBlock::pack(c.iter().copied())).collect();
        let triangle_bounds = Bounds::of_points(geometry.triangles().iter().flatten().copied());
        Self { geometry, blocks, triangle_bounds }
    }

    fn solids(&self) -> std::ops::Range<u32> {
        0..self.geometry.solids().len() as u32
    }
}

impl Accel for List<'_> {
    fn nearest(&self, ray: &Ray, interval: Interval, counters: &mut Counters) -> Option<Hit> {
        if !ray.is_usable() {
            return None;
        }
        let exact = ExactRay::new(ray);
        let sheet = self.geometry.nearest_sheet(ray, interval, counters);
        let mut best = self.geometry.nearest_solid(self.solids(), &exact, interval, sheet, counters);
        if !self.blocks.is_empty() {
            let filter = Filter::new(ray, &self.triangle_bounds);
            let job = Job { filter: &filter, ray, interval };
            best = dispatch!(simd::level(), s => job.nearest(s, &self.blocks, best, counters));
        }
        best
    }

    fn any(&self, ray: &Ray, interval: Interval, counters: &mut Counters) -> bool {
        if !ray.is_usable() {
            return false;
        }
        let exact = ExactRay::new(ray);
        if self.geometry.any_solid(self.solids(), &exact, interval, counters)
            || self.geometry.any_sheet(ray, interval, counters)
        {
            return true;
        }
        if self.blocks.is_empty() {
            return false;
        }
        let filter = Filter::new(ray, &self.triangle_bounds);
        let job = Job { filter: &filter, ray, interval };
        dispatch!(simd::level(), s => job.any(s, &self.blocks, counters))
    }

    fn geometry(&self) -> &Geometry {
        self.geometry
    }

    fn validate(&self) -> Result<(), String> {
        let packed: Vec<u32> = self.blocks.iter().flat_map(|b| b.index[..b.len()].to_vec()).collect();
        if packed != self.geometry.triangle_numbers() {
            return Err("the blocks do not hold every triangle once, in order".to_owned());
        }
        let lanes = self.blocks.iter().flat_map(|b| (0..b.len()).map(|l| b.vertices(l)));
        match lanes.zip(self.geometry.triangles()).position(|(a, b)| a != *b) {
            Some(i) => Err(format!("triangle {i} was changed in packing")),
            None => Ok(()),
        }
    }
}

/// One ray against blocks of triangles: the part that runs with the chosen instructions.
/// Other structures use it for their leaves.
pub struct Job<'a> {
    /// The ray, prepared for the filter.
    pub filter: &'a Filter,
    /// The ray itself, for the exact test.
    pub ray: &'a Ray,
    /// Where hits count.
    pub interval: Interval,
}

impl Job<'_> {
    /// The better of `best` and the nearest hit in the blocks.
    #[inline(always)]
    pub fn nearest<S: Simd>(
        &self,
        simd: S,
        blocks: &[TriangleBlock],
        mut best: Option<Hit>,
        counters: &mut Counters,
    ) -> Option<Hit> {
        let mut last = best.map_or(self.interval.max, |b: Hit| b.t);
        for block in blocks {
            last = self.nearest_of(simd, block, block.len(), last, &mut best, counters);
        }
        best
    }

    /// Puts the better of `best` and the nearest hit among the first `len` triangles of a block
    /// into `best`. Hits later than `last` do not matter; returns a new such bound, which does
    /// not wait for the exact test where the filter is certain.
    #[inline(always)]
    pub fn nearest_of<S: Simd>(
        &self,
        simd: S,
        block: &TriangleBlock,
        len: usize,
        mut last: f32,
        best: &mut Option<Hit>,
        counters: &mut Counters,
    ) -> f32 {
        counters.intersections += len as u64;
        // Up to and including the last t: an equal t with a lower number still wins.
        let verdict = block.judge(simd, self.filter, Interval { max: last, ..self.interval });
        let mut possible = verdict.possible & used(len);
        if possible == 0 {
            return last;
        }
        possible &= !block.lanes_of(simd, self.ray.home);
        if possible == 0 {
            return last;
        }
        counters.exact_tests += u64::from(possible.count_ones());
        let (ray, interval, before) = (self.ray, self.interval, *best);
        *best = simd.vectorize(
            #[inline(always)]
            || decide(simd, ray, interval, block, possible, before),
        );
        let mut lanes = verdict.certain & possible;
        if lanes == 0 {
            return best.map_or(last, |b| b.t);
        }
        while lanes != 0 {
            let lane = lanes.trailing_zeros() as usize % LANES;
            lanes &= lanes - 1;
            last = if verdict.latest[lane] < last { verdict.latest[lane] } else { last };
        }
        last
    }

    /// Whether any triangle of the blocks is hit.
    #[inline(always)]
    pub fn any<S: Simd>(&self, simd: S, blocks: &[TriangleBlock], counters: &mut Counters) -> bool {
        for block in blocks {
            if self.any_of(simd, block, block.len(), counters) {
                return true;
            }
        }
        false
    }

    /// Whether any of the first `len` triangles of a block is hit; what the filter is certain of
    /// needs no exact test.
    #[inline(always)]
    pub fn any_of<S: Simd>(
        &self,
        simd: S,
        block: &TriangleBlock,
        len: usize,
        counters: &mut Counters,
    ) -> bool {
        counters.intersections += len as u64;
        let verdict = block.judge(simd, self.filter, self.interval);
        let mut possible = verdict.possible & used(len);
        if possible == 0 {
            return false;
        }
        possible &= !block.lanes_of(simd, self.ray.home);
        if possible == 0 || verdict.certain & possible != 0 {
            return possible != 0;
        }
        counters.exact_tests += u64::from(possible.count_ones());
        let (ray, interval) = (self.ray, self.interval);
        let hit = simd.vectorize(
            #[inline(always)]
            || decide(simd, ray, interval, block, possible, None),
        );
        hit.is_some()
    }
}

/// The exact test for the lanes that the filter left.
#[inline(always)]
fn decide<S: Simd>(
    simd: S,
    ray: &Ray,
    interval: Interval,
    block: &TriangleBlock,
    mut lanes: u32,
    mut best: Option<Hit>,
) -> Option<Hit> {
    let exact = ExactRay::new(ray);
    while lanes != 0 {
        let lane = lanes.trailing_zeros() as usize;
        lanes &= lanes - 1;
        let hit = hit_triangle_with(simd, &block.vertices(lane), block.index[lane], &exact, interval);
        if let Some(hit) = hit.filter(|h| h.precedes(best.as_ref())) {
            best = Some(hit);
        }
    }
    best
}

/// The bits of the first `len` lanes.
#[inline(always)]
fn used(len: usize) -> u32 {
    (1 << len) - 1
}

#[cfg(test)]
mod tests;
