//! Error of pictures against samples and against processor time: patterns, filters, scenes, and
//! adaptive sampling against as many samples for all.
//!
//! Every picture is compared with a converged one of the same filter and another seed. Pictures of
//! one scene are taken in turn, seed after seed, so that a busy moment of the machine hits all.

mod adaptive;
mod csv;
mod curves;
mod measure;
mod scene;

use crate::report::Section;
use a7_sampling::{Kernel, KernelName};
use common::cli::{self, AppError};
use common::picture::Size;
use csv::Csv;
use scene::Place;
use std::path::PathBuf;

/// What to measure.
#[derive(clap::Args)]
pub struct Options {
    /// Smaller pictures, fewer samples and seeds: a look in a minute
    #[arg(long)]
    quick: bool,
    /// Seeds: as many independent pictures of every kind
    #[arg(long, value_parser = clap::value_parser!(u64).range(2..=1000))]
    seeds: Option<u64>,
    /// Scenes of the first two parts: built-in ones or scene files; '' for none
    #[arg(long, value_delimiter = ',', default_value = "disc,gradient,board,shadow,lens")]
    scenes: Vec<String>,
    /// Scenes of the adaptive part; '' for none
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "few,scenes/scene4_01_sphere_shadow.txt,board,scenes/scene6_13_checkerboard.txt,scenes/scene6_16_wood_cubes.txt,shadow,lens,scenes/scene4_14_faceted_gem.txt"
    )]
    adaptive_scenes: Vec<String>,
    /// Every measurement, one in a line
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Plots: error against samples of the first scene, of the second, and so on
    #[arg(long, value_name = "FILE", num_args = 1..)]
    svg: Vec<PathBuf>,
    /// Plot of the adaptive part's first scene: error against time
    #[arg(long, value_name = "FILE")]
    adaptive_svg: Option<PathBuf>,
}

/// How much of everything.
#[derive(Clone, Copy, Debug)]
struct Effort {
    size: Size,
    /// Samples of converged pictures.
    truth: u32,
    /// Most samples of the others.
    most: u32,
    seeds: u64,
}

impl Options {
    fn effort(&self) -> Result<Effort, AppError> {
        let (width, height, truth, most, seeds) =
            if self.quick { (32, 24, 1024, 64, 3) } else { (64, 48, 4096, 256, 5) };
        Ok(Effort { size: Size::new(width, height)?, truth, most, seeds: self.seeds.unwrap_or(seeds) })
    }
}

impl Effort {
    /// Larger pictures, in which edges have the share that they have in real ones, and less of the
    /// rest to make up for it.
    fn for_adaptive(self) -> Result<Self, AppError> {
        let side = |n: u32| 3 * i64::from(n);
        let size = Size::new(side(self.size.width()), side(self.size.height()))?;
        Ok(Self { size, truth: self.truth / 2, seeds: self.seeds.min(3), ..self })
    }
}

/// The filters compared; without one a pixel is the average of its own samples.
fn kernels() -> Result<Vec<(&'static str, Option<Kernel>)>, AppError> {
    let named = |name: KernelName, radius| name.with_radius(radius).map(Some);
    Ok(vec![
        ("none", None),
        ("tent 1", named(KernelName::Tent, 1.0)?),
        ("gaussian 0.5", named(KernelName::Gaussian, 0.5)?),
        ("mitchell 2", named(KernelName::Mitchell, 2.0)?),
        ("lanczos 3", named(KernelName::Lanczos, 3.0)?),
        ("blackman_harris 1.5", named(KernelName::BlackmanHarris, 1.5)?),
    ])
}

/// Measures all parts, writes the CSV and the plots that were asked for.
///
/// # Errors
/// An unknown scene, a file that cannot be written.
pub fn measure(options: &Options) -> Result<Section, AppError> {
    cli::set_quiet(true);
    let (effort, mut csv) = (options.effort()?, Csv::default());
    let mut section = begun(&effort);
    let mut files = options.svg.iter();
    for name in options.scenes.iter().filter(|name| !name.is_empty()) {
        let place = Place::named(name, effort.size)?;
        let (lit, drawn) = (place.lit()?, section.figures.len());
        curves::compare_patterns(&lit, &effort, &mut csv, &mut section)?;
        files.next().map_or(Ok(()), |file| section.figures[drawn].draw(file))?;
        curves::compare_filters(&lit, &effort, &mut csv, &mut section)?;
    }
    let effort = effort.for_adaptive()?;
    let (mut table, mut file) = (adaptive::table(), options.adaptive_svg.as_ref());
    for name in options.adaptive_scenes.iter().filter(|name| !name.is_empty()) {
        let place = Place::named(name, effort.size)?;
        let figure = adaptive::compare(&place.lit()?, &effort, &mut csv, &mut table)?;
        file.take().map_or(Ok(()), |file| figure.draw(file))?;
        section.figures.push(figure);
    }
    section.tables.extend(Some(table).filter(|table| !table.rows.is_empty()));
    options.csv.as_ref().map_or(Ok(()), |path| csv.write(path))?;
    Ok(section)
}

fn begun(effort: &Effort) -> Section {
    Section {
        part: "sampling",
        title: "Error of pictures against samples and against time: patterns, filters, adaptive sampling"
            .to_owned(),
        remarks: vec![
            format!("RMSE by number of samples in thousandths, with 95 % intervals of {} seeds", effort.seeds),
            "slope: b of RMSE = a samples^b from 4 samples on".to_owned(),
            "time to the first row's error: what it takes to get where independent samples end, over what those take"
                .to_owned(),
            "ratios of adaptive sampling: its cost over that of the same error with as many samples for all"
                .to_owned(),
        ],
        ..Section::default()
    }
}
