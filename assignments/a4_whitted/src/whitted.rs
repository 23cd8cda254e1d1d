//! A4T2, A4T3: the recursion of mirrored and refracted rays, without recursion.

use crate::interface::{crossing, mirrored_direction, opaque_mirror, panes};
use crate::shadow::ShadowRays;
use crate::{NoRecord, RayKind, Recorder};
use a1_ray_casting::{Layer, Mixture, Sight, World};
use a2_transforms::{Centres, Lamps, LocalLight};
use a3_phong::Phong;
use common::accel::Accel;
use common::counters::Counters;
use common::geometry::{Hit, Surface};
use common::math::{DVec3, Interval, Vec3};
use common::ray::Ray;
use common::scene::PhongMaterial;

/// What is traced, and what is left out.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rules {
    /// Cast shadow rays.
    pub shadows: bool,
    /// Let them pass transparent surfaces.
    pub transparent_shadows: bool,
    /// Greatest depth of mirrored and refracted rays; the camera ray has depth 0.
    pub bounces: u32,
    /// Rays of less weight are dropped.
    pub min_weight: f32,
    /// Share light by Fresnel's equations.
    pub fresnel: bool,
    /// No shadow ray to lights behind the surface.
    pub skip_behind: bool,
    /// No shadow ray to lights that give nothing.
    pub skip_dark: bool,
    /// No secondary ray of black weight.
    pub skip_black: bool,
}

/// The tracer: a scene, a structure that finds hits, and rules.
#[derive(Clone, Copy)]
pub struct Whitted<'a> {
    /// Materials, lights, background.
    pub scene: &'a dyn World,
    /// What finds hits.
    pub accel: &'a dyn Accel,
    /// Direct light.
    pub light: LocalLight<'a>,
    /// The reflection model.
    pub phong: Phong,
    /// What is traced.
    pub rules: Rules,
}

/// A ray still to be followed. Radiance is linear, so a branch needs only its own factor and
/// the tree can wait on a heap instead of the call stack.
struct Branch<I> {
    ray: Ray,
    kind: RayKind,
    depth: u32,
    weight: f32,
    throughput: Vec3,
    parent: I,
}

