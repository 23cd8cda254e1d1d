//! Assignment 6: trees that find hits in logarithmic time, and textures.
//!
//! kd-trees by three rules ([`kdtree::KdTree`]), behind `-kdtree`, and what beats them, the
//! eight-wide bounding volume hierarchy ([`bvh::Bvh`]), behind `-accel`; both are built when the
//! first ray asks ([`Lazy`]), and [`picture`] shows them and what they cost. Solid textures and
//! pictures are worked out by [`texture::TexturedScene`], which shading asks through the seam
//! [`a1_ray_casting::World`].

mod args;
pub mod bvh;
mod figures;
pub mod instances;
pub mod kdtree;
mod lazy;
pub mod picture;
pub mod texture;
mod tracer;

pub use args::{AccelArgs, Choice, Program};
pub use lazy::Lazy;
pub use tracer::{LazyBvh, LazyInstances, LazyTree, Tracer};

use a1_ray_casting::{Report, Studio};
use common::cli::AppError;
use picture::BoxPicture;
use std::time::Duration;
use texture::TexturedScene;

/// The whole program: reads the scene, renders what was asked for, writes it.
///
/// # Errors
/// Bad usage, an unreadable scene, an unwritable picture.
pub fn run(args: &AccelArgs) -> Result<(), AppError> {
    let args = &args.with_outputs();
    args.check()?;
    let (studio, report) = Studio::open_textured(args.cast(), &args.grid.outputs())?;
    draw(args, &studio, report)
}

/// What is left of [`run`] when the scene is open: renders what was asked for, writes it. `args`
/// are those of [`AccelArgs::with_outputs`].
///
/// # Errors
/// An unreadable texture, a grid that is too large, an unwritable picture.
pub fn draw(args: &AccelArgs, studio: &Studio, mut report: Report) -> Result<(), AppError> {
    let load = || TexturedScene::load(&studio.scene, &studio.geometry, &args.cast().input);
    let scene = report.time("textures", load)?;
    report.notes.extend(scene.describe());
    args.grid.whitted.phong.draw_preview(studio, &scene, &mut report)?;
    let cells = args.grid.cells(studio)?;
    if args.grid.shows_cells() {
        report.cells = cells.as_ref().map(|c| c.count.map(|n| n as u32));
        let heat = args.heat_picture().into_iter().collect();
        return a5_grid::picture_of_cells(&args.grid, studio, cells, heat, report);
    }
    let tracer = report.time("build", || {
        let tracer = args.structure(&studio.geometry, cells)?;
        if args.visualize_kdtree {
            tracer.kd_tree().map(|tree| tree.get());
        }
        Ok::<_, AppError>(tracer)
    })?;
    match tracer.kd_tree().filter(|_| args.visualize_kdtree) {
        Some(tree) => draw_boxes(args, studio, tree, &mut report)?,
        None => draw_scene(args, studio, &scene, &tracer, &mut report)?,
    }
    report.cells = tracer.cells();
    report.notes.extend(tracer.figures(&report.counters));
    report.print_if_wanted(args.cast());
    Ok(())
}

/// The picture of `-visualize_kdtree`, with the depth and normal pictures beside it.
fn draw_boxes(
    args: &AccelArgs,
    studio: &Studio,
    tree: &LazyTree,
    report: &mut Report,
) -> Result<(), AppError> {
    let diffuse = &args.grid.whitted.phong.diffuse;
    let light = diffuse.local_light(&studio.scene);
    let layer = BoxPicture { tree: tree.get(), light, interval: studio.camera.interval };
    let mut pictures = diffuse.side_pictures();
    pictures.extend(args.cast().color_picture(layer));
    pictures.extend(args.heat_picture());
    studio.expose(args.cast(), tree, &pictures, report)
}

/// The pictures of the scene itself. The build that the first ray waits for is no part of the
/// time for rendering.
fn draw_scene(
    args: &AccelArgs,
    studio: &Studio,
    scene: &TexturedScene,
    tracer: &Tracer,
    report: &mut Report,
) -> Result<(), AppError> {
    let (whitted, heat) = (&args.grid.whitted, args.heat_picture());
    a4_whitted::expose(whitted, studio, scene, tracer.as_accel(), heat.into_iter().collect(), report)?;
    let build = tracer.build_time().unwrap_or_default();
    // The ray of -trace asks before rendering begins.
    let waited = if whitted.trace.is_some() { Duration::ZERO } else { build };
    for (phase, time) in &mut report.phases {
        match *phase {
            "build" => *time += build,
            "render" => *time = time.saturating_sub(waited),
            _ => {}
        }
    }
    Ok(())
}
