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
use common::shape::gathered::corners_of;
use common::shape::triangle::abreast::intersect_eight;
use common::shape::triangle_block::LANES;
use common::simd::Simd;

/// So many wait before they are asked, as a rule: what they need is still in the nearest cache.
const ENOUGH: usize = 2 * MOST;

/// Rays, and for each a triangle that it may hit.
#[derive(Default)]
pub struct Pending {
    /// Numbers of the rays.
    rays: Vec<u32>,
    /// Numbers of the triangles among all places of all blocks.
    triangles: Vec<u32>,
}

impl Pending {
    /// One more.
    #[inline(always)]
    pub fn push(&mut self, ray: usize, triangle: u32) {
        self.rays.push(ray as u32);
        self.triangles.push(triangle);
    }

    /// Whether there are enough.
    #[inline(always)]
    pub fn are_enough(&self) -> bool {
        self.rays.len() >= ENOUGH
    }

    /// Decides what waits, all of it or as long as there are eight; hits that are better than what is known of
    /// their rays take its place.
    #[inline(always)]
    pub fn decide<S: Simd>(
        &mut self,
        simd: S,
        (bvh, rays): (&Bvh, &[Ray]),
        (interval, all): (Interval, bool),
        best: &mut [Option<Hit>],
        c: &mut Counters,
    ) {
        let waiting = self.rays.len();
        let count = if all { waiting } else { waiting / RAYS * RAYS };
        if count == 0 {
            return;
        }
        // What is missing of the last eight repeats one.
        let padded = count.next_multiple_of(RAYS);
        self.rays.resize(waiting.max(padded), self.rays[0]);
        self.triangles.resize(waiting.max(padded), self.triangles[0]);
        let (eights, _) = self.rays[..padded].as_chunks::<RAYS>();
        let (triangles, _) = self.triangles[..padded].as_chunks();
        for (numbers, triangles) in eights.iter().zip(triangles) {
            let of = |i: usize| &rays[numbers[i] as usize];
            let these = [of(0), of(1), of(2), of(3), of(4), of(5), of(6), of(7)];
            let passages = intersect_eight(simd, these, corners_of(simd, &bvh.blocks, triangles));
            for i in 0..RAYS {
                let (ray, triangle) = (numbers[i] as usize, triangles[i] as usize);
                let (block, lane) = (&bvh.blocks[triangle / LANES], triangle % LANES);
                let primitive = block.index[lane];
                let hit = if passages.decided >> i & 1 == 0 {
                    hit_triangle(&block.vertices(lane), primitive, &ExactRay::new(&rays[ray]), interval)
                } else {
                    passages.hit(i).and_then(|hit| hit_within(hit, primitive, interval))
                };
                let best = &mut best[ray];
                if let Some(hit) = hit.filter(|hit| hit.precedes(best.as_ref())) {
                    *best = Some(hit);
                }
            }
        }
        c.exact_tests += count as u64;
        self.rays.drain(..padded);
        self.triangles.drain(..padded);
    }
}