impl Whitted<'_> {
    /// Radiance that arrives along a camera ray whose nearest hit is known; all lights are points.
    pub fn radiance<R: Recorder>(&self, sight: &Sight, counters: &mut Counters, recorder: &mut R) -> Vec3 {
        self.radiance_of(sight, &mut Centres, counters, recorder)
    }

    /// The same with light from `lamps`, which are asked at every surface point on the way.
    pub fn radiance_of<R: Recorder>(
        &self,
        sight: &Sight,
        lamps: &mut impl Lamps,
        counters: &mut Counters,
        recorder: &mut R,
    ) -> Vec3 {
        let mut waiting = Vec::new();
        let camera = Branch {
            ray: sight.ray,
            kind: RayKind::Camera,
            depth: 0,
            weight: 1.0,
            throughput: Vec3::ONE,
            parent: R::Id::default(),
        };
        let surface = sight.surface().copied();
        let mut radiance = self.follow(&camera, sight.hit, surface, lamps, &mut waiting, counters, recorder);
        while let Some(branch) = waiting.pop() {
            counters.rays += 1;
            let hit = self.accel.nearest(&branch.ray, Interval::FORWARD, counters);
            let surface = hit.map(|h| self.accel.geometry().surface(&branch.ray, &h));
            radiance += self.follow(&branch, hit, surface, lamps, &mut waiting, counters, recorder);
        }
        radiance
    }

    /// One ray's own share of the radiance; its branches are put on the heap.
    #[expect(clippy::too_many_arguments, reason = "what a ray met, and who is asked and told")]
    fn follow<R: Recorder>(
        &self,
        branch: &Branch<R::Id>,
        hit: Option<Hit>,
        surface: Option<Surface>,
        lamps: &mut impl Lamps,
        waiting: &mut Vec<Branch<R::Id>>,
        counters: &mut Counters,
        recorder: &mut R,
    ) -> Vec3 {
        let id = recorder.ray(branch.parent, branch.kind, &branch.ray, hit, branch.weight);
        let (Some(hit), Some(surface)) = (hit, surface) else {
            return branch.throughput * self.scene.as_scene().background.color;
        };
        let mixture = self.scene.at(&surface);
        let incoming = branch.ray.direction.as_dvec3();
        let throughput = branch.throughput * inside(&mixture, &surface, incoming, hit.t);
        if branch.depth < self.rules.bounces {
            let at = Branch { throughput, parent: id, ..*branch };
            self.branch(&at, &surface, &mixture, waiting, counters);
        }
        let reflect = |m: &PhongMaterial, n, l, v| self.phong.reflect(m, n, l, v);
        let mut shadows = ShadowRays { whitted: self, counters, recorder, lamps, parent: id };
        throughput * self.light.radiance(&surface, &mixture, branch.ray.direction, reflect, &mut shadows)
    }

    /// Puts the mirrored ray and the refracted ones on the heap, the mirrored one on top. What is
    /// mixed of several materials has one mirror, and a refracted ray for each index of
    /// refraction that light can bend by.
    fn branch<I: Copy>(
        &self,
        at: &Branch<I>,
        surface: &Surface,
        mixture: &Mixture,
        waiting: &mut Vec<Branch<I>>,
        counters: &mut Counters,
    ) {
        let (incoming, fresnel) = (at.ray.direction.as_dvec3(), self.rules.fresnel);
        let mut mirrored = if fresnel { opaque_mirror(mixture) } else { mixture.blend(|m| m.reflective) };
        let mut opaque = true;
        for pane in panes(mixture, !self.rules.skip_black) {
            opaque = false;
            let crossing = crossing(incoming, surface, pane.index_of_refraction);
            let mut refracted = pane.color;
            if fresnel {
                let reflectance = crossing.reflectance as f32;
                mirrored += Vec3::splat(pane.share * reflectance);
                refracted *= 1.0 - reflectance;
            }
            if let Some(direction) = crossing.refracted {
                self.push(at, RayKind::Refracted, refracted, surface, direction, waiting, counters);
            }
        }
        counters.skipped_black_secondary += u64::from(opaque);
        if mirrored != Vec3::ZERO || !self.rules.skip_black {
            let direction = mirrored_direction(incoming, surface);
            self.push(at, RayKind::Mirrored, mirrored, surface, direction, waiting, counters);
        } else {
            counters.skipped_black_secondary += 1;
        }
    }

    #[expect(clippy::too_many_arguments, reason = "one call site per kind of branch")]
    fn push<I: Copy>(
        &self,
        at: &Branch<I>,
        kind: RayKind,
        color: Vec3,
        surface: &Surface,
        direction: DVec3,
        waiting: &mut Vec<Branch<I>>,
        counters: &mut Counters,
    ) {
        let weight = at.weight * color.length();
        if weight < self.rules.min_weight {
            counters.skipped_below_weight += 1;
            return;
        }
        // The side is chosen for the direction that the ray really has, after rounding.
        let direction = direction.as_vec3();
        waiting.push(Branch {
            ray: Ray::new(surface.leave(direction.as_dvec3()), direction),
            kind,
            depth: at.depth + 1,
            weight,
            throughput: at.throughput * color,
            parent: at.parent,
        });
    }
}

/// What Beer–Lambert absorption leaves of light that came through the body to this surface: a
/// ray that meets a transparent surface from behind has travelled inside. Of a mixture each part
/// leaves its own share.
fn inside(mixture: &Mixture, surface: &Surface, incoming: DVec3, t: f32) -> Vec3 {
    let leaves = incoming.dot(surface.geometric_normal) > 0.0;
    if !leaves {
        return Vec3::ONE;
    }
    mixture.blend(|m| match m.absorption == Vec3::ZERO {
        true => Vec3::ONE,
        false => (-m.absorption * t).exp(),
    })
}

/// The colour picture of assignment 4.
pub struct WhittedColor<'a> {
    /// The tracer.
    pub whitted: Whitted<'a>,
}

impl Layer for WhittedColor<'_> {
    fn value(&self, sight: &Sight, counters: &mut Counters) -> Vec3 {
        self.whitted.radiance(sight, counters, &mut NoRecord)
    }
}
