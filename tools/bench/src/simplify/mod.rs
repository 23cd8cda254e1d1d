//! Simplification: processor time against two-sided distance, methods × ratios × meshes.
//!
//! Every result is verified before it is timed (property 17 of the accuracy promises: nothing
//! broken, the target met, the same result twice and on any number of threads, the error vouched
//! for no less than the one measured). Then all are timed in turn, without that bound, so that a
//! busy moment of the machine hits all alike.

mod contender;
mod part;
#[cfg(feature = "peers")]
mod peers;
mod sizes;
mod table;
mod verdict;

use crate::clock;
use crate::report::Section;
use crate::sample::Sample;
use crate::world::mesh_named;
use a9_simplification::measure::{Comparison, Original, SAMPLES};
use common::cli::{AppError, note};
use common::mesh::Mesh;
use contender::Contender;
use std::fs;
use std::path::PathBuf;

/// What to measure.
#[derive(clap::Args)]
pub struct Options {
    /// Meshes to make or read: partN (sharp edges), sphereN, gyroidN, terrainN (with a boundary),
    /// bunny, a file.obj
    #[arg(long, value_delimiter = ',')]
    #[arg(default_values_t = ["sphere40k", "part20k", "gyroid100k", "terrain100k"].map(str::to_owned))]
    meshes: Vec<String>,
    /// A mesh file, measured besides
    #[arg(long, value_name = "FILE")]
    mesh: Vec<PathBuf>,
    /// Also gyroid1m
    #[arg(long)]
    full: bool,
    /// Shares of the triangles to keep
    #[arg(long, value_delimiter = ',', default_values_t = [0.5, 0.1, 0.01])]
    ratios: Vec<f64>,
    /// Methods; all that were compiled in if not given
    #[arg(long, value_delimiter = ',')]
    methods: Vec<String>,
    /// Rounds; every round runs every method once
    #[arg(long, default_value_t = 5)]
    rounds: usize,
    /// Points of either surface at which distances are measured, besides vertices and edges
    #[arg(long, default_value_t = SAMPLES)]
    samples: usize,
    /// Meshes of growing size of which only the time is measured; '' for none
    #[arg(long, value_delimiter = ',')]
    #[arg(default_values_t = ["sphere4k", "sphere16k", "sphere64k", "sphere256k"].map(str::to_owned))]
    sizes: Vec<String>,
    /// Writes all figures, a row for each result
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
}

/// One method's result for one ratio.
pub struct Row {
    /// The method.
    pub name: &'static str,
    /// Triangles that are left.
    pub faces: usize,
    /// Milliseconds of processor time, one for each round.
    pub cpu: Sample,
    /// What was measured.
    pub comparison: Comparison,
    /// The error that the method vouches for, as a share of the diagonal.
    pub bound: Option<f64>,
    /// What is wrong with it; empty if nothing.
    pub faults: Vec<String>,
}

/// Measures every mesh, one after the other. Broken promises of ours are the section's faults.
///
/// # Errors
/// If a mesh or method is unknown, or a file cannot be written.
pub fn measure(options: &Options) -> Result<Section, AppError> {
    let contenders = contender::chosen(&options.methods)?;
    let full = options.full.then(|| "gyroid1m".to_owned());
    let files = options.mesh.iter().map(|file| file.display().to_string());
    let mut lines = vec![table::CSV_HEAD.to_owned()];
    let mut section = begun();
    for name in options.meshes.iter().cloned().chain(full).chain(files) {
        on_mesh(options, &contenders, &name, &mut section, &mut lines)?;
    }
    sizes::measure(options, &contenders, &mut section)?;
    if let Some(file) = &options.csv {
        fs::write(file, lines.join("\n") + "\n")?;
    }
    Ok(section)
}

