//! The tracer and its rules.

use crate::wave::Wave;
use crate::{NoRecord, Recorder};
use a1_ray_casting::{Layer, Sight, World};
use a2_transforms::{Centres, Lamps, LocalLight};
use a3_phong::Phong;
use common::accel::Accel;
use common::counters::Counters;
use common::math::Vec3;

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
    /// No shadow ray from inside a closed body to lights outside: opaque as all surfaces are to
    /// shadow rays, it would be blocked by the body itself.
    pub skip_inside: bool,
    /// No secondary ray of black weight.
    pub skip_black: bool,
    /// No ray at the last depth inside a closed body that is empty and dark: wherever it goes, it
    /// brings what the body's inner side sends on of ambient light.
    pub skip_known: bool,
    /// No surface point where a shadow ray passes something transparent, unless it has a texture.
    pub skip_surface: bool,
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

impl Whitted<'_> {
    /// Radiance that arrives along a camera ray whose nearest hit is known; all lights are points.
    pub fn radiance<R: Recorder>(&self, sight: &Sight, counters: &mut Counters, recorder: &mut R) -> Vec3 {
        let mut radiance = [Vec3::ZERO];
        let (sights, lamps) = (std::slice::from_ref(sight), &mut [Centres]);
        self.radiances(sights, lamps, counters, recorder, &mut radiance);
        radiance[0]
    }

    /// The same of many camera rays, unwatched.
    ///
    /// # Panics
    /// If the slices differ in length.
    pub fn radiances_of_points(&self, sights: &[Sight], counters: &mut Counters, radiances: &mut [Vec3]) {
        let mut lamps: Vec<Centres> = sights.iter().map(|_| Centres).collect();
        self.radiances(sights, &mut lamps, counters, &mut NoRecord, radiances);
    }

    /// The same of many camera rays, each with its own way to look at lights. What one of them
    /// brings does not depend on the others, to the last bit; together they are faster.
    ///
    /// # Panics
    /// If the slices differ in length.
    pub fn radiances<R: Recorder, L: Lamps>(
        &self,
        sights: &[Sight],
        lamps: &mut [L],
        counters: &mut Counters,
        recorder: &mut R,
        radiances: &mut [Vec3],
    ) {
        assert!(sights.len() == lamps.len() && sights.len() == radiances.len());
        radiances.fill(Vec3::ZERO);
        Wave { whitted: self, lamps, counters, recorder, radiances }.run(sights);
    }
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

    fn values(&self, sights: &[Sight], counters: &mut Counters, out: &mut [Vec3]) {
        self.whitted.radiances_of_points(sights, counters, out);
    }

    fn works_out_surfaces(&self) -> bool {
        true
    }
}
