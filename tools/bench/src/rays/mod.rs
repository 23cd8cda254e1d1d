//! Rays per second of every structure on the same rays, beside what is wrong with the answers.
//!
//! Rates are rays per processor time, times the number of threads that share the rays, so that
//! waiting for a busy machine does not count. What threads cost each other does: caches, memory,
//! and cores that are halves of one.

mod contender;
mod files;
mod ours;
#[cfg(feature = "peers")]
mod peers;
mod sets;
mod table;
mod timing;
mod verdict;

pub use sets::{NAMES, RaySet, make};

use crate::report::Section;
use crate::truth::Tree;
use crate::world::World;
use common::cli::{AppError, note};
use contender::{Contender, Structure};
use std::fs::File;
use std::io::Write;
use std::path::PathBuf;
use table::Row;
use timing::Question;

/// What to measure.
#[derive(clap::Args)]
pub struct Options {
    /// Meshes to make or read: bunny, sphereN, gyroidN, terrainN (1k to 10m triangles), a file.obj
    #[arg(long, value_delimiter = ',', default_values_t = ["bunny".to_owned(), "sphere200k".to_owned()])]
    meshes: Vec<String>,
    /// A mesh file instead: .obj, or the prefix M of M.v.f32 and M.f.u32; M.SET.rays.f32 beside it
    /// are read, too, and the truth in M.SET.gt.f64 and M.SET.gtprim.u32
    #[arg(long, value_name = "FILE")]
    mesh: Option<PathBuf>,
    /// Ray sets to be sent at --mesh, called M.SET.rays.f32
    #[arg(long, value_name = "FILE", num_args = 1.., requires = "mesh")]
    rays: Vec<PathBuf>,
    /// Ray sets to make
    #[arg(long, value_delimiter = ',', value_parser = NAMES, default_values_t = NAMES.map(str::to_owned))]
    sets: Vec<String>,
    /// Structures; all that were compiled in if not given
    #[arg(long, value_delimiter = ',')]
    structures: Vec<String>,
    /// Numbers of threads
    #[arg(long, value_delimiter = ',', default_values_t = [1, 2])]
    #[arg(value_parser = clap::builder::RangedU64ValueParser::<usize>::new().range(1..=256))]
    threads: Vec<usize>,
    /// Rounds; every round asks every structure once
    #[arg(long, default_value_t = 5)]
    rounds: usize,
    /// Rays of each set that are timed; all are judged
    #[arg(long, default_value_t = 1 << 18)]
    timed: usize,
    /// Camera rays in a row and rows of them; the other sets are as large
    #[arg(long, default_value_t = 1024, value_parser = clap::value_parser!(u16).range(1..))]
    side: u16,
    /// Writes all figures, an object to a line
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Writes meshes, rays and truth to this folder, for other programs
    #[arg(long, value_name = "FOLDER")]
    save: Option<PathBuf>,
}

/// Measures every mesh, one after the other.
///
/// # Errors
/// If a mesh, ray set or structure is unknown or unreadable, or a file cannot be written.
pub fn measure(options: &Options) -> Result<Section, AppError> {
    let structures = contender::chosen(&options.structures)?;
    let mut json = options.json.as_ref().map(File::create).transpose()?;
    let mut section = table::section();
    let count = if options.mesh.is_some() { 1 } else { options.meshes.len() };
    for i in 0..count {
        let (world, sets) = workload(options, i)?;
        note(&format!("{}: {} triangles", world.name, world.triangles()));
        if let Some(folder) = &options.save {
            files::write_all(folder, &world, &sets)?;
        }
        let lines = on_mesh(options, &structures, &world, &sets, &mut section)?;
        if let Some(file) = &mut json {
            file.write_all((lines.join("\n") + "\n").as_bytes())?;
        }
    }
    Ok(section)
}

/// A mesh and its ray sets with their truth.
fn workload(options: &Options, index: usize) -> Result<(World, Vec<RaySet>), AppError> {
    let world = match &options.mesh {
        Some(file) => files::read_world(file)?,
        None => World::named(&options.meshes[index])?,
    };
    let truth = Tree::new(&world.mesh);
    let mut files = options.rays.clone();
    if let (Some(mesh), true) = (&options.mesh, files.is_empty()) {
        files = files::sets_beside(mesh)?;
    }
    let mut sets = files.iter().map(|file| files::read_set(file, &truth)).collect::<Result<Vec<_>, _>>()?;
    if files.is_empty() {
        sets = make(&world, &truth, usize::from(options.side), &options.sets);
    }
    drop(truth);
    Ok((world, sets))
}

/// Measures one mesh, adds to the section what was found, and returns it as JSON, too.
fn on_mesh(
    options: &Options,
    structures: &[Structure],
    world: &World,
    sets: &[RaySet],
    section: &mut Section,
) -> Result<Vec<String>, AppError> {
    let built = timing::build(world, structures, options.rounds)?;
    let builds: Vec<_> =
        structures.iter().zip(&built).map(|(s, (c, cost))| (s.name, cost, c.bytes())).collect();
    section.tables.push(table::of_builds(world, &builds));
    let mut lines: Vec<String> =
        builds.iter().map(|(name, cost, bytes)| table::build_json(world, name, cost, *bytes)).collect();
    let contenders: Vec<&dyn Contender> = built.iter().map(|(c, _)| &**c).collect();
    let questions: Vec<Question> = options
        .threads
        .iter()
        .flat_map(|&threads| [false, true].map(|any| Question { any, threads }))
        .collect();
    let mut rates = Vec::new();
    for set in sets.iter().filter(|s| !s.rays.is_empty()) {
        let judged: Vec<_> = contenders.iter().map(|c| verdict::judge(world, set, *c)).collect();
        let asked = timing::ask(&contenders, set, &questions, (options.timed.max(1), options.rounds.max(1)));
        let rows: Vec<Row> = (structures.iter().zip(&asked).zip(judged))
            .map(|((s, rates), verdict)| Row { name: s.name, rates, verdict })
            .collect();
        section.tables.push(table::of_answers(world, &set.name, &questions, &rows));
        rows.iter().for_each(|row| tell_cases(set, row));
        section.faults.extend(rows.iter().filter_map(|row| fault(world, set, row)));
        lines.extend(rows.iter().map(|row| table::row_json(world, &set.name, &questions, row)));
        rates.push(asked);
    }
    let first = sets.iter().find(|s| !s.rays.is_empty()).map_or("", |s| &s.name);
    section.headline.extend(table::headline(world, first, &builds, &rates));
    section.figures.extend(table::figure(world, &builds, &rates));
    Ok(lines)
}

/// Ours must never be wrong. Others may, in single precision.
fn fault(world: &World, set: &RaySet, row: &Row) -> Option<String> {
    let wrong = row.verdict.wrong();
    let ours = ours::all().iter().any(|s| s.name == row.name);
    (ours && wrong > 0)
        .then(|| format!("{}, {}: {} answers {wrong} rays wrongly", world.name, set.name, row.name))
}

/// The first wrong answer of each kind, so that it can be looked into.
fn tell_cases(set: &RaySet, row: &Row) {
    for (kind, place, truth, answer) in &row.verdict.cases {
        let ray = &set.rays[*place];
        note(&format!(
            "{} {}: {kind}, ray {place} {:?} {:?}, truth {truth:?}, answer {answer:?}",
            row.name, set.name, ray.origin, ray.direction
        ));
    }
}
