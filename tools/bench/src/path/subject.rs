//! A scene file as something that paths are traced in.

use super::measure::Recipe;
use a1_ray_casting::Studio;
use a6_kdtree::Tracer;
use a6_kdtree::texture::TexturedScene;
use a8_path_tracing::film::{Frame, develop};
use a8_path_tracing::light::Lights;
use a8_path_tracing::numbers::Numbers;
use a8_path_tracing::render::Rendering;
use a8_path_tracing::{Goal, Layout, PathTracer, Program, Sums};
use clap::Parser;
use common::cli::AppError;
use common::counters::Counters;
use common::picture::{Film, Size};
use common::tiles::TileOptions;
use std::path::Path;

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
    ///
    /// # Errors
    /// If a texture cannot be read.
    pub fn with<T>(&self, work: impl FnOnce(&TexturedScene, &Tracer) -> T) -> Result<T, AppError> {
        let cast = self.args.args.sampling.cast();
        let world = TexturedScene::load(&self.studio.scene, &self.studio.geometry, &cast.input)?;
        let accel = self.args.args.sampling.accel.structure(&self.studio.geometry, None)?;
        Ok(work(&world, &accel))
    }

    /// The picture of a recipe and a seed, by this thread alone.
    ///
    /// # Errors
    /// If the sky cannot be read, or there is not enough memory.
    pub fn picture(
        &self,
        world: &TexturedScene,
        accel: &Tracer,
        recipe: &Recipe,
        seed: u64,
    ) -> Result<(Film, Counters), AppError> {
        let size = self.studio.size;
        let lights = Lights::load(&self.studio.geometry, world)?;
        let numbers = Numbers::new(recipe.pattern, recipe.spp, size, seed);
        let tracer = PathTracer::new(&self.studio, world, accel.as_accel(), lights, numbers, recipe.rules);
        let mut sums = Sums::new(Frame::whole(size), Layout::default(), 0).map_err(AppError::from)?;
        let options = TileOptions { threads: Some(1), ..TileOptions::default() };
        let rendering = Rendering { goal: Goal { end: recipe.spp, time: None, error: None }, options };
        let tally = rendering.run(&tracer, &mut sums, |_| {});
        Ok((develop::radiance(&sums), tally.counters))
    }
}
