//! A scene: drawn as ever, with fewer triangles in its meshes.

use super::outputs::{refuse_collisions, write_report};
use crate::args::SimplifyArgs;
use crate::goal::{Goal, Settings};
use crate::measure::Original;
use crate::report::{Level, Report};
use crate::{SimplifyError, simplify};
use a1_ray_casting::Studio;
use common::atomic;
use common::cli::{self, AppError};
use common::geometry::Geometry;
use common::mesh::Mesh;
use std::sync::Arc;

/// Runs the program on a scene: every mesh, named however often, is simplified once.
///
/// # Errors
/// Bad usage, an unreadable scene, a picture that cannot be written.
pub fn run(args: &SimplifyArgs) -> Result<(), AppError> {
    let goal = goal(args)?;
    let accel = args.accel.with_outputs();
    accel.check()?;
    let outputs = accel.grid.outputs();
    args.report.as_deref().map_or(Ok(()), atomic::check)?;
    let all: Vec<_> = outputs.iter().copied().chain(args.report.as_deref()).collect();
    refuse_collisions(&all, &[args.input()])?;
    let (mut studio, mut report) = Studio::open_textured(accel.cast(), &outputs)?;
    let reports = report.time("simplify", || simplify_meshes(args, goal, &mut studio))?;
    for told in &reports {
        report.notes.extend(told.levels.iter().map(|level| format!("{}: {}", told.input, level.summary())));
    }
    if args.measures() {
        report.notes.extend(reports.iter().flat_map(Report::distances));
    }
    a6_kdtree::draw(&accel, &studio, report)?;
    let Some(path) = &args.report else { return Ok(()) };
    let texts: Vec<String> = reports.iter().map(Report::to_string).collect();
    let objects: Vec<String> = reports.iter().map(Report::json).collect();
    write_report(path, &texts.join("\n\n"), &format!("[{}]", objects.join(",")))
}

/// The one goal; flags that only make sense for a mesh are refused.
fn goal(args: &SimplifyArgs) -> Result<Goal, AppError> {
    let of_meshes = [
        (args.goals.levels.is_some(), "-levels"),
        (args.goals.compare.is_some(), "-compare"),
        (args.render.is_some(), "-render"),
    ];
    if let Some((_, flag)) = of_meshes.iter().find(|(given, _)| *given) {
        let kinds = "the input is taken for a scene; meshes are .obj .ply .stl";
        return Err(AppError::Usage(format!("{flag} is for a mesh, but {kinds}")));
    }
    Ok(args.goals.list()?[0])
}

/// Puts simplified meshes in the place of those of the scene.
fn simplify_meshes(args: &SimplifyArgs, goal: Goal, studio: &mut Studio) -> Result<Vec<Report>, AppError> {
    let meshes = std::mem::take(&mut studio.scene.meshes);
    if meshes.is_empty() {
        cli::warn("there is no mesh in this scene");
    }
    let mut reports = Vec::new();
    for (number, mesh) in (1..).zip(&meshes) {
        let (simplified, report) = args.on_threads(|| one(args, goal, mesh, number))??;
        report.warnings().iter().for_each(|text| cli::warn(&format!("{}: {text}", report.input)));
        studio.scene.meshes.push(Arc::new(simplified));
        reports.push(report);
    }
    studio.geometry = Geometry::build(&studio.scene)?;
    Ok(reports)
}

fn one(args: &SimplifyArgs, goal: Goal, mesh: &Mesh, number: usize) -> Result<(Mesh, Report), SimplifyError> {
    let mut report = Report::new(&format!("mesh {number}"), args.method);
    let settings = Settings { method: args.method, bound: args.measures() };
    let mut results = report.time("simplify", || simplify(mesh, &[goal], &settings))?;
    let result = results.remove(0);
    let mut level = Level::new((Some(goal), &result));
    if args.measures() {
        let original = Original::new(mesh);
        level.comparison = Some(original.compare(&result.mesh, args.samples));
        report.describe(&original, args.samples);
    }
    report.levels.push(level);
    Ok((result.mesh, report))
}
