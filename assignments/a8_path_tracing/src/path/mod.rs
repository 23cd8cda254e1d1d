//! Paths from the eye to the lights.

use a1_ray_casting::World;
use a7_sampling::sampler::Pixel;
use common::accel::Accel;
use common::camera::Camera;
use common::counters::Counters;
use common::math::Vec3;
use common::picture::Size;
use std::ops::Range;

/// How light is looked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
#[value(rename_all = "snake_case")]
pub enum Integrator {
    /// Paths end when they happen to meet a light
    Naive,
    /// Every surface asks one light directly; what paths happen to meet counts for mirrors only
    Nee,
    /// Both, each weighed by how well it finds what it found
    #[default]
    Mis,
}

/// What a path may do.
#[derive(Clone, Copy, Debug)]
pub struct Rules {
    /// How light is looked for.
    pub integrator: Integrator,
    /// Most times that a path is scattered before the surface that a light shines on; no limit if
    /// `None`. With 0 there is direct light only.
    pub bounces: Option<u32>,
    /// Surfaces that a path meets before roulette may end it.
    pub roulette_depth: u32,
    /// Skips.
    pub skip_behind: bool,
    /// Skips.
    pub skip_black: bool,
}

/// What one sample of a pixel found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Found {
    /// Light that arrives, linear RGB.
    pub radiance: Vec3,
    /// Share of light that the first surface sends on; the background's colour on a miss.
    pub albedo: Vec3,
    /// Unit normal of the first surface, facing the eye; zero on a miss.
    pub normal: Vec3,
    /// Distance of the first surface along the ray; 0 on a miss.
    pub depth: f32,
}

/// Memory that a thread works in.
#[derive(Default)]
pub struct Scratch {}

/// Follows paths through a scene.
pub struct PathTracer<'a> {
    /// What surfaces are made of.
    pub world: &'a dyn World,
    /// What finds hits.
    pub accel: &'a dyn Accel,
    /// Where paths begin.
    pub camera: &'a Camera,
    /// Size of the whole picture.
    pub size: Size,
    /// What paths may do.
    pub rules: Rules,
}

impl PathTracer<'_> {
    /// Traces some samples of some pixels. What is found for a sample depends on pixel, sample and
    /// seed only. `found` holds the samples of the first pixel, then those of the second, ….
    ///
    /// # Panics
    /// If `found` is not as long as there are samples.
    pub fn trace(
        &self,
        _scratch: &mut Scratch,
        pixels: &[Pixel],
        samples: Range<u32>,
        _counters: &mut Counters,
        found: &mut [Found],
    ) {
        assert_eq!(found.len(), pixels.len() * samples.len());
        found.fill(Found::default());
    }
}