fn begun() -> Section {
    let mut remarks = vec![
        "processor time: median (quartiles); distances in 1/10,000 of the diagonal; *: nothing whole beats it in time and distance"
            .to_owned(),
        "shape: mean quality of faces; against: faces that look against the nearest of the original".to_owned(),
    ];
    if !cfg!(feature = "peers") {
        remarks.push(
            "the crate meshopt is absent: `cargo run --release -p bench --features peers -- simplify`"
                .to_owned(),
        );
    }
    let title = "Simplification: processor time against two-sided distance".to_owned();
    Section { part: "simplify", title, remarks, ..Section::default() }
}

/// Measures one mesh: tables, a figure, faults, and lines of CSV.
fn on_mesh(
    options: &Options,
    contenders: &[Contender],
    name: &str,
    section: &mut Section,
    lines: &mut Vec<String>,
) -> Result<(), AppError> {
    let mesh = made(name)?;
    let (original, triangles) = (Original::new(&mesh), mesh.triangles.len());
    note(&format!("{name}: {triangles} triangles"));
    let mut ratios = Vec::new();
    for &ratio in &options.ratios {
        let rows = with_ratio(options, contenders, &mesh, &original, ratio)?;
        section.tables.push(table::of_ratio(name, triangles, ratio, &rows));
        lines.extend(table::csv(name, triangles, ratio, &rows));
        let ours = rows.iter().filter(|row| contender::is_ours(row.name) && !row.faults.is_empty());
        let fault = |row: &Row| format!("{name} to {ratio} by {}: {}", row.name, row.faults.join("; "));
        section.faults.extend(ours.map(fault));
        ratios.push(rows);
    }
    if section.headline.is_empty() {
        section.headline = table::headline(name, &options.ratios, &ratios);
    }
    section.figures.push(table::figure(name, &ratios));
    Ok(())
}

/// The mesh of a name.
fn made(name: &str) -> Result<Mesh, AppError> {
    match part::named(name) {
        Some(mesh) => mesh,
        None => mesh_named(name),
    }
}

/// Verifies all methods, then times them.
fn with_ratio(
    options: &Options,
    contenders: &[Contender],
    mesh: &Mesh,
    original: &Original,
    ratio: f64,
) -> Result<Vec<Row>, AppError> {
    let mut rows = Vec::new();
    for contender in contenders {
        rows.push(verdict::judge(contender, mesh, original, ratio, options.samples)?);
    }
    for _ in 0..options.rounds.max(1) {
        for (contender, row) in contenders.iter().zip(&mut rows) {
            let (result, span) = clock::time(|| (contender.run)(mesh, ratio, false))?;
            result?;
            row.cpu.add(span.cpu);
        }
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn options(meshes: &[&str], methods: &[&str]) -> Options {
        Options {
            meshes: meshes.iter().map(|m| (*m).to_owned()).collect(),
            mesh: Vec::new(),
            full: false,
            ratios: vec![0.5, 0.1],
            methods: methods.iter().map(|m| (*m).to_owned()).collect(),
            rounds: 1,
            samples: 2_000,
            sizes: vec!["sphere300".to_owned(), "sphere1k".to_owned()],
            csv: None,
        }
    }

    #[test]
    fn small_meshes_are_measured_and_verified() {
        let good =
            [options(&["part1k"], &["qem", "memoryless", "melax"]), options(&["terrain1k"], &["memoryless"])];
        for options in good {
            let section = measure(&options).unwrap_or_else(|error| panic!("{}", error.report()));
            assert_eq!(section.faults, Vec::<String>::new());
            assert_eq!((section.tables.len(), section.figures.len()), (2 + 2, 1 + 1));
            assert!(section.headline[0].0.contains("to 0.1, memoryless"), "{:?}", section.headline);
        }
        for options in
            [options(&["part1"], &[]), options(&["nothing"], &[]), options(&["part1k"], &["magic"])]
        {
            assert!(matches!(measure(&options), Err(AppError::Usage(_))));
        }
    }
}
