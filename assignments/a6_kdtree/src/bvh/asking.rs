//! Of which rays the tree must be asked.
//!
//! Many rays surely meet nothing in it: they pass its box by, have met something nearer beside it,
//! or leave a triangle for good. Those that are left are put together, so that no lane is wasted.

use super::abreast::RAYS;
use super::aside::{CROWD, entering, widened};
use super::bundle::lanes_of;
use super::horizon::{Horizons, Sky};
use super::known::Known;
use super::wide::Bvh;
use common::accel::Job;
use common::counters::Counters;
use common::math::Interval;
use common::ray::Ray;
use common::shape::filter::Filter;
use common::simd::Simd;
use std::ops::Range;

/// The rays of which the tree must be asked, in their order, and which of all rays they are. As
/// long as all are, they are only counted.
struct Asked<'r> {
    all: &'r [Ray],
    /// So many of the first are asked …
    first: usize,
    /// … and these, if not all are; the first are among them then.
    rays: Vec<Ray>,
    numbers: Vec<u32>,
}

impl Asked<'_> {
    /// One more; all come in order. A slice of one would be copied by a call.
    #[inline(always)]
    fn push(&mut self, number: usize) {
        if !self.is_counted(&(number..number + 1)) {
            self.rays.push(self.all[number]);
            self.numbers.push(number as u32);
        }
    }

    /// Some more, one after the other.
    #[inline(always)]
    fn push_all(&mut self, numbers: Range<usize>) {
        if !self.is_counted(&numbers) {
            self.rays.extend_from_slice(&self.all[numbers.clone()]);
            self.numbers.extend(numbers.start as u32..numbers.end as u32);
        }
    }

    /// Counts some if all before them are asked; otherwise those that were counted are put down.
    #[inline(always)]
    fn is_counted(&mut self, numbers: &Range<usize>) -> bool {
        let counts = self.first == numbers.start;
        if counts {
            self.first = numbers.end;
        } else if self.rays.is_empty() {
            self.rays.reserve(self.all.len());
            self.numbers.reserve(self.all.len());
            self.rays.extend_from_slice(&self.all[..self.first]);
            self.numbers.extend(0..self.first as u32);
        }
        counts
    }
}

impl Bvh<'_> {
    /// Calls `follow` for the rays of which the tree must be asked, with what is known of them and
    /// which of all `rays` they are, if not all.
    #[inline(always)]
    pub(super) fn ask_for<S: Simd, T: Known>(
        &self,
        simd: S,
        rays: &[Ray],
        interval: Interval,
        known: &mut [T],
        follow: impl FnOnce(&[Ray], &mut [T], &[u32], &mut Counters),
        c: &mut Counters,
    ) {
        let asked = self.settle(simd, rays, interval, known, c);
        let mut kept = Vec::new();
        let (rays, these) = if asked.rays.is_empty() {
            (&rays[..asked.first], &mut known[..asked.first])
        } else {
            kept.extend(asked.numbers.iter().map(|&i| known[i as usize]));
            (&*asked.rays, &mut *kept)
        };
        if rays.is_empty() {
            return;
        }
        // Called in one place only: what is done there is much, and inlined.
        follow(rays, these, &asked.numbers, c);
        for (&i, value) in asked.numbers.iter().zip(kept) {
            known[i as usize] = value;
        }
    }

    /// Settles what can be settled without the tree, and says which rays are left.
    #[inline(always)]
    fn settle<'r, S: Simd, T: Known>(
        &self,
        simd: S,
        rays: &'r [Ray],
        interval: Interval,
        known: &mut [T],
        c: &mut Counters,
    ) -> Asked<'r> {
        let mut asked = Asked { all: rays, first: 0, rays: Vec::new(), numbers: Vec::new() };
        let (horizons, around) = (self.horizons_of(rays, interval), widened(&self.bounds));
        // Where the tree is all there is, nearly all rays enter it.
        let stands_alone = self.stands_alone();
        for (crowd, first_of_crowd) in rays.chunks(CROWD).zip((0..).step_by(CROWD)) {
            if self.is_passed_by(simd, crowd, interval) {
                continue;
            }
            if stands_alone && horizons.is_none() {
                asked.push_all(first_of_crowd..first_of_crowd + crowd.len());
                continue;
            }
            for (rays, first) in crowd.chunks(RAYS).zip((first_of_crowd..).step_by(RAYS)) {
                let mut entered = (1 << rays.len()) - 1;
                if !stands_alone {
                    let mut last = [f32::NEG_INFINITY; RAYS];
                    for (last, known) in last.iter_mut().zip(&known[first..first + rays.len()]) {
                        *last = known.last(interval.max);
                    }
                    entered &= entering(simd, rays, &around, interval.min, &last);
                }
                for lane in lanes_of(entered) {
                    match horizons.map_or(Sky::Crowded, |horizons| horizons.sky(&rays[lane])) {
                        Sky::Open => {}
                        Sky::Few(block) => {
                            let (ray, filter) = (&rays[lane], &Filter::new(&rays[lane], &self.bounds));
                            let (known, job) = (&mut known[first + lane], Job { filter, ray, interval });
                            known.look(simd, (block, block.len()), known.last(interval.max), &job, c);
                        }
                        Sky::Crowded => asked.push(first + lane),
                    }
                }
            }
        }
        asked
    }

    /// What is above the triangles that rays leave, if that is known and any leaves one.
    #[inline(always)]
    fn horizons_of(&self, rays: &[Ray], interval: Interval) -> Option<&Horizons> {
        let leaves = |ray: &Ray| ray.home != Ray::ANYWHERE;
        if interval.min < 0.0 || !rays.iter().any(leaves) {
            return None;
        }
        self.horizons.get_or_init(|| Horizons::of(self.geometry)).as_ref()
    }
}
