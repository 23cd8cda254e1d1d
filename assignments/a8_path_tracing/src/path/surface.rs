//! What happens where a path meets a surface.

use super::caustic::Chain;
use super::{Found, Path, PathTracer, Scratch};
use crate::Integrator;
use crate::bsdf::Bsdf;
use crate::numbers::{Choice, Rows, Use};
use a1_ray_casting::Mixture;
use common::counters::Counters;
use common::geometry::{Departure, Surface};
use common::math::Vec3;
use common::ray::Ray;
use common::scene::PhongMaterial;
use std::borrow::Cow;

/// Share of light that may be lost before roulette is worth its noise. Of 1, ½, 0.3, 0.15 and 0.07
/// the second and third gave least error in the same time on the three scenes 8_01 to 8_03.
pub(super) const WORTH_GOING_ON: f32 = 0.4;

/// A surface as a path meets it.
pub(super) struct Place<'s> {
    pub surface: &'s Surface,
    /// Unit vector to where the path comes from.
    pub out: Vec3,
    /// Normal to shade with, on the side of `out`.
    pub normal: Vec3,
    /// The surface's own normal, on that side.
    pub geometric: Vec3,
    /// Whether that side is the inside of the body.
    pub inside: bool,
    /// Where rays start.
    pub departure: Departure,
}

impl<'s> Place<'s> {
    #[inline(always)]
    fn new(surface: &'s Surface, ray: &Ray) -> Self {
        let out = -ray.direction;
        let own = surface.geometric_normal.as_vec3();
        let inside = surface.geometric_normal.dot(ray.direction.as_dvec3()) > 0.0;
        let side = if inside { -1.0 } else { 1.0 };
        Self {
            surface,
            out,
            normal: surface.normal * side,
            geometric: own * side,
            inside,
            departure: surface.departure(),
        }
    }
}

