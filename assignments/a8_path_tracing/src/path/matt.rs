//! Matt surfaces, eight at a time: what [`super::surface`] does for one, step by step.

use super::caustic::Chain;
use super::places::Places;
use super::surface::WORTH_GOING_ON;
use super::{PathTracer, Scratch};
use crate::Integrator;
use crate::eight::{disc, orthonormal_pair};
use crate::light::Receivers;
use crate::numbers::Use;
use common::counters::Counters;
use common::math::lanes::{
    Stored, add, dot, each, load, load_wide, multiply, narrow, normalize_single, scale, store, widen,
};
use common::math::{Vec3, circle};
use common::ray::Ray;
use common::simd::{Select, Simd, SimdBase, SimdFloat, SimdMask, f32x8, f64x8};
use std::f32::consts::FRAC_1_PI;

impl PathTracer<'_> {
    /// Asks lights for all matt surfaces, and goes on from them.
    #[inline(always)]
    pub(super) fn leave_matt<S: Simd>(
        &self,
        simd: S,
        scratch: &mut Scratch,
        generation: u32,
        counters: &mut Counters,
    ) {
        let matts = std::mem::take(&mut scratch.matts);
        let asks = self.rules.integrator != Integrator::Naive && !self.lights.is_empty();
        for block in &matts.blocks {
            let places = Places::new(simd, block, &scratch.paths);
            if asks {
                self.ask_for_eight(simd, scratch, &places, generation, counters);
            }
            self.go_on_from_eight(simd, scratch, &places, generation, counters);
        }
        scratch.matts = matts;
    }

    /// Asks one light for each.
    #[inline(always)]
    fn ask_for_eight<S: Simd>(
        &self,
        simd: S,
        scratch: &mut Scratch,
        places: &Places<S>,
        generation: u32,
        counters: &mut Counters,
    ) {
        let of = |x: f32| f32x8::splat(simd, x);
        let uv = self.numbers.pairs(&places.streams, &scratch.rows, Use::Light(generation));
        let normal = store(places.geometric);
        let to = Receivers { point: &places.block.point, normal: &normal, count: places.block.count };
        let offers = self.lights.offers(simd, &to, &uv);
        let direction = load_wide(simd, &offers.direction);
        let into = each(direction, |d| narrow(simd, d));
        let cosine = dot(places.normal, into);
        let by_path = of(FRAC_1_PI) * cosine;
        let faces = cosine.simd_gt(of(0.0));
        let response = each(places.color, |c| faces.select(c * by_path, of(0.0)));
        let pdf = f32x8::from_slice(simd, &offers.pdf);
        let weight = self.all_asked_for(simd, pdf, faces.select(by_path, of(0.0)));
        let light = multiply(multiply(places.throughput, response), load(simd, &offers.light));
        let light = scale(light, weight);
        let behind = dot(places.geometric, into).simd_le(of(0.0)).to_bitmask() as u32;
        let [red, green, blue] = each(light, |channel| channel.simd_eq(of(0.0)));
        let dark = (red & green & blue).to_bitmask() as u32;
        let made = offers.made & places.present();
        let sent = made & !behind & !dark;
        counters.skipped_shadow_behind += u64::from((made & behind).count_ones());
        counters.skipped_shadow_dark += u64::from((places.present() & !sent & !(made & behind)).count_ones());
        let (start, light, into) = (places.start(simd, direction), store(light), store(into));
        for lane in (0..places.block.count).filter(|lane| sent >> lane & 1 == 1) {
            let vector = |v: &Stored<f32>| Vec3::new(v[0][lane], v[1][lane], v[2][lane]);
            let (start, light) = (vector(&start), vector(&light));
            let slot = scratch.paths[places.block.path[lane] as usize].slot;
            match offers.endless >> lane & 1 {
                0 => scratch.near.push(Ray::new(start, vector(&offers.end) - start), slot, light),
                _ => scratch.far.push(Ray::new(start, vector(&into)), slot, light),
            }
        }
    }

    /// [`PathTracer::asked_for`] of eight.
    #[inline(always)]
    fn all_asked_for<S: Simd>(&self, simd: S, by_asking: f32x8<S>, by_path: f32x8<S>) -> f32x8<S> {
        let one = f32x8::splat(simd, 1.0);
        if self.rules.integrator != Integrator::Mis {
            return one;
        }
        let ratio = by_path / by_asking;
        let weighed = one / (one + ratio * ratio);
        by_asking.simd_lt(f32x8::splat(simd, f32::INFINITY)).select(weighed, one)
    }

    /// Chooses the ways on.
    #[inline(always)]
    fn go_on_from_eight<S: Simd>(
        &self,
        simd: S,
        scratch: &mut Scratch,
        places: &Places<S>,
        generation: u32,
        counters: &mut Counters,
    ) {
        let of = |x: f32| f32x8::splat(simd, x);
        let (zero, one) = (of(0.0), of(1.0));
        let uv = self.numbers.pairs(&places.streams, &scratch.rows, Use::Way(generation));
        let u = narrow(simd, f64x8::from_slice(simd, &uv[0]));
        let v = narrow(simd, f64x8::from_slice(simd, &uv[1]));
        let inside = u.max(zero).min(of(1.0 - f32::EPSILON));
        let (x, y) = disc(
            [inside, v],
            circle::SINGLE,
            #[inline(always)]
            |c| of(c as f32),
        );
        let z = (one - x * x - y * y).max(zero).sqrt();
        let [a, b] = orthonormal_pair(places.normal, one);
        let into = add(add(scale(a, x), scale(b, y)), scale(places.normal, z));
        let into = normalize_single(simd, into);
        let throughput = multiply(places.throughput, places.color);
        let most = throughput[0].max(throughput[1].max(throughput[2]));
        let same_side = dot(places.geometric, into).simd_gt(zero);
        let goes_on = u.simd_lt(one) & z.simd_gt(zero) & same_side & most.simd_gt(zero);
        let goes_on = goes_on.to_bitmask() as u32 & places.present();
        if goes_on == 0 {
            return;
        }
        let brightest = places.color[0].max(places.color[1].max(places.color[2]));
        let start = places.start(simd, each(into, |d| widen(simd, d)));
        let (into, geometric, throughput) = (store(into), store(places.geometric), store(throughput));
        let (pdf, brightest) = (*(z * of(FRAC_1_PI)), *brightest);
        let roulette = generation + 1 >= self.rules.roulette_depth;
        for lane in (0..places.block.count).filter(|lane| goes_on >> lane & 1 == 1) {
            let vector = |v: &Stored<f32>| Vec3::new(v[0][lane], v[1][lane], v[2][lane]);
            let mut path = scratch.paths[places.block.path[lane] as usize];
            path.throughput = vector(&throughput);
            path.left *= brightest[lane];
            let chance = path.left / WORTH_GOING_ON;
            if roulette && chance < 1.0 && !self.wins(&scratch.rows, &mut path, chance, generation) {
                counters.ended_by_roulette += 1;
                continue;
            }
            path.normal = vector(&geometric);
            path.pdf = pdf[lane];
            path.chain = Chain::None;
            scratch.next_rays.push(Ray::leaving(places.block.primitive[lane], vector(&start), vector(&into)));
            scratch.next_paths.push(path);
        }
    }
}
