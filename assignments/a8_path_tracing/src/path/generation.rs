//! One step of all paths.

use super::caustic::Chain;
use super::places::Met;
use super::{Began, Expected, Found, Path, PathTracer, Scratch, Shadows};
use crate::Integrator;
use common::accel::Accel;
use common::counters::Counters;
use common::geometry::Surface;
use common::math::{DVec3, Interval, Vec3};
use common::ray::Ray;
use common::simd::{self, dispatch};

impl PathTracer<'_> {
    /// Sends the rays, looks at what they meet, sends the shadow rays; the next rays are then in
    /// the place of these.
    pub(super) fn advance(
        &self,
        scratch: &mut Scratch,
        generation: u32,
        counters: &mut Counters,
        found: &mut [Found],
    ) {
        let interval = if generation == 0 { self.studio.camera.interval } else { Interval::FORWARD };
        counters.rays += scratch.rays.len() as u64;
        scratch.hits.clear();
        scratch.hits.resize(scratch.rays.len(), None);
        self.accel.nearest_many(&scratch.rays, interval, &mut scratch.hits, counters);
        scratch.near.clear();
        scratch.far.clear();
        scratch.next_rays.clear();
        scratch.next_paths.clear();
        scratch.matts.clear();
        scratch.smooth.clear();
        scratch.rounds.clear();
        dispatch!(simd::level(), s => {
            self.look(scratch, generation, counters, found);
            self.look_at_rounds(s, scratch, generation, counters, found);
            self.leave_smooth(s, scratch, generation, counters);
            self.leave_matt(s, scratch, generation, counters);
        });
        scratch.near.arrive(self.accel, Interval::up_to(1.0), counters, found);
        scratch.far.arrive(self.accel, Interval::FORWARD, counters, found);
        std::mem::swap(&mut scratch.rays, &mut scratch.next_rays);
        std::mem::swap(&mut scratch.paths, &mut scratch.next_paths);
    }

    /// Looks at what rays met, with the instructions that are there. None of them fuses or reorders
    /// what is written here, so all give the same bits.
    #[inline(always)]
    fn look(&self, scratch: &mut Scratch, generation: u32, counters: &mut Counters, found: &mut [Found]) {
        let only_light = generation > 0 && !self.sends_on(generation) && self.rules.skip_surface;
        for i in 0..scratch.rays.len() {
            let (ray, path) = (&scratch.rays[i], &scratch.paths[i]);
            match scratch.hits[i] {
                None => self.escape(ray, path, generation, &mut found[path.slot as usize]),
                Some(hit)
                    if only_light && self.dark[self.studio.geometry.material(hit.primitive) as usize] =>
                {
                    counters.skipped_surface += 1;
                }
                Some(hit) => {
                    counters.surfaces += 1;
                    if self.is_abreast && self.put_aside(scratch, i, &hit) {
                        continue;
                    }
                    let ray = scratch.rays[i];
                    let surface = self.studio.geometry.surface(&ray, &hit);
                    if self.is_abreast {
                        let met = Met::new(i as u32, &ray, &surface);
                        if self.put_in_line(scratch, met, surface.material, hit.t, generation, found) {
                            continue;
                        }
                    }
                    let found = &mut found[scratch.paths[i].slot as usize];
                    self.meet(scratch, i, hit.t, &surface, generation, counters, found);
                }
            }
        }
    }

    /// A path that leaves the scene.
    #[inline(always)]
    fn escape(&self, ray: &Ray, path: &Path, generation: u32, found: &mut Found) {
        let (radiance, pdf) = self.lights.from_afar(ray.direction);
        found.radiance += path.throughput * radiance * self.met_by_chance(path.pdf, pdf);
        if generation == 0 {
            found.albedo = radiance;
        }
    }

    /// Light that the front of a surface gives off, weighed against having been asked for.
    #[inline(always)]
    pub(super) fn emitted(
        &self,
        path: &Path,
        began: &[Began],
        emissive: Vec3,
        (ray, t): (&Ray, f32),
        surface: &Surface,
    ) -> Vec3 {
        let direction = ray.direction.as_dvec3();
        if emissive == Vec3::ZERO || surface.geometric_normal.dot(direction) >= 0.0 {
            return Vec3::ZERO;
        }
        if let Chain::Over { ball, through } = path.chain {
            let began = began[path.slot as usize];
            let asked = self.density_over_ball(began, ball, through, direction, surface);
            return path.throughput * emissive * self.met_by_chance(began.2, asked);
        }
        // From the eye, or from a mirror, there was no other way to find it.
        if path.pdf == f32::INFINITY || self.rules.integrator == Integrator::Naive {
            return path.throughput * emissive;
        }
        let from: DVec3 = ray.origin.as_dvec3();
        let asked = self.lights.pdf(from, path.normal, direction, f64::from(t), surface);
        path.throughput * emissive * self.met_by_chance(path.pdf, asked)
    }

    /// The share of what a path met that is left to it when the surface before might have asked
    /// for the same, with densities `by_path` and `by_asking`.
    #[inline(always)]
    pub(super) fn met_by_chance(&self, by_path: f32, by_asking: f32) -> f32 {
        match self.rules.integrator {
            _ if by_asking == 0.0 || by_path == f32::INFINITY => 1.0,
            Integrator::Naive => 1.0,
            Integrator::Nee => 0.0,
            Integrator::Mis => power_heuristic(by_path, by_asking),
        }
    }

    /// The same for what was asked for.
    #[inline(always)]
    pub(super) fn asked_for(&self, by_asking: f32, by_path: f32) -> f32 {
        match self.rules.integrator {
            Integrator::Mis if by_asking < f32::INFINITY => power_heuristic(by_asking, by_path),
            _ => 1.0,
        }
    }
}

/// The weight of the first of two ways to find the same (Veach & Guibas, "Optimally combining
/// sampling techniques for Monte Carlo rendering", 1995).
#[inline]
fn power_heuristic(this: f32, other: f32) -> f32 {
    let ratio = other / this;
    1.0 / (1.0 + ratio * ratio)
}

impl Shadows {
    fn clear(&mut self) {
        self.rays.clear();
        self.expected.clear();
    }

    pub(super) fn push(&mut self, ray: Ray, slot: u32, light: Vec3) {
        self.push_way(&[ray], slot, light);
    }

    /// Light that arrives if none of the rays is blocked.
    pub(super) fn push_way(&mut self, rays: &[Ray], slot: u32, light: Vec3) {
        self.rays.extend_from_slice(rays);
        self.expected.push(Expected { slot, rays: rays.len() as u32, light });
    }

    /// Sends the rays; light with nothing in between arrives.
    fn arrive(
        &mut self,
        accel: &dyn Accel,
        interval: Interval,
        counters: &mut Counters,
        found: &mut [Found],
    ) {
        if self.rays.is_empty() {
            return;
        }
        counters.shadow_rays += self.rays.len() as u64;
        self.blocked.clear();
        self.blocked.resize(self.rays.len(), false);
        accel.any_many(&self.rays, interval, &mut self.blocked, counters);
        let mut blocked = self.blocked.as_slice();
        for expected in &self.expected {
            let (own, others) = blocked.split_at(expected.rays as usize);
            if !own.contains(&true) {
                found[expected.slot as usize].radiance += expected.light;
            }
            blocked = others;
        }
    }
}
