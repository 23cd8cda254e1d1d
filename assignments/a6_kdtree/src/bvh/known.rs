//! What is known of a ray when the tree is asked.

use super::abreast::{Firsts, RAYS};
use super::beside::Eight;
use super::purpose::{Ahead, Blocked, Nearest, Notes, Purpose};
use super::sheets;
use super::wide::Bvh;
use common::accel::Job;
use common::counters::Counters;
use common::geometry::Hit;
use common::math::Interval;
use common::shape::triangle_block::TriangleBlock;
use common::simd::Simd;

/// What is known of a ray when the tree is asked: its first hit so far, or whether there is any.
pub trait Known: Copy + PartialEq {
    /// Nothing yet.
    const NONE: Self;

    /// What finds out the rest.
    type Purpose<'a>: Purpose
    where
        Self: 'a;

    /// Asks what stands beside a tree about up to eight rays, and puts down what is known of them then.
    fn beside_tree<S: Simd>(
        simd: S,
        bvh: &Bvh,
        eight: &Eight,
        interval: Interval,
        known: &mut [Self],
        c: &mut Counters,
    );

    /// Finds out the rest of some rays.
    fn purpose<'a>(
        interval: Interval,
        known: &'a mut [Self],
        notes: &'a mut Notes,
        ahead: Ahead<'a, Self>,
    ) -> Self::Purpose<'a>;

    /// What the tree holds after this t does not matter; −∞ if nothing does. `max` is where the
    /// interval ends.
    fn last(&self, max: f32) -> f32;

    /// Looks at so many of the first triangles of a block. Hits later than `last` do not matter; returns
    /// until where they do from now on, −∞ if none does.
    fn look<S: Simd>(
        &mut self,
        simd: S,
        first: (&TriangleBlock, usize),
        last: f32,
        job: &Job,
        c: &mut Counters,
    ) -> f32;
}

impl Known for Option<Hit> {
    const NONE: Self = None;

    type Purpose<'a> = Nearest<'a>;

    #[inline(always)]
    fn beside_tree<S: Simd>(
        simd: S,
        bvh: &Bvh,
        eight: &Eight,
        interval: Interval,
        known: &mut [Self],
        c: &mut Counters,
    ) {
        let of = (eight.rays, &eight.abreast);
        let mut firsts = Firsts::NONE;
        if eight.meet_sheets {
            sheets::nearest(simd, bvh.geometry, of, interval, &mut firsts, c);
        }
        bvh.balls.nearest(simd, bvh.geometry, of, interval, &mut firsts, c);
        for (lane, hit) in known.iter_mut().enumerate().take(RAYS) {
            *hit = firsts.hit(lane);
        }
    }

    #[inline(always)]
    fn purpose<'a>(
        interval: Interval,
        best: &'a mut [Self],
        notes: &'a mut Notes,
        ahead: Ahead<'a, Self>,
    ) -> Nearest<'a> {
        Nearest { interval, best, notes, ahead }
    }

    #[inline(always)]
    fn last(&self, max: f32) -> f32 {
        self.map_or(max, |hit| hit.t)
    }

    #[inline(always)]
    fn look<S: Simd>(
        &mut self,
        simd: S,
        (block, len): (&TriangleBlock, usize),
        last: f32,
        job: &Job,
        c: &mut Counters,
    ) -> f32 {
        job.nearest_of(simd, block, len, last, self, c)
    }
}

impl Known for bool {
    const NONE: Self = false;

    type Purpose<'a> = Blocked<'a>;

    #[inline(always)]
    fn beside_tree<S: Simd>(
        simd: S,
        bvh: &Bvh,
        eight: &Eight,
        interval: Interval,
        known: &mut [Self],
        c: &mut Counters,
    ) {
        let of = (eight.rays, &eight.abreast);
        if eight.meet_sheets {
            sheets::any(simd, bvh.geometry, of, interval, known, c);
        } else {
            known.fill(false);
        }
        bvh.balls.any(simd, bvh.geometry, of, interval, known, c);
    }

    #[inline(always)]
    fn purpose<'a>(
        interval: Interval,
        hit: &'a mut [Self],
        notes: &'a mut Notes,
        ahead: Ahead<'a, Self>,
    ) -> Blocked<'a> {
        Blocked { interval, hit, notes, ahead }
    }

    #[inline(always)]
    fn last(&self, max: f32) -> f32 {
        if *self { f32::NEG_INFINITY } else { max }
    }

    #[inline(always)]
    fn look<S: Simd>(
        &mut self,
        simd: S,
        (block, len): (&TriangleBlock, usize),
        last: f32,
        job: &Job,
        c: &mut Counters,
    ) -> f32 {
        *self |= job.any_of(simd, block, len, c);
        if *self { f32::NEG_INFINITY } else { last }
    }
}
