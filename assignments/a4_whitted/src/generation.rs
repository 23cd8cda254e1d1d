//! A4T2, A4T3: the rays that come of surface points.

use crate::interface::{crossing, mirrored_direction, opaque_mirror, panes};
use crate::{RayKind, Whitted};
use a1_ray_casting::Mixture;
use common::counters::Counters;
use common::geometry::{Departure, Surface};
use common::math::{DVec3, Vec3};
use common::ray::Ray;

/// A ray still to be followed.
#[derive(Clone, Copy)]
pub struct Branch<I> {
    /// The ray, of unit direction.
    pub ray: Ray,
    /// What it is for.
    pub kind: RayKind,
    /// Whether it need not be traced: then `throughput` is what it brings.
    pub settled: bool,
    /// Surfaces between it and the eye.
    pub depth: u32,
    /// What the course's cut-off is held against: the product of the lengths of the colours so far.
    pub weight: f32,
    /// Share of the light it finds that arrives at the eye.
    pub throughput: Vec3,
    /// Which camera ray it comes of.
    pub owner: u32,
    /// The ray before, as who watches calls it.
    pub parent: I,
}

/// The rays of one generation, mirrored ones first.
pub struct Generation<I> {
    /// Off mirrors.
    pub mirrored: Vec<Branch<I>>,
    /// Into and out of glass.
    pub refracted: Vec<Branch<I>>,
}

impl<I: Copy> Generation<I> {
    /// The mirrored ray of a surface point and the refracted ones. What is mixed of several
    /// materials has one mirror, and a refracted ray for each index of refraction that light can
    /// bend by. `known` is what the last rays bring that go into the body behind the surface, if that
    /// can be told.
    #[expect(clippy::too_many_arguments, reason = "a point, and what rays from it depend on")]
    #[inline(always)]
    pub fn add(
        &mut self,
        whitted: &Whitted,
        at: &Branch<I>,
        surface: &Surface,
        departure: &Departure,
        mixture: &Mixture,
        known: &mut impl FnMut() -> Option<Vec3>,
        counters: &mut Counters,
    ) {
        let (incoming, rules) = (at.ray.direction.as_dvec3(), &whitted.rules);
        let fresnel = rules.fresnel;
        let last = at.depth + 1 == rules.bounces;
        let mut make = |kind, color: Vec3, direction: DVec3| {
            let weight = at.weight * color.length();
            if weight < rules.min_weight {
                counters.skipped_below_weight += 1;
                return None;
            }
            // The side is chosen for the direction that the ray really has, after rounding.
            let direction = direction.as_vec3();
            let goes_in = surface.geometric_normal.dot(direction.as_dvec3()) < 0.0;
            let known = if last && goes_in { known() } else { None };
            counters.skipped_known_secondary += u64::from(known.is_some());
            if known == Some(Vec3::ZERO) {
                return None;
            }
            let start = departure.towards(direction.as_dvec3());
            let ray = Ray::leaving(surface.primitive, start, direction);
            let (throughput, settled) = (at.throughput * color * known.unwrap_or(Vec3::ONE), known.is_some());
            Some(Branch { ray, kind, settled, depth: at.depth + 1, weight, throughput, ..*at })
        };
        let mut mirrored = if fresnel { opaque_mirror(mixture) } else { mixture.blend(|m| m.reflective) };
        let mut opaque = true;
        for pane in panes(mixture, !rules.skip_black) {
            opaque = false;
            let crossing = crossing(incoming, surface, pane.index_of_refraction);
            let mut color = pane.color;
            if fresnel {
                let reflectance = crossing.reflectance as f32;
                mirrored += Vec3::splat(pane.share * reflectance);
                color *= 1.0 - reflectance;
            }
            let refracted = crossing.refracted;
            let ray = refracted.and_then(
                #[inline(always)]
                |direction| make(RayKind::Refracted, color, direction),
            );
            // An iterator of one would take longer.
            if let Some(ray) = ray {
                self.refracted.push(ray);
            }
        }
        let skip_mirror = mirrored == Vec3::ZERO && rules.skip_black;
        if !skip_mirror {
            let direction = mirrored_direction(incoming, surface);
            if let Some(ray) = make(RayKind::Mirrored, mirrored, direction) {
                self.mirrored.push(ray);
            }
        }
        counters.skipped_black_secondary += u64::from(opaque) + u64::from(skip_mirror);
    }
}
