//! The first hit of each ray of a bundle.

use super::bundle::{Bundle, MOST, lanes_of, vector, vector_of};
use super::packet::{Lanes, RAYS};
use super::pending::Pending;
use super::purpose::Notes;
use super::together::{Found, Journey, Leaf, Seek, Seeker, mask};
use super::walk::walk;
use super::wide::{Bvh, Held};
use common::accel::Job;
use common::counters::Counters;
use common::geometry::Hit;
use common::shape::faces::Faces;
use common::shape::unfolded::{Unfolded, Verdicts};
use common::simd::{Select, Simd, SimdBase, SimdMask, f32x8};

struct FirstHits<'a, 'g> {
    journey: Journey<'a, 'g>,
    /// By ray.
    best: &'a mut [Option<Hit>],
    /// Number of the first ray.
    first: usize,
    pending: &'a mut Pending,
    /// By ray: the triangle that it hits first as far as is known, if it has a bit in `hit` …
    triangle: [u32; MOST],
    /// … and where that is hit at the earliest; infinite if there is none.
    earliest: Lanes<MOST>,
    hit: u32,
    /// The latest limit …
    max: f32,
    /// … but for those that changed since.
    changed: bool,
}

impl FirstHits<'_, '_> {
    /// Puts down that a ray must ask a triangle.
    #[inline(always)]
    fn wait(&mut self, triangle: u32, ray: usize) {
        self.pending.push(self.first + ray, triangle);
    }

    /// Takes a triangle that rays of a vector surely hit for the first, if it is that or in doubt. What was
    /// first is forgotten where it surely comes later.
    #[inline(always)]
    fn replace<S: Simd>(
        &mut self,
        simd: S,
        triangle: u32,
        at: usize,
        verdicts: &Verdicts<S::f32s>,
        certain: u32,
    ) {
        let these = mask::<S>(simd, certain);
        let earliest = vector(simd, &self.earliest, at);
        let in_doubt = these & !verdicts.latest.simd_lt(earliest);
        if in_doubt.any_true() {
            for ray in lanes_of(in_doubt.to_bitmask() as u32) {
                self.wait(self.triangle[at + ray], at + ray);
            }
        }
        these.select(verdicts.earliest, earliest).store_slice(vector_of::<S, _>(&mut self.earliest, at));
        let before = S::u32s::from_slice(simd, vector_of::<S, _>(&mut self.triangle, at));
        let this = S::u32s::splat(simd, triangle);
        these.select(this, before).store_slice(vector_of::<S, _>(&mut self.triangle, at));
        self.hit |= certain << at;
    }

    /// Asks at once; whether the answer matters.
    #[inline(always)]
    fn decide_now(&mut self, leaf: &Leaf, lane: usize, ray: usize, c: &mut Counters) -> bool {
        let Some(hit) = self.journey.decide_now(leaf, lane, ray, c) else { return false };
        let (best, last) = (&mut self.best[ray], &mut self.journey.last[ray]);
        if hit.precedes(best.as_ref()) {
            *best = Some(hit);
        }
        let is_before = hit.t < *last;
        *last = if is_before { hit.t } else { *last };
        is_before
    }
}

impl<'a, 'g: 'a> Seek<'a, 'g> for FirstHits<'a, 'g> {
    const BY_DISTANCE: bool = true;

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
        asked: u32,
        c: &mut Counters,
    ) {
        let bundle = self.journey.bundle;
        let lines = bundle.lines(simd, at);
        let (mut last, mut changed) = (vector(simd, &self.journey.last, at), 0);
        for lane in lanes_of(leaf.triangles) {
            let Some(verdicts) = unfolded.judge(simd, &lines, lane, asked, last) else { continue };
            let possible = bundle.not_leaving(at, verdicts.possible, leaf.block.index[lane]);
            let certain = verdicts.certain & possible;
            changed |= certain;
            last = mask(simd, certain).select(last.min(verdicts.latest), last);
            self.replace(simd, leaf.triangle(lane), at, &verdicts, certain);
            for ray in lanes_of(possible & !certain) {
                last.store_slice(vector_of::<S, _>(&mut self.journey.last, at));
                changed |= u32::from(self.decide_now(leaf, lane, at + ray, c)) << ray;
                last = vector(simd, &self.journey.last, at);
            }
        }
        if changed != 0 {
            self.changed = true;
            last.store_slice(vector_of::<S, _>(&mut self.journey.last, at));
            self.journey.end_vector(simd, at, changed);
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
        let (Found { certain, doubtful }, latest) = self.journey.judge(simd, leaf, faces, ray);
        let (mut last, mut changed) = (self.journey.last[ray], certain != 0);
        for lane in lanes_of(certain) {
            let latest = latest[lane % RAYS];
            last = if latest < last { latest } else { last };
            self.wait(leaf.triangle(lane), ray);
        }
        for lane in lanes_of(doubtful) {
            changed |= self.decide_now(leaf, lane, ray, c);
            let t = self.journey.last[ray];
            last = if t < last { t } else { last };
        }
        if changed {
            self.changed = true;
            self.journey.end_ray(simd, ray, last);
        }
    }

    #[inline(always)]
    fn ask_solids<S: Simd>(&mut self, simd: S, held: Held, ray: usize, c: &mut Counters) {
        let Bundle { packet, rays, interval, .. } = *self.journey.bundle;
        let job = Job { filter: &packet.filter(ray), ray: &rays[ray], interval };
        let (last, best) = (self.journey.last[ray], &mut self.best[ray]);
        let last = self.journey.bvh.nearest_held(simd, held, &job, last, best, c);
        self.changed = true;
        self.journey.end_ray(simd, ray, last);
    }

    #[inline(always)]
    fn settled(&self) -> u32 {
        0
    }

    #[inline(always)]
    fn end<S: Simd>(&mut self, simd: S) -> f32 {
        if std::mem::take(&mut self.changed) {
            self.max = self.journey.greatest(simd);
        }
        self.max
    }
}

impl Bvh<'_> {
    /// Puts the better of what is there and the first hit of each ray into `best`, but for what is then
    /// pending; `first` is the number of the first ray.
    #[inline(always)]
    pub(super) fn nearest_together<S: Simd>(
        &self,
        simd: S,
        (bundle, first): (&Bundle, usize),
        Notes { stack, pending }: &mut Notes,
        best: &mut [Option<Hit>],
        c: &mut Counters,
    ) {
        let mut last = [bundle.interval.max; MOST];
        for (last, best) in last.iter_mut().zip(best.iter()) {
            *last = best.map_or(*last, |b| b.t);
        }
        let journey = Journey::new(simd, self, bundle, &last);
        let max = journey.greatest(simd);
        let (triangle, earliest) = ([0; MOST], [f32::INFINITY; MOST]);
        let firsts =
            FirstHits { journey, best, first, pending, triangle, earliest, hit: 0, max, changed: false };
        let mut seeker = Seeker(firsts);
        walk(simd, (self, 0), stack, max, bundle, &mut seeker, c);
        for ray in lanes_of(seeker.0.hit) {
            seeker.0.wait(seeker.0.triangle[ray], ray);
        }
    }
}
