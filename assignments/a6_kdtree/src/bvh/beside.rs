//! What stands beside the tree: planes and discs, and balls if they are few.

use super::abreast::{Abreast, RAYS};
use super::known::Known;
use super::sheets;
use super::wide::Bvh;
use common::counters::Counters;
use common::math::Interval;
use common::ray::Ray;
use common::simd::Simd;

/// Up to eight rays, and whether planes and discs must be asked about them.
pub struct Eight<'a> {
    /// The rays.
    pub rays: &'a [Ray],
    /// The same side by side.
    pub abreast: Abreast,
    /// Whether any may meet a plane or a disc.
    pub meet_sheets: bool,
}

impl Bvh<'_> {
    /// What is known of each ray when what stands there has been asked.
    #[inline(always)]
    pub(super) fn ask_beside<S: Simd, T: Known>(
        &self,
        simd: S,
        rays: &[Ray],
        interval: Interval,
        known: &mut [T],
        c: &mut Counters,
    ) {
        if self.stands_alone() {
            return known.fill(T::NONE);
        }
        for (rays, known) in rays.chunks(RAYS).zip(known.chunks_mut(RAYS)) {
            let meet_sheets = !sheets::all_leave(self.geometry.sheets(), rays);
            if !meet_sheets && self.balls.is_empty() {
                known.fill(T::NONE);
                continue;
            }
            let eight = Eight { rays, abreast: Abreast::of(simd, rays), meet_sheets };
            T::beside_tree(simd, self, &eight, interval, known, c);
        }
    }
}
