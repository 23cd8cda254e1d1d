//! What stands beside the tree: planes and discs, and balls if they are few.

use super::abreast::{Abreast, Firsts, RAYS};
use super::sheets;
use super::wide::Bvh;
use common::counters::Counters;
use common::geometry::Hit;
use common::math::Interval;
use common::ray::Ray;
use common::simd::Simd;

impl Bvh<'_> {
    /// The first hit of each ray there.
    #[inline(always)]
    pub(super) fn nearest_beside<S: Simd>(
        &self,
        simd: S,
        rays: &[Ray],
        interval: Interval,
        hits: &mut [Option<Hit>],
        c: &mut Counters,
    ) {
        if self.stands_alone() {
            return hits.fill(None);
        }
        for (rays, hits) in rays.chunks(RAYS).zip(hits.chunks_mut(RAYS)) {
            let all_leave = sheets::all_leave(self.geometry.sheets(), rays);
            if all_leave && self.balls.is_empty() {
                hits.fill(None);
                continue;
            }
            let abreast = Abreast::of(simd, rays);
            let mut firsts = Firsts::NONE;
            if !all_leave {
                sheets::nearest(simd, self.geometry, (rays, &abreast), interval, &mut firsts, c);
            }
            self.balls.nearest(simd, self.geometry, (rays, &abreast), interval, &mut firsts, c);
            for (lane, hit) in hits.iter_mut().enumerate().take(RAYS) {
                *hit = firsts.hit(lane);
            }
        }
    }

    /// Whether each ray hits anything there.
    #[inline(always)]
    pub(super) fn any_beside<S: Simd>(
        &self,
        simd: S,
        rays: &[Ray],
        interval: Interval,
        hit: &mut [bool],
        c: &mut Counters,
    ) {
        if self.stands_alone() {
            return hit.fill(false);
        }
        for (rays, hit) in rays.chunks(RAYS).zip(hit.chunks_mut(RAYS)) {
            let all_leave = sheets::all_leave(self.geometry.sheets(), rays);
            if all_leave {
                hit.fill(false);
                if self.balls.is_empty() {
                    continue;
                }
            }
            let abreast = Abreast::of(simd, rays);
            if !all_leave {
                sheets::any(simd, self.geometry, (rays, &abreast), interval, hit, c);
            }
            self.balls.any(simd, self.geometry, (rays, &abreast), interval, hit, c);
        }
    }
}
