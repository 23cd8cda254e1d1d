//! A scene file as something that paths are traced in.

use a1_ray_casting::Studio;
use a6_kdtree::Tracer;
use a6_kdtree::texture::TexturedScene;
use a7_sampling::Pattern;
use a8_path_tracing::light::Lights;
use a8_path_tracing::numbers::Numbers;
use a8_path_tracing::{Found, PathTracer, Program, Rules, Scratch};
use clap::Parser;
use common::cli::AppError;
use common::counters::Counters;
use common::math::Vec3;
use common::picture::{Film, Size};
use std::path::Path;

/// Side of the squares of pixels that are traced together.
const TILE: u32 = 16;

/// Most samples of a pixel that are traced together.
const TOGETHER: u32 = 8;

/// A scene that is ready for paths.
pub struct Subject {
    /// Its file's name.
    pub name: String,
    studio: Studio,
    args: Program,
}

impl Subject {
    /// The scene of a file.
    ///
    /// # Errors
    /// If it is none.
    pub fn open(file: &Path, size: Size, accel: &str) -> Result<Self, AppError> {
        let (width, height) = (size.width().to_string(), size.height().to_string());
        let input = file.display().to_string();
        let words = ["path", "--input", &input, "--size", &width, &height, "--accel", accel];
        let args = Program::try_parse_from(words).map_err(|e| AppError::Usage(e.to_string()))?;
        let (studio, _) = Studio::open_textured(args.args.sampling.cast(), &[])?;
        let name = file.file_stem().map_or_else(String::new, |n| n.to_string_lossy().into_owned());
        Ok(Self { name, studio, args })
    }

    /// Calls `work` with the scene's textures and what finds its hits.
    pub fn with<T>(&self, work: impl FnOnce(&TexturedScene, &Tracer) -> T) -> Result<T, AppError> {
        let cast = self.args.args.sampling.cast();
        let world = TexturedScene::load(&self.studio.scene, &self.studio.geometry, &cast.input)?;
        let accel = self.args.args.sampling.accel.structure(&self.studio.geometry, None)?;
        Ok(work(&world, &accel))
    }

    /// The picture of so many paths per pixel, by this thread alone.
    pub fn picture(
        &self,
        world: &TexturedScene,
        accel: &Tracer,
        (pattern, seed): (Pattern, u64),
        rules: Rules,
        samples: u32,
    ) -> (Film, Counters) {
        let size = self.studio.size;
        let lights = Lights::new(&self.studio.geometry, world, None);
        let numbers = Numbers::new(pattern, samples, size.width().max(size.height()), seed);
        let tracer = PathTracer::new(&self.studio, world, accel.as_accel(), lights, numbers, rules);
        let (mut scratch, mut counters, mut film) =
            (Scratch::default(), Counters::default(), Film::new(size));
        let mut found = Vec::new();
        for y0 in (0..size.height()).step_by(TILE as usize) {
            for x0 in (0..size.width()).step_by(TILE as usize) {
                let rows = y0..(y0 + TILE).min(size.height());
                let columns = x0..(x0 + TILE).min(size.width());
                let pixels: Vec<_> = rows.flat_map(|y| columns.clone().map(move |x| (x, y))).collect();
                let mut sums = vec![[0f64; 3]; pixels.len()];
                for first in (0..samples).step_by(TOGETHER as usize) {
                    let range = first..(first + TOGETHER).min(samples);
                    found.resize(pixels.len() * range.len(), Found::default());
                    tracer.trace(&mut scratch, &pixels, range.clone(), &mut counters, &mut found);
                    for (sum, samples) in sums.iter_mut().zip(found.chunks(range.len())) {
                        for sample in samples {
                            for c in 0..3 {
                                sum[c] += f64::from(sample.radiance[c]);
                            }
                        }
                    }
                }
                for ((x, y), sum) in pixels.into_iter().zip(sums) {
                    let mean = sum.map(|s| (s / f64::from(samples)) as f32);
                    film.set(x, y, Vec3::from_array(mean));
                }
            }
        }
        (film, counters)
    }
}
