//! Our own test, alone and behind its filter.

use super::kernel::{Contender, Kernel};
use common::accel::{Accel, List};
use common::counters::Counters;
use common::geometry::{Geometry, hit_triangle};
use common::math::{Bounds, Interval, Vec3};
use common::ray::Ray;
use common::shape::filter::Filter;
use common::shape::triangle_block::{LANES, TriangleBlock};
use common::shape::{ExactRay, triangle};
use common::simd::{self, dispatch};

/// The scalar test that decides.
pub struct Exact;

impl Kernel for Exact {
    const NAME: &'static str = "ours, scalar exact";
    type Ray = ExactRay;
    type Triangle = [Vec3; 3];

    fn ray(ray: &Ray) -> ExactRay {
        ExactRay::new(ray)
    }

    fn triangle(corners: &[Vec3; 3]) -> [Vec3; 3] {
        *corners
    }

    #[inline(always)]
    fn hit(ray: &ExactRay, corners: &[Vec3; 3]) -> Option<f64> {
        triangle::intersect(ray, corners).map(|hit| f64::from(hit.t))
    }
}

/// What every structure asks: eight lanes at a time, then the exact test for what is left.
pub struct Filtered<'g> {
    list: List<'g>,
    blocks: Vec<TriangleBlock>,
    bounds: Bounds,
}

impl<'g> Filtered<'g> {
    /// Packs the triangles.
    pub fn new(geometry: &'g Geometry) -> Self {
        let numbered: Vec<(u32, [Vec3; 3])> = (0..).zip(geometry.triangles().iter().copied()).collect();
        let blocks = numbered.chunks(LANES).map(|chunk| TriangleBlock::pack(chunk.iter().copied())).collect();
        let bounds = Bounds::of_points(geometry.triangles().iter().flatten().copied());
        Self { list: List::new(geometry), blocks, bounds }
    }
}

impl Contender for Filtered<'_> {
    fn name(&self) -> &'static str {
        "ours, filter + exact (8 lanes)"
    }

    fn crossings(&self, ray: &Ray, found: &mut Vec<f64>) {
        let (filter, exact) = (Filter::new(ray, &self.bounds), ExactRay::new(ray));
        for block in &self.blocks {
            let verdict = dispatch!(simd::level(), s => block.judge(s, &filter, Interval::ALL));
            let lanes = (0..block.len()).filter(|lane| verdict.possible >> lane & 1 == 1);
            let hit = |lane| hit_triangle(&block.vertices(lane), block.index[lane], &exact, Interval::ALL);
            found.extend(lanes.filter_map(hit).map(|hit| f64::from(hit.t)));
        }
    }

    fn nearest(&self, ray: &Ray) -> f64 {
        let hit = self.list.nearest(ray, Interval::FORWARD, &mut Counters::default());
        hit.map_or(f64::INFINITY, |hit| f64::from(hit.t))
    }
}