impl PathTracer<'_> {
    /// Takes what the surface gives off, asks a light, and goes on.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "the body of a loop over paths")]
    pub(super) fn meet(
        &self,
        scratch: &mut Scratch,
        number: usize,
        t: f32,
        surface: &Surface,
        generation: u32,
        counters: &mut Counters,
        found: &mut Found,
    ) {
        let (ray, mut path) = (&scratch.rays[number], scratch.paths[number]);
        let place = Place::new(surface, ray);
        let material = self.material(surface, &path, generation);
        if place.inside && material.absorption != Vec3::ZERO && material.transparent != Vec3::ZERO {
            path.throughput *= (material.absorption * -t).exp();
        }
        found.radiance += self.emitted(&path, &scratch.began, material.emissive, (ray, t), surface);
        let bsdf = match (&material, &self.plain[surface.material as usize]) {
            (Cow::Borrowed(_), Some(bsdf)) => *bsdf,
            _ => Bsdf::new(&material),
        };
        if generation == 0 {
            (found.albedo, found.normal, found.depth) = (bsdf.albedo(), place.normal, t);
        }
        if bsdf.is_black() || !self.sends_on(generation) {
            return;
        }
        let direct = self.ask(scratch, &place, &path, &bsdf, generation, counters);
        self.ask_over_balls(scratch, &place, &path, &bsdf, generation, direct);
        self.go_on(scratch, &place, path, &bsdf, generation, counters);
    }

    /// What the surface is made of. Where several materials are blended, one of them by chance: as
    /// each lobe of a blend counts by the share of its material, so does each material.
    #[inline(always)]
    fn material(&self, surface: &Surface, path: &Path, generation: u32) -> Cow<'_, PhongMaterial> {
        if let Some(material) = self.world.plain(surface.material) {
            return Cow::Borrowed(material);
        }
        let mut parts = match self.world.at(surface) {
            Mixture::Plain(material) => return Cow::Borrowed(material),
            Mixture::Blend(parts) => parts,
        };
        let [mut u, _] = path.stream.beside(generation, Choice::Material);
        let last = parts.len() - 1;
        let chosen = parts.iter().position(|part| {
            u -= f64::from(part.weight);
            u < 0.0
        });
        parts.swap_remove(chosen.unwrap_or(last)).material
    }

    /// Asks one light. Returns about what it sends: the sum of the channels, were nothing in between.
    #[inline(always)]
    fn ask(
        &self,
        scratch: &mut Scratch,
        place: &Place,
        path: &Path,
        bsdf: &Bsdf,
        generation: u32,
        counters: &mut Counters,
    ) -> f32 {
        if self.rules.integrator == Integrator::Naive || self.lights.is_empty() {
            return 0.0;
        }
        if self.rules.skip_specular && bsdf.is_specular() {
            counters.skipped_light_specular += 1;
            return 0.0;
        }
        let uv = self.numbers.pair(&path.stream, &scratch.rows, Use::Light(generation));
        let offer = self.lights.offer(place.surface.point, place.geometric, uv);
        let Some(offer) = offer else {
            counters.skipped_shadow_dark += 1;
            return 0.0;
        };
        let into = offer.direction.as_vec3();
        if self.rules.skip_behind && place.geometric.dot(into) <= 0.0 {
            counters.skipped_shadow_behind += 1;
            return 0.0;
        }
        let value = bsdf.value(place.out, into, place.normal);
        let light = path.throughput * value.response * offer.light * self.asked_for(offer.pdf, value.pdf);
        if light == Vec3::ZERO || place.geometric.dot(into) <= 0.0 {
            counters.skipped_shadow_dark += 1;
            return 0.0;
        }
        let start = place.departure.towards(offer.direction);
        match offer.end {
            Some(end) => scratch.near.push(Ray::new(start, end - start), path.slot, light),
            None => scratch.far.push(Ray::new(start, into), path.slot, light),
        }
        light.element_sum()
    }

    /// Chooses the way on, unless roulette ends the path.
    #[inline(always)]
    fn go_on(
        &self,
        scratch: &mut Scratch,
        place: &Place,
        mut path: Path,
        bsdf: &Bsdf,
        generation: u32,
        counters: &mut Counters,
    ) {
        let uv = self.numbers.pair(&path.stream, &scratch.rows, Use::Way(generation));
        let Some(way) = bsdf.sample(place.out, place.normal, place.inside, uv.map(|x| x as f32)) else {
            return;
        };
        // Smooth normals may point the way through a surface that is not to be passed.
        let same_side = place.geometric.dot(way.direction) > 0.0;
        if !same_side && way.pdf < f32::INFINITY {
            return;
        }
        path.throughput *= way.weight;
        if path.throughput.max_element() <= 0.0 {
            return;
        }
        if !self.survives(scratch, &mut path, bsdf, generation) {
            counters.ended_by_roulette += 1;
            return;
        }
        path.chain = self.next_link(&path, place, bsdf, way.pdf == f32::INFINITY, same_side, generation);
        if path.chain == Chain::Begun {
            scratch.began[path.slot as usize] = (place.surface.point, way.direction, way.pdf);
        }
        path.normal = place.geometric;
        path.pdf = way.pdf;
        let start = place.departure.towards(way.direction.as_dvec3());
        scratch.next_rays.push(Ray::leaving(place.surface.primitive, start, way.direction));
        scratch.next_paths.push(path);
    }

    /// Roulette: paths on which little light is left go on more rarely, and count more if they do.
    /// What is left is judged by what surfaces send on in all, not in the direction that was
    /// chosen, else paths that were sent where light is rare would be ended for it. Mirrors and
    /// glass let all pass: what comes after them may be bright.
    fn survives(&self, scratch: &Scratch, path: &mut Path, bsdf: &Bsdf, generation: u32) -> bool {
        if bsdf.is_specular() {
            return true;
        }
        path.left *= bsdf.albedo().max_element();
        let chance = path.left / WORTH_GOING_ON;
        if generation + 1 < self.rules.roulette_depth || chance >= 1.0 {
            return true;
        }
        self.wins(&scratch.rows, path, chance, generation)
    }

    /// The game itself, with this chance to go on.
    #[inline(always)]
    pub(super) fn wins(&self, rows: &Rows, path: &mut Path, chance: f32, generation: u32) -> bool {
        let [u, _] = self.numbers.pair(&path.stream, rows, Use::Roulette(generation));
        if u >= f64::from(chance) {
            return false;
        }
        path.throughput /= chance;
        path.left = WORTH_GOING_ON;
        true
    }
}
