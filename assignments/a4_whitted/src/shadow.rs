//! A4T1: shadow rays.

use crate::{Recorder, Whitted};
use a2_transforms::{Incident, Lamps, Source, Visibility};
use common::cli::Skip;
use common::counters::Counters;
use common::geometry::{Hit, Surface};
use common::math::{Interval, Vec3};
use common::ray::Ray;
use common::scene::Scene;

/// Asks the structure what stands between a surface and a light.
pub struct ShadowRays<'a, 'b, R: Recorder, L: Lamps> {
    /// Scene, structure and rules.
    pub whitted: &'a Whitted<'b>,
    /// Where rays and skips are counted.
    pub counters: &'a mut Counters,
    /// Who watches.
    pub recorder: &'a mut R,
    /// Where light comes from.
    pub lamps: &'a mut L,
    /// The ray that found the surface.
    pub parent: R::Id,
}

/// From beside the surface to the light; a light at a point is at t = 1, so that what stands
/// behind it casts no shadow.
fn shadow_ray(surface: &Surface, light: &Incident) -> (Ray, Interval) {
    match light.source {
        Source::Direction(towards) => {
            let direction = towards.as_vec3();
            (Ray::new(surface.leave(direction.as_dvec3()), direction), Interval::FORWARD)
        }
        Source::Point(position) => {
            let origin = surface.leave(position - surface.point);
            (Ray::new(origin, (position - origin.as_dvec3()).as_vec3()), Interval::up_to(1.0))
        }
    }
}

impl<R: Recorder, L: Lamps> ShadowRays<'_, '_, R, L> {
    /// The transparent colour of what was hit. Only a texture needs the point.
    fn transparency(&self, ray: &Ray, hit: &Hit) -> Vec3 {
        let (scene, geometry) = (self.whitted.scene, self.whitted.accel.geometry());
        match scene.plain(geometry.material(hit.primitive)) {
            Some(material) => material.transparent,
            None => scene.at(&geometry.surface(ray, hit)).blend(|m| m.transparent),
        }
    }

    /// The product of the transparent colours on the way; black at the first opaque surface.
    fn filtered(&mut self, ray: &Ray, mut interval: Interval) -> Vec3 {
        let mut share = Vec3::ONE;
        while let Some(hit) = self.whitted.accel.nearest(ray, interval, self.counters) {
            share *= self.transparency(ray, &hit);
            if share == Vec3::ZERO {
                break;
            }
            interval.min = hit.t;
        }
        share
    }
}

impl<R: Recorder, L: Lamps> Lamps for ShadowRays<'_, '_, R, L> {
    fn looks(&self, scene: &Scene) -> usize {
        self.lamps.looks(scene)
    }

    fn look(&mut self, scene: &Scene, index: usize, surface: &Surface) -> Incident {
        self.lamps.look(scene, index, surface)
    }
}

impl<R: Recorder, L: Lamps> Visibility for ShadowRays<'_, '_, R, L> {
    fn transmitted(&mut self, surface: &Surface, light: &Incident) -> Vec3 {
        let rules = &self.whitted.rules;
        if !rules.shadows {
            return Vec3::ONE;
        }
        self.counters.shadow_rays += 1;
        let (ray, interval) = shadow_ray(surface, light);
        let share = if rules.transparent_shadows {
            self.filtered(&ray, interval)
        } else if self.whitted.accel.any(&ray, interval, self.counters) {
            Vec3::ZERO
        } else {
            Vec3::ONE
        };
        self.recorder.shadow(self.parent, &ray, share);
        share
    }

    fn skip(&mut self, why: Skip) -> bool {
        let rules = &self.whitted.rules;
        let (skips, counter) = match why {
            Skip::Dark => (rules.skip_dark, &mut self.counters.skipped_shadow_dark),
            _ => (rules.skip_behind, &mut self.counters.skipped_shadow_behind),
        };
        *counter += u64::from(skips && rules.shadows);
        skips || !rules.shadows
    }
}
