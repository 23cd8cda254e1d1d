//! The lights of a scene, each by as many points as it needs.

use super::{Cone, Emitters};
use crate::sampler::{Pixel, Sampler, pair};
use a1_ray_casting::World;
use a2_transforms::{Incident, Lamps, Source, falloff, incident};
use common::geometry::{Geometry, Surface};
use common::math::{DVec3, Vec3};
use common::scene::{LightKind, Scene};
use common::shape::sphere::Sphere;
use std::f64::consts::PI;

/// One look at a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Look {
    /// At a light of one point or direction.
    Hard(usize),
    /// At a light sphere: which light, which extended light, which of its looks.
    Sphere(usize, u32, u32),
    /// At the things that shine: which extended light, which look.
    Emitters(u32, u32),
}

/// How the lights of a scene are looked at.
///
/// A light sphere gives its colour, less the falloff at the distance of its centre, as if it came
/// from everywhere in the cone that it fills: far away it is the point light of the same colour.
/// Things that shine send their radiance: a matt surface returns kd/π of what arrives.
pub struct SoftLights<'a> {
    looks: Vec<Look>,
    /// Looks at each extended light from one surface point.
    each: u32,
    /// Lights with an extent, the things that shine being one.
    extended: u32,
    emitters: Emitters<'a>,
    sampler: Box<dyn Sampler>,
}

impl<'a> SoftLights<'a> {
    /// The lights of a scene, with `each` looks at extended ones from every surface point.
    /// `sampler` chooses their places, for `each` times the samples of a pixel.
    pub fn new(geometry: &'a Geometry, world: &'a dyn World, each: u32, sampler: Box<dyn Sampler>) -> Self {
        let emitters = Emitters::new(geometry, world);
        let (mut looks, mut extended) = (Vec::new(), 0);
        for (index, light) in world.as_scene().lights.iter().enumerate() {
            match light.kind {
                LightKind::Sphere { .. } => {
                    looks.extend((0..each).map(|look| Look::Sphere(index, extended, look)));
                    extended += 1;
                }
                _ => looks.push(Look::Hard(index)),
            }
        }
        if !emitters.is_empty() {
            looks.extend((0..each).map(|look| Look::Emitters(extended, look)));
            extended += 1;
        }
        Self { looks, each, extended, emitters, sampler }
    }

    /// How many lights have an extent.
    pub fn extended(&self) -> u32 {
        self.extended
    }

    /// Shining planes without a rim, which light nothing.
    pub fn endless(&self) -> usize {
        self.emitters.endless
    }

    /// The lights as one sample of a pixel looks at them.
    pub fn of_sample(&self, pixel: Pixel, sample: u32) -> LampsOfSample<'_> {
        LampsOfSample { lights: self, pixel, sample, surfaces: 0 }
    }
}

/// The lights as one sample of a pixel looks at them: at every surface on the way it takes pairs
/// of coordinates of its own.
pub struct LampsOfSample<'a> {
    lights: &'a SoftLights<'a>,
    pixel: Pixel,
    sample: u32,
    surfaces: u32,
}

impl LampsOfSample<'_> {
    /// Where a look falls on an extended light.
    fn place(&self, light: u32, look: u32) -> [f64; 2] {
        let pair = pair::LIGHT + (self.surfaces - 1) * self.lights.extended + light;
        self.lights.sampler.pair(self.pixel, self.sample * self.lights.each + look, pair)
    }
}

impl Lamps for LampsOfSample<'_> {
    fn looks(&self, _: &Scene) -> usize {
        self.lights.looks.len()
    }

    fn look(&mut self, scene: &Scene, index: usize, surface: &Surface) -> Incident {
        self.surfaces += u32::from(index == 0);
        let share = 1.0 / self.lights.each as f32;
        match self.lights.looks[index] {
            Look::Hard(light) => incident(&scene.lights[light], surface.point),
            Look::Sphere(light, extended, look) => {
                let light = &scene.lights[light];
                let LightKind::Sphere { center, radius, attenuation } = light.kind else {
                    return incident(light, surface.point);
                };
                let left = falloff(attenuation, (center - surface.point).length());
                let cone = Cone::new(&Sphere { center, radius }, surface.point);
                let (direction, distance) = cone.direction(self.place(extended, look));
                let position = surface.point + direction * distance;
                arriving(direction, light.color * (left * share), position)
            }
            Look::Emitters(extended, look) => {
                let place = self.place(extended, look);
                let Some(point) = self.lights.emitters.point(surface.point, place) else {
                    return arriving(DVec3::Z, Vec3::ZERO, surface.point);
                };
                let weight = if point.pdf > 0.0 { (1.0 / (PI * point.pdf)) as f32 * share } else { 0.0 };
                // The shadow ray ends beside what shines, on the side it is seen from.
                let position = point.surface.leave(-point.direction).as_dvec3();
                arriving(point.direction, point.radiance * weight, position)
            }
        }
    }
}

fn arriving(direction: DVec3, color: Vec3, position: DVec3) -> Incident {
    Incident { direction: direction.as_vec3(), color, source: Source::Point(position) }
}
