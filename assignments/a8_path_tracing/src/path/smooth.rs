//! Mirrors and glass, eight at a time: what [`crate::bsdf`] and [`super::surface`] do for one, step
//! by step.

use super::caustic::Chain;
use super::places::Places;
use super::{PathTracer, Scratch};
use crate::Integrator;
use crate::numbers::Use;
use common::counters::Counters;
use common::math::Vec3;
use common::math::lanes::{
    Stored, Vectors, add, dot, each, multiply, narrow, normalize, scale, store, subtract, widen,
};
use common::ray::Ray;
use common::simd::{Select, Simd, SimdBase, SimdFloat, SimdMask, f32x8, f64x8};

impl PathTracer<'_> {
    /// Goes on from all mirrors and all glass.
    #[inline(always)]
    pub(super) fn leave_smooth<S: Simd>(
        &self,
        simd: S,
        scratch: &mut Scratch,
        generation: u32,
        counters: &mut Counters,
    ) {
        let queue = std::mem::take(&mut scratch.smooth);
        for block in &queue.blocks {
            let places = Places::new(simd, block, &scratch.paths);
            self.mirror_and_refract(simd, scratch, &places, generation);
            if self.rules.integrator != Integrator::Naive && !self.lights.is_empty() {
                counters.skipped_light_specular += block.count as u64;
            }
        }
        scratch.smooth = queue;
    }

    #[inline(always)]
    fn mirror_and_refract<S: Simd>(
        &self,
        simd: S,
        scratch: &mut Scratch,
        places: &Places<S>,
        generation: u32,
    ) {
        let [_, incoming] = Ray::columns(simd, scratch.rays_of(&places.block.path));
        let incoming = each(incoming, |d| widen(simd, d));
        let normal = each(places.normal, |n| widen(simd, n));
        let side = widen(simd, f32x8::from_slice(simd, &places.block.side));
        let index = widen(simd, f32x8::from_slice(simd, &places.block.index));
        let zero = f64x8::splat(simd, 0.0);
        let mut direction = mirror(simd, incoming, normal);
        let is_glass = index.simd_gt(zero);
        if is_glass.to_bitmask() != 0 {
            let uv = self.numbers.pairs(&places.streams, &scratch.rows, Use::Way(generation));
            let u = narrow(simd, f64x8::from_slice(simd, &uv[0]));
            let u = u.max(f32x8::splat(simd, 0.0)).min(f32x8::splat(simd, 1.0 - f32::EPSILON));
            let (through, reflectance) = refract(simd, incoming, scale(normal, side), index);
            let goes_through = is_glass & widen(simd, u).simd_ge(reflectance);
            direction = each([0, 1, 2], |axis: usize| goes_through.select(through[axis], direction[axis]));
        }
        let direction = each(direction, |d| narrow(simd, d));
        let start = places.start(simd, each(direction, |d| widen(simd, d)));
        let (direction, geometric) = (store(direction), store(places.geometric));
        let throughput = store(multiply(places.throughput, places.color));
        for lane in 0..places.block.count {
            let vector = |v: &Stored<f32>| Vec3::new(v[0][lane], v[1][lane], v[2][lane]);
            let throughput = vector(&throughput);
            if throughput.max_element() <= 0.0 {
                continue;
            }
            let mut path = scratch.paths[places.block.path[lane] as usize];
            (path.throughput, path.normal) = (throughput, vector(&geometric));
            (path.pdf, path.chain) = (f32::INFINITY, Chain::None);
            let ray = Ray::leaving(places.block.primitive[lane], vector(&start), vector(&direction));
            scratch.next_rays.push(ray);
            scratch.next_paths.push(path);
        }
    }
}

/// [`a4_whitted::mirror`].
#[inline(always)]
fn mirror<S: Simd>(simd: S, incoming: Vectors<f64x8<S>>, normal: Vectors<f64x8<S>>) -> Vectors<f64x8<S>> {
    let twice = f64x8::splat(simd, 2.0) * dot(incoming, normal);
    normalize(simd, subtract(incoming, scale(normal, twice)))
}

/// [`a4_whitted::refract`]: the refracted direction, and the share of light that is mirrored. Where
/// all is, the direction means nothing.
#[inline(always)]
fn refract<S: Simd>(
    simd: S,
    incoming: Vectors<f64x8<S>>,
    normal: Vectors<f64x8<S>>,
    index: f64x8<S>,
) -> (Vectors<f64x8<S>>, f64x8<S>) {
    let (zero, one, two) = (f64x8::splat(simd, 0.0), f64x8::splat(simd, 1.0), f64x8::splat(simd, 2.0));
    let leaves = dot(incoming, normal).simd_gt(zero);
    let eta = leaves.select(index, one / index);
    let against = scale(normal, leaves.select(-one, one));
    let cos_in = -dot(incoming, against);
    let cos_out_squared = one - eta * eta * (one - cos_in * cos_in);
    let cos_out = cos_out_squared.sqrt();
    let direction = add(scale(incoming, eta), scale(against, eta * cos_in - cos_out));
    let across = (eta * cos_in - cos_out) / (eta * cos_in + cos_out);
    let within = (cos_in - eta * cos_out) / (cos_in + eta * cos_out);
    let reflectance = (across * across + within * within) / two;
    // Where all is mirrored there is no cosine, and the share is no number.
    let reflectance = reflectance.simd_ge(zero).select(reflectance, one);
    (normalize(simd, direction), reflectance)
}
