//! A8T4, A8T5: paths from the eye to the lights.
//!
//! Paths grow generation by generation, those of many samples together: all their rays are sent
//! at once, every surface that is met asks a light and chooses a way on, and all
//! shadow rays are sent at once. What a path finds does not depend on who is traced beside it.

mod caustic;
mod generation;
mod surface;

use crate::bsdf::Bsdf;
use crate::light::{Ball, Lights};
use crate::numbers::{Numbers, Rows, Stream, Use};
use a1_ray_casting::{Studio, World};
use a7_sampling::aperture::Aperture;
use a7_sampling::sampler::Pixel;
use caustic::Chain;
use common::accel::Accel;
use common::camera::screen_position;
use common::counters::Counters;
use common::geometry::Hit;
use common::math::{DVec3, Vec3};
use common::ray::Ray;
use std::ops::Range;

/// How light is looked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
#[value(rename_all = "snake_case")]
pub enum Integrator {
    /// Paths go on until they happen to meet a light
    Naive,
    /// Every surface asks one light; what paths happen to meet counts after mirrors and glass only
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
    /// Most surfaces that send a path on before the one that a light shines on; no limit if
    /// `None`. With 0 there is direct light only.
    pub bounces: Option<u32>,
    /// Surfaces that a path meets before roulette may end it.
    pub roulette_depth: u32,
    /// No shadow ray to lights behind the surface.
    pub skip_behind: bool,
    /// No light is asked for surfaces that send no light between two given directions.
    pub skip_specular: bool,
}

impl Default for Rules {
    fn default() -> Self {
        Self {
            integrator: Integrator::Mis,
            bounces: None,
            roulette_depth: 1,
            skip_behind: true,
            skip_specular: true,
        }
    }
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

/// A path on its way.
#[derive(Clone, Copy, Debug)]
struct Path {
    /// What is left of light that it finds.
    throughput: Vec3,
    /// Which of the samples it is.
    slot: u32,
    /// Its numbers.
    stream: Stream,
    /// Normal of the surface that it left, on the side that it left to.
    normal: Vec3,
    /// Density of its direction per steradian; infinite if no light could have been asked instead.
    pdf: f32,
    /// Share of light that the surfaces so far have sent on, since roulette was played.
    left: f32,
    /// Whether it is on a way that was asked for.
    chain: Chain,
    /// Where that began: the point, the direction, and its density.
    began: (DVec3, Vec3, f32),
}

/// Light on its way to a surface, if nothing is in between.
#[derive(Clone, Copy, Debug)]
struct Expected {
    slot: u32,
    /// How many of the rays, one after the other, must arrive.
    rays: u32,
    light: Vec3,
}

/// Shadow rays of a generation.
#[derive(Default)]
struct Shadows {
    rays: Vec<Ray>,
    expected: Vec<Expected>,
    blocked: Vec<bool>,
}

/// Memory that a thread works in.
#[derive(Default)]
pub struct Scratch {
    rows: Rows,
    rays: Vec<Ray>,
    paths: Vec<Path>,
    hits: Vec<Option<Hit>>,
    next_rays: Vec<Ray>,
    next_paths: Vec<Path>,
    /// To lights at places: in units of their length.
    near: Shadows,
    /// To lights infinitely far away.
    far: Shadows,
}

/// With more balls lights are not asked over them.
const MOST_BALLS: usize = 64;

/// Follows paths through a scene.
pub struct PathTracer<'a> {
    studio: &'a Studio,
    world: &'a dyn World,
    accel: &'a dyn Accel,
    lights: Lights<'a>,
    numbers: Numbers,
    aperture: Option<Aperture>,
    rules: Rules,
    /// What is the same all over a material.
    plain: Vec<Option<Bsdf>>,
    /// What lights are asked over.
    balls: Vec<Ball>,
}

impl<'a> PathTracer<'a> {
    /// For the pictures of a studio through any structure; `world` tells what surfaces are made of.
    pub fn new(
        studio: &'a Studio,
        world: &'a dyn World,
        accel: &'a dyn Accel,
        lights: Lights<'a>,
        numbers: Numbers,
        rules: Rules,
    ) -> Self {
        let materials = 0..world.as_scene().materials.len() as u32;
        let plain: Vec<Option<Bsdf>> = materials.map(|index| world.plain(index).map(Bsdf::new)).collect();
        let lobes = |index: u32| Some((plain[index as usize]?, world.plain(index)?.absorption));
        let mut balls = if lights.any_flat() { Ball::all(&studio.geometry, lobes) } else { Vec::new() };
        // A look at each would cost too much.
        balls.truncate(if balls.len() > MOST_BALLS { 0 } else { MOST_BALLS });
        let aperture = studio.camera.lens.map(|lens| Aperture::new(lens.blades));
        Self { studio, world, accel, lights, numbers, aperture, rules, plain, balls }
    }

    /// Traces some samples of some pixels. What is found for a sample depends on pixel, sample and
    /// seed only. `found` holds the samples of the first pixel, then those of the second, ….
    ///
    /// # Panics
    /// If `found` is not as long as there are samples.
    pub fn trace(
        &self,
        scratch: &mut Scratch,
        pixels: &[Pixel],
        samples: Range<u32>,
        counters: &mut Counters,
        found: &mut [Found],
    ) {
        assert_eq!(found.len(), pixels.len() * samples.len());
        found.fill(Found::default());
        self.begin(scratch, pixels, samples);
        let mut generation = 0;
        while !scratch.rays.is_empty() {
            self.advance(scratch, generation, counters, found);
            generation += 1;
        }
    }

    /// The rays from the eye.
    fn begin(&self, scratch: &mut Scratch, pixels: &[Pixel], samples: Range<u32>) {
        self.numbers.prepare(samples.clone(), &mut scratch.rows);
        scratch.rays.clear();
        scratch.paths.clear();
        let mut slot = 0;
        for &pixel in pixels {
            for row in 0..samples.len() as u32 {
                let stream = self.numbers.stream(pixel, samples.start, row);
                scratch.rays.push(self.camera_ray(&stream, &scratch.rows, pixel));
                scratch.paths.push(Path {
                    throughput: Vec3::ONE,
                    slot,
                    stream,
                    normal: Vec3::ZERO,
                    pdf: f32::INFINITY,
                    left: 1.0,
                    chain: Chain::None,
                    began: (DVec3::ZERO, Vec3::ZERO, 0.0),
                });
                slot += 1;
            }
        }
    }

    fn camera_ray(&self, stream: &Stream, rows: &Rows, (x, y): Pixel) -> Ray {
        let [u, v] = self.numbers.pair(stream, rows, Use::Pixel);
        let on_screen = screen_position(self.studio.size, f64::from(x) + u, f64::from(y) + v);
        match self.aperture {
            None => self.studio.camera.ray(on_screen),
            Some(aperture) => {
                let on_lens = aperture.point(self.numbers.pair(stream, rows, Use::Lens));
                self.studio.camera.ray_through_lens(on_screen, on_lens)
            }
        }
    }
}
