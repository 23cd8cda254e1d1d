//! Many rays of one octant that go from node to node in lists.

use super::abreast::columns;
use super::known::Known;
use super::packet::RAYS;
use super::record::Record;
use super::single::limits;
use super::slabs::Slabs;
use common::math::Bounds;
use common::ray::Ray;
use common::shape::filter::Errors;
use common::simd::{Simd, SimdBase, f32x8};

/// Ways that signs of directions can be.
pub const OCTANTS: usize = 8;

/// Records of a stream that the second cache holds beside all else, and rays of which there are fewer
/// make none.
pub const MANY: usize = 4096;

/// The rays of a stream, copied together: elsewhere they may lie far apart.
pub struct Stream {
    /// What boxes and triangles want to know of each ray.
    pub records: Vec<Record>,
    /// The rays.
    pub rays: Vec<Ray>,
    /// The signs of their directions, a bit for each axis.
    pub octant: usize,
    /// By how much boxes are made wider.
    pub room: f32,
}

impl Stream {
    /// Of nobody, for boxes that are made so much wider.
    pub fn new(room: f32) -> Self {
        Self { records: Vec::new(), rays: Vec::new(), octant: 0, room }
    }

    /// Takes those of all rays that have these numbers and are of one octant, in place of others.
    /// So much is `known` of each; `max` is where hits end to count, `bounds` are the tree's.
    #[inline(always)]
    pub fn fill<S: Simd>(
        &mut self,
        simd: S,
        (octant, numbers): (usize, &[u32]),
        rays: &[Ray],
        known: &[impl Known],
        max: f32,
        bounds: &Bounds,
    ) {
        self.octant = octant;
        self.rays.clear();
        self.rays.extend(numbers.iter().map(|&number| rays[number as usize]));
        // Those behind the last ray repeat it, and are on no list.
        self.records.resize(numbers.len().next_multiple_of(RAYS), Record::NONE);
        for (first, records) in (0..).step_by(RAYS).zip(self.records.chunks_mut(RAYS)) {
            let end = numbers.len().min(first + RAYS);
            let mut last = [max; RAYS];
            for (last, known) in last.iter_mut().zip(&known[first..end]) {
                *last = known.last(max);
            }
            record(simd, &self.rays[first..end], &last, bounds, records);
        }
    }
}

/// Prepares one to eight rays.
#[inline(always)]
fn record<S: Simd>(simd: S, rays: &[Ray], last: &[f32; RAYS], bounds: &Bounds, records: &mut [Record]) {
    let [origin, direction] = columns(simd, rays, rays[rays.len() - 1]);
    let zero = f32x8::splat(simd, 0.0);
    let (mut inverse, mut far, mut step) = (origin, zero, zero);
    for axis in 0..3 {
        let (o, d) = (origin[axis], direction[axis]);
        let [min, max] = [f32x8::splat(simd, bounds.min[axis]), f32x8::splat(simd, bounds.max[axis])];
        let slab = Slabs::new(simd, o, d, min, max);
        inverse[axis] = slab.inverse;
        far = far.max(slab.far);
        step = step.max(d.abs());
    }
    let [reach, ..] = Errors::abreast(simd, far, step);
    let last = f32x8::from_slice(simd, last);
    let limit = limits(simd, last, reach);
    Record::put(simd, records, [origin, direction, inverse], [far, step], [limit, last]);
}
