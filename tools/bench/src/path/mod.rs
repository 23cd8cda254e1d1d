//! Error of path-traced pictures against processor time: integrators, samplers, paths per pixel.
//!
//! Every picture is compared with a converged one: one that is given, or one of our own with
//! another seed, made once and kept. All pictures of a seed are taken in turn, by one thread, so
//! that a busy moment of the machine hits all kinds.

mod measure;
mod reference;
mod subject;
mod table;

use crate::report::Section;
use a7_sampling::Pattern;
use a8_path_tracing::{Integrator, Rules};
use common::cli::{self, AppError};
use common::picture::{Film, Size, Transfer, write};
use measure::{Recipe, Shot};
use std::path::{Path, PathBuf};
use subject::Subject;

/// What to measure.
#[derive(clap::Args)]
pub struct Options {
    /// Scene files
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "scenes/scene8_01_cornell_box.txt,scenes/scene8_02_cornell_spheres.txt,scenes/scene8_03_mesh.txt"
    )]
    scene: Vec<PathBuf>,
    /// Converged picture of the one scene: .exr .pfm or .npy; pictures are then as large
    #[arg(long)]
    reference: Option<PathBuf>,
    /// Side of the pictures without one
    #[arg(long, default_value_t = 64)]
    side: u32,
    /// Paths per pixel of converged pictures of our own
    #[arg(long, default_value_t = 8192)]
    truth: u32,
    /// Where they are kept
    #[arg(long, default_value = "target/converged")]
    keep: PathBuf,
    /// Paths per pixel
    #[arg(long, value_delimiter = ',', default_value = "4,16,64")]
    spp: Vec<u32>,
    /// Where samples lie
    #[arg(long, value_enum, value_delimiter = ',', default_value = "random,sobol")]
    sampler: Vec<Pattern>,
    /// How light is looked for
    #[arg(long, value_enum, value_delimiter = ',', default_value = "naive,nee,mis")]
    integrator: Vec<Integrator>,
    /// Most surfaces that send a path on before the one that a light shines on
    #[arg(long, default_value_t = 6)]
    bounces: u32,
    /// Surfaces before roulette
    #[arg(long, default_value_t = 1)]
    rr_depth: u32,
    /// What finds hits, as for a6_kdtree
    #[arg(long, default_value = "auto")]
    accel: String,
    /// Independent pictures of every kind
    #[arg(long, default_value_t = 5)]
    seeds: u64,
    /// Writes the last picture of the last scene
    #[arg(long, value_name = "PICTURE")]
    write: Option<PathBuf>,
    /// Every measurement, one in a line
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
}

/// Measures all scenes, writes the files that were asked for.
///
/// # Errors
/// A scene or a picture that cannot be read.
pub fn measure(options: &Options) -> Result<Section, AppError> {
    if options.reference.is_some() && options.scene.len() != 1 {
        return Err(AppError::Usage("--reference belongs to one --scene".to_owned()));
    }
    let mut csv = "scene,integrator,sampler,spp,seed,cpu_s,rmse,relative_mse\n".to_owned();
    let mut section = table::section();
    for scene in &options.scene {
        measure_scene(options, scene, &mut csv, &mut section)?;
    }
    options.csv.as_ref().map_or(Ok(()), |file| std::fs::write(file, csv))?;
    Ok(section)
}

impl Options {
    fn rules(&self, integrator: Integrator) -> Rules {
        let (bounces, roulette_depth) = (Some(self.bounces), self.rr_depth);
        Rules { integrator, bounces, roulette_depth, ..Rules::default() }
    }

    fn recipes(&self) -> Vec<Recipe> {
        let mut recipes = Vec::new();
        for &integrator in &self.integrator {
            for &pattern in &self.sampler {
                recipes.extend(self.spp.iter().map(|&spp| Recipe {
                    rules: self.rules(integrator),
                    pattern,
                    spp,
                }));
            }
        }
        recipes
    }

    /// The converged picture of a scene: read, or made and kept.
    fn truth(&self, scene: &Path) -> Result<Film, AppError> {
        if let Some(file) = &self.reference {
            return reference::load(file);
        }
        let side = i64::from(self.side);
        let size = Size::new(side, side)?;
        let subject = Subject::open(scene, size, &self.accel)?;
        let name = format!("{}_{side}_{}_{}.pfm", subject.name, self.truth, self.bounces);
        let file = self.keep.join(name);
        if file.is_file() {
            return reference::load(&file);
        }
        cli::note(&format!("making {} once", file.display()));
        let recipe = Recipe { rules: self.rules(Integrator::Mis), pattern: Pattern::Sobol, spp: self.truth };
        let film = subject.with(|world, accel| subject.picture(world, accel, &recipe, u64::MAX))??.0;
        std::fs::create_dir_all(&self.keep)?;
        write(&file, &film, Transfer::Linear)?;
        Ok(film)
    }
}

fn measure_scene(
    options: &Options,
    scene: &Path,
    csv: &mut String,
    section: &mut Section,
) -> Result<(), AppError> {
    let truth = options.truth(scene)?;
    let subject = Subject::open(scene, truth.size(), &options.accel)?;
    let recipes = options.recipes();
    let mut shots: Vec<Vec<Shot>> = vec![Vec::new(); recipes.len()];
    let last = subject.with(|world, accel| {
        let mut last = None;
        for seed in 0..options.seeds.max(1) {
            for (recipe, shots) in recipes.iter().zip(&mut shots) {
                let (shot, film) = recipe.shoot(&subject, (world, accel), seed, &truth)?;
                csv.push_str(&shot.line(&subject.name, recipe, seed));
                shots.push(shot);
                last = Some(film);
            }
        }
        Ok::<_, AppError>(last)
    })??;
    if let (Some(file), Some(film)) = (&options.write, last) {
        write(file, &film, Transfer::Linear)?;
    }
    table::add(section, &subject.name, truth.size(), &recipes, &shots);
    Ok(())
}
