//! Whole command lines: process start, reading, building, rendering, writing.

use crate::child;
use crate::report::{Better, Cell, Section, Table};
use crate::sample::Sample;
use common::cli::AppError;
use std::path::Path;

/// The case that the course itself runs.
const MAIN: usize = 1;

/// A name and a command line of assignment 5.
const CASES: [(&str, &str); 5] = [
    ("start: one sphere, 1x1", "-input scenes/scene1_01.txt -size 1 1"),
    (
        "main job: 40k triangles, picture of cells",
        "-input scenes/scene5_09_bunny_mesh_40k.txt -size 200 200 -grid 40 40 33 -visualize_grid",
    ),
    (
        "40k triangles, shadows, grid",
        "-input scenes/scene5_09_bunny_mesh_40k.txt -size 200 200 -grid 40 40 33 -shadows",
    ),
    ("1k triangles, shadows, list", "-input scenes/scene5_07_bunny_mesh_1k.txt -size 200 200 -shadows"),
    (
        "gem, 5 bounces, list",
        "-input scenes/scene4_14_faceted_gem.txt -size 200 200 -shadows -shade_back -bounces 5 -weight 0.01",
    ),
];

/// What to measure.
#[derive(clap::Args)]
pub struct Options {
    /// Rounds; every round runs every command line once
    #[arg(long, default_value_t = 31)]
    rounds: usize,
}

/// Makes sure that scenes are where command lines look for them.
///
/// # Errors
/// If the program is not started from the repository's root.
pub fn at_home() -> Result<(), AppError> {
    let lost = || AppError::Usage("run this from the repository's root, where scenes/ is".to_owned());
    Path::new("scenes").is_dir().then_some(()).ok_or_else(lost)
}

/// Times every case `rounds` times, in turn.
///
/// # Errors
/// If a command line fails, or is not started from the repository's root.
pub fn measure(options: &Options) -> Result<Section, AppError> {
    at_home()?;
    let samples = child::in_folder(|folder| rounds(options.rounds.max(1), folder))?;
    let mut table =
        Table::new("command lines", "", &[("wall ms", Better::Less), ("processor ms", Better::Less)]);
    for ((name, _), [wall, cpu]) in CASES.iter().zip(&samples) {
        table.row(*name, [Cell::from(wall), Cell::from(cpu)]);
    }
    Ok(Section {
        part: "pictures",
        title: "Whole command lines, from process start to the written picture".to_owned(),
        remarks: vec!["assignment 5, 200 x 200 pixels, all threads: median (quartiles)".to_owned()],
        headline: vec![("main job, wall ms".to_owned(), Cell::from(&samples[MAIN][0]))],
        tables: vec![table],
        ..Section::default()
    })
}

/// Wall-clock and processor time of every case, in milliseconds.
fn rounds(rounds: usize, folder: &Path) -> Result<Vec<[Sample; 2]>, AppError> {
    let mut samples = vec![<[Sample; 2]>::default(); CASES.len()];
    let picture = folder.join("out.tga");
    // The first round warms the file cache and is not counted.
    for round in 0..=rounds {
        for ((_, line), [wall, cpu]) in CASES.iter().zip(&mut samples) {
            let words: Vec<&str> = std::iter::once("a5_grid").chain(line.split(' ')).collect();
            let span = child::time(&words, Some(&picture))?;
            if round > 0 {
                wall.add(span.wall);
                cpu.add(span.cpu);
            }
        }
    }
    Ok(samples)
}
