//! Triangles that rays may hit, to be asked exactly, eight at a time.
//!
//! While rays go through the tree together it is enough to know that a hit is certain, and by when:
//! where it is exactly can wait until there are enough such questions to fill a vector.

use super::bundle::MOST;
use super::packet::RAYS;
use super::wide::Bvh;
use common::counters::Counters;
use common::geometry::{Hit, hit_triangle, hit_within};
use common::math::Interval;
use common::ray::Ray;
use common::shape::ExactRay;
use common::shape::triangle::abreast::{Corners, intersect_eight};
use common::shape::triangle_block::{LANES, TriangleBlock};
use common::simd::Simd;

/// So many wait before they are asked, as a rule: what they need is still in the nearest cache.
const ENOUGH: usize = 2 * MOST;

/// A ray and a triangle that it may hit.
#[derive(Clone, Copy)]
pub struct Candidate {
    /// Number of the ray.
    pub ray: u32,
    /// The number of the triangle among all places of all blocks.
    pub triangle: u32,
}

impl Candidate {
    /// The block of the triangle, and its place there.
    #[inline(always)]
    fn block_and_lane<'b>(&self, bvh: &'b Bvh) -> (&'b TriangleBlock, usize) {
        let triangle = self.triangle as usize;
        (&bvh.blocks[triangle / LANES], triangle % LANES)
    }
}

/// Those that wait.
#[derive(Default)]
pub struct Pending(Vec<Candidate>);

impl Pending {
    /// One more.
    #[inline(always)]
    pub fn push(&mut self, candidate: Candidate) {
        self.0.push(candidate);
    }

    /// Whether there are enough.
    #[inline(always)]
    pub fn are_enough(&self) -> bool {
        self.0.len() >= ENOUGH
    }

    /// Decides what waits; hits that are better than what is known of their rays take its place.
    #[inline(always)]
    pub fn decide<S: Simd>(
        &mut self,
        simd: S,
        bvh: &Bvh,
        rays: &[Ray],
        interval: Interval,
        best: &mut [Option<Hit>],
        c: &mut Counters,
    ) {
        c.exact_tests += self.0.len() as u64;
        for candidates in self.0.chunks(RAYS) {
            let mut eight = [candidates[0]; RAYS];
            eight[..candidates.len()].copy_from_slice(candidates);
            let of = |i: usize| &rays[eight[i].ray as usize];
            let mut corners: Corners = [[[0.0; RAYS]; 3]; 3];
            for (place, candidate) in eight.iter().enumerate() {
                let (block, lane) = candidate.block_and_lane(bvh);
                block.copy_corners(lane, &mut corners, place);
            }
            let these = [of(0), of(1), of(2), of(3), of(4), of(5), of(6), of(7)];
            let passages = intersect_eight(simd, these, &corners);
            for (i, candidate) in candidates.iter().enumerate() {
                let (ray, (block, lane)) = (candidate.ray as usize, candidate.block_and_lane(bvh));
                let primitive = block.index[lane];
                let hit = if passages.decided >> i & 1 == 0 {
                    let ray = ExactRay::new(&rays[ray]);
                    hit_triangle(&block.vertices(lane), primitive, &ray, interval)
                } else {
                    passages.hit(i).and_then(|hit| hit_within(hit, primitive, interval))
                };
                let best = &mut best[ray];
                if let Some(hit) = hit.filter(|hit| hit.precedes(best.as_ref())) {
                    *best = Some(hit);
                }
            }
        }
        self.0.clear();
    }
}
