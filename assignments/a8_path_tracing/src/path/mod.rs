//! A8T4, A8T5: paths from the eye to the lights.
//!
//! Paths grow generation by generation, those of many samples together: all their rays are sent
//! at once, every surface that is met asks a light and chooses a way on, and all
//! shadow rays are sent at once. What a path finds does not depend on who is traced beside it.

mod caustic;
mod eye;
mod generation;
mod leaving;
mod matt;
mod places;
mod points;
mod round;
mod smooth;
mod surface;

use crate::bsdf::Bsdf;
use crate::light::{Ball, Lights};
use crate::numbers::{Numbers, Rows, Stream};
use a1_ray_casting::{Studio, World};
use a7_sampling::aperture::Aperture;
use a7_sampling::sampler::Pixel;
use caustic::Chain;
use common::accel::Accel;
use common::counters::Counters;
use common::geometry::Hit;
use common::math::lanes::LANES;
use common::math::{DVec3, Vec3};
use common::ray::Ray;
use leaving::Leaving;
use places::Queue;
use round::Rounds;
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
    /// What the last ray of a path meets is not looked at, unless it may shine.
    pub skip_surface: bool,
}

impl Default for Rules {
    fn default() -> Self {
        Self {
            integrator: Integrator::Mis,
            bounces: None,
            roulette_depth: 1,
            skip_behind: true,
            skip_specular: true,
            skip_surface: true,
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
}

/// Where a path began a way that was asked for: the point, the direction, and its density.
type Began = (DVec3, Vec3, f32);

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
    on_screen: Vec<(f64, f64)>,
    next_rays: Vec<Ray>,
    next_paths: Vec<Path>,
    /// By slot; empty if nothing is asked over balls.
    began: Vec<Began>,
    /// Matt surfaces that were met.
    matts: Queue,
    /// Mirrors and glass that were met.
    smooth: Queue,
    /// Balls and planes that were met.
    rounds: Rounds,
    /// To lights at places: in units of their length.
    near: Shadows,
    /// To lights infinitely far away.
    far: Shadows,
}

impl Scratch {
    /// The rays of these numbers.
    #[inline(always)]
    fn rays_of(&self, [a, b, c, d, e, f, g, h]: &[u32; LANES]) -> [&Ray; LANES] {
        let ray = |number: u32| &self.rays[number as usize];
        [ray(*a), ray(*b), ray(*c), ray(*d), ray(*e), ray(*f), ray(*g), ray(*h)]
    }
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
    /// How paths leave surfaces of each material.
    leaving: Vec<Leaving>,
    /// Whether a material gives off no light, wherever it is.
    dark: Vec<bool>,
    /// What lights are asked over.
    balls: Vec<Ball>,
    /// Whether surfaces are left eight at a time: where nothing is asked that only a surface by
    /// itself asks.
    is_abreast: bool,
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
        let leaving = (0..plain.len() as u32).map(|index| Leaving::of(world.plain(index))).collect();
        let is_dark = |index: u32| world.plain(index).is_some_and(|m| m.emissive == Vec3::ZERO);
        let dark = (0..plain.len() as u32).map(is_dark).collect();
        let lobes = |index: u32| Some((plain[index as usize]?, world.plain(index)?.absorption));
        let mut balls = if lights.any_flat() { Ball::all(&studio.geometry, lobes) } else { Vec::new() };
        // A look at each would cost too much.
        balls.truncate(if balls.len() > MOST_BALLS { 0 } else { MOST_BALLS });
        let aperture = studio.camera.lens.map(|lens| Aperture::new(lens.blades));
        let is_abreast = balls.is_empty() && rules.skip_behind && rules.skip_specular;
        Self {
            studio,
            world,
            accel,
            lights,
            numbers,
            aperture,
            rules,
            plain,
            leaving,
            dark,
            balls,
            is_abreast,
        }
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
        scratch.began.clear();
        scratch.began.resize(if self.balls.is_empty() { 0 } else { found.len() }, Began::default());
        self.begin(scratch, pixels, samples);
        let mut generation = 0;
        while !scratch.rays.is_empty() {
            self.advance(scratch, generation, counters, found);
            generation += 1;
        }
    }

    /// Whether surfaces of this generation send light on. The ray after the last that do only looks
    /// at what shines.
    fn sends_on(&self, generation: u32) -> bool {
        self.rules.bounces.is_none_or(|most| generation <= most)
    }
}
