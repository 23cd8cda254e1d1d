//! Whether each ray of a bundle hits anything.

use super::bundle::{Bundle, MOST, lanes_of, vector};
use super::stack::Stack;
use super::together::{Found, Journey, Leaf, Seek, Seeker};
use super::walk::walk;
use super::wide::{Bvh, Held};
use common::accel::Job;
use common::counters::Counters;
use common::shape::faces::Faces;
use common::shape::unfolded::Unfolded;
use common::simd::{Simd, f32x8};

struct AllBlocked<'a, 'g> {
    journey: Journey<'a, 'g>,
    max: f32,
    /// A bit for each ray that hits something.
    hit: u32,
}

impl<'a, 'g: 'a> Seek<'a, 'g> for AllBlocked<'a, 'g> {
    const BY_DISTANCE: bool = false;

    #[inline(always)]
    fn journey(&mut self) -> &mut Journey<'a, 'g> {
        &mut self.journey
    }

    #[inline(always)]
    fn ask_vector<S: Simd>(
        &mut self,
        simd: S,
        leaf: &Leaf,
        unfolded: &Unfolded,
        at: usize,
        mut asked: u32,
        c: &mut Counters,
    ) {
        let bundle = self.journey.bundle;
        let (lines, last) = (bundle.lines(simd, at), vector(simd, &self.journey.last, at));
        for lane in lanes_of(leaf.triangles) {
            let Some(verdicts) = unfolded.judge(simd, &lines, lane, asked, last) else { continue };
            let possible = bundle.not_leaving(at, verdicts.possible, leaf.block.index[lane]);
            let mut hit = verdicts.certain & possible;
            for ray in lanes_of(possible & !hit) {
                hit |= u32::from(self.journey.decide_now(leaf, lane, at + ray, c).is_some()) << ray;
            }
            self.hit |= hit << at;
            asked &= !hit;
            if asked == 0 {
                break;
            }
        }
    }

    #[inline(always)]
    fn ask_ray<S: Simd>(
        &mut self,
        simd: S,
        leaf: &Leaf,
        faces: &Faces<f32x8<S>>,
        ray: usize,
        c: &mut Counters,
    ) {
        let (Found { certain, doubtful }, _) = self.journey.judge(simd, leaf, faces, ray);
        let mut hit = certain != 0;
        for lane in lanes_of(doubtful) {
            hit = hit || self.journey.decide_now(leaf, lane, ray, c).is_some();
        }
        self.hit |= u32::from(hit) << ray;
    }

    #[inline(always)]
    fn ask_solids<S: Simd>(&mut self, simd: S, held: Held, ray: usize, c: &mut Counters) {
        let Bundle { packet, rays, interval, .. } = *self.journey.bundle;
        let job = Job { filter: &packet.filter(ray), ray: &rays[ray], interval };
        self.hit |= u32::from(self.journey.bvh.any_held(simd, held, &job, c)) << ray;
    }

    #[inline(always)]
    fn settled(&self) -> u32 {
        self.hit
    }

    #[inline(always)]
    fn end<S: Simd>(&mut self, _: S) -> f32 {
        if self.hit == self.journey.bundle.asked { f32::NEG_INFINITY } else { self.max }
    }
}

impl Bvh<'_> {
    /// A bit for each of the asked rays that hits anything.
    #[inline(always)]
    pub(super) fn any_together<S: Simd>(
        &self,
        simd: S,
        bundle: &Bundle,
        stack: &mut Stack,
        c: &mut Counters,
    ) -> u32 {
        let journey = Journey::new(simd, self, bundle, &[bundle.interval.max; MOST]);
        let max = journey.greatest(simd);
        let mut blocked = Seeker(AllBlocked { journey, max, hit: 0 });
        walk(simd, (self, 0), stack, max, bundle, &mut blocked, c);
        blocked.0.hit
    }
}
