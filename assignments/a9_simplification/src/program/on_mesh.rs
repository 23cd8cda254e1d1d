//! A mesh: simplified, measured, shown, written.

use super::outputs::{Outputs, write_report};
use crate::args::SimplifyArgs;
use crate::goal::{Irregular, Settings, Simplified, Stopped};
use crate::measure::Original;
use crate::render::Exhibition;
use crate::report::{Level, Report};
use crate::{files, simplify};
use common::cli::{self, AppError};
use common::mesh::Mesh;
use common::picture::{self, Film, Transfer};
use std::path::Path;
use std::time::Instant;

/// Runs the program on a mesh. Everything is worked out before the first file is written.
///
/// # Errors
/// Bad usage, an unreadable mesh, a file that cannot be written.
pub fn run(args: &SimplifyArgs) -> Result<(), AppError> {
    let goals = if args.goals.compare.is_some() { Vec::new() } else { args.goals.list()? };
    let outputs = Outputs::of_mesh(args, goals.len().max(1))?;
    check(args, &outputs)?;
    let started = Instant::now();
    let mesh = files::read(args.input())?;
    let mut report = Report::new(&args.input().display().to_string(), args.method);
    report.times.push(("read", started.elapsed()));
    let results = match &args.goals.compare {
        Some(other) => vec![unchanged(files::read(other)?)],
        None => {
            let settings = Settings { method: args.method, bound: args.measures() };
            report.time("simplify", || args.on_threads(|| simplify(&mesh, &goals, &settings)))??
        }
    };
    report.levels =
        goals.iter().map(|goal| Some(*goal)).chain([None]).zip(&results).map(Level::new).collect();
    if args.measures() {
        measure(args, &mesh, &results, &mut report)?;
    }
    let films = show(args, &mesh, &results, &mut report)?;
    for (outputs, result) in outputs.iter().zip(&results) {
        outputs.mesh.as_deref().map_or(Ok(()), |path| files::write(path, &result.mesh))?;
    }
    let pictures = outputs.iter().filter_map(|o| o.picture.as_deref()).zip(&films);
    pictures.into_iter().try_for_each(|(path, film)| picture::write(path, film, Transfer::Linear))?;
    tell(args, &report)
}

/// A mesh that was simplified by somebody else.
fn unchanged(mesh: Mesh) -> Simplified {
    let irregular = Irregular::default();
    Simplified { mesh, stopped: Stopped::Reached, error: None, against: 0, becomes: Vec::new(), irregular }
}

/// Refuses what cannot be done, and tasks that leave nothing behind.
fn check(args: &SimplifyArgs, outputs: &[Outputs]) -> Result<(), AppError> {
    let cast = args.cast();
    let idle = outputs.iter().all(|o| *o == Outputs::default()) && !args.measures();
    if idle {
        let text = "nothing to do: give -output, -render, -report or -stats";
        return Err(AppError::Usage(text.to_owned()));
    }
    if args.goals.compare.is_some() && cast.output.is_some() {
        return Err(AppError::Usage("-compare makes no mesh, so there is no -output to write".to_owned()));
    }
    let inputs: Vec<&Path> = [args.input()].into_iter().chain(args.goals.compare.as_deref()).collect();
    Outputs::check(outputs, args.report.as_deref(), &inputs, Exhibition::size(cast.size()?)?)
}

fn measure(
    args: &SimplifyArgs,
    mesh: &Mesh,
    results: &[Simplified],
    report: &mut Report,
) -> Result<(), AppError> {
    let started = Instant::now();
    let (original, comparisons) = args.on_threads(|| {
        let original = Original::new(mesh);
        let found: Vec<_> = results.iter().map(|r| original.compare(&r.mesh, args.samples)).collect();
        (original, found)
    })?;
    report.describe(&original, args.samples);
    for (level, comparison) in report.levels.iter_mut().zip(comparisons) {
        level.comparison = Some(comparison);
    }
    report.times.push(("measure", started.elapsed()));
    Ok(())
}

/// The pictures of `-render`, one for each result.
fn show(
    args: &SimplifyArgs,
    mesh: &Mesh,
    results: &[Simplified],
    report: &mut Report,
) -> Result<Vec<Film>, AppError> {
    let Some((_, hottest)) = args.picture()? else { return Ok(Vec::new()) };
    let started = Instant::now();
    let exhibition = Exhibition::new(mesh, args.cast(), hottest)?;
    let mut films = Vec::new();
    for (level, result) in report.levels.iter_mut().zip(results) {
        let (film, note) = exhibition.film(&result.mesh)?;
        if args.cast().general.program.verbose {
            cli::note(&note);
        }
        level.notes.push(note);
        films.push(film);
    }
    report.times.push(("render", started.elapsed()));
    Ok(films)
}

/// Writes the report where it is wanted, and warns of what one might not expect.
fn tell(args: &SimplifyArgs, report: &Report) -> Result<(), AppError> {
    report.warnings().iter().for_each(|text| cli::warn(text));
    if let Some(path) = &args.report {
        write_report(path, &report.to_string(), &report.json())?;
    }
    if args.cast().general.program.stats {
        cli::say(&report.to_string());
    }
    Ok(())
}
