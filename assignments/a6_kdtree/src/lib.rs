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
use common::accel::Accel;
use common::cli::AppError;
use picture::BoxPicture;
use std::time::Duration;
use texture::TexturedScene;

/// The whole program: reads the scene, renders what was asked for, writes it.
///
/// # Errors
/// Bad usage, an unreadable scene, an unwritable picture.
pub fn run(args: &AccelArgs) -> Result<(), AppError> {
    perform(args, &Plain)
}

/// What a later step does differently.
pub trait Step {
    /// Changes the scene's camera, or what else was read.
    ///
    /// # Errors
    /// If that is impossible.
    fn adjust(&self, _: &mut Studio) -> Result<(), AppError> {
        Ok(())
    }

    /// Draws and writes the pictures of the scene itself; `args` are those of [`perform`].
    ///
    /// # Errors
    /// An unwritable picture.
    fn draw(
        &self,
        args: &AccelArgs,
        studio: &Studio,
        scene: &TexturedScene,
        accel: &dyn Accel,
        report: &mut Report,
    ) -> Result<(), AppError>;
}

/// This step: one ray through the centre of every pixel.
pub struct Plain;

impl Step for Plain {
    fn draw(
        &self,
        args: &AccelArgs,
        studio: &Studio,
        scene: &TexturedScene,
        accel: &dyn Accel,
        report: &mut Report,
    ) -> Result<(), AppError> {
        let heat = args.heat_picture().into_iter().collect();
        a4_whitted::expose(&args.grid.whitted, studio, scene, accel, heat, report)
    }
}

/// The whole program, with the scene's own pictures drawn by `step`.
///
/// # Errors
/// Bad usage, an unreadable scene, an unwritable picture.
pub fn perform(args: &AccelArgs, step: &dyn Step) -> Result<(), AppError> {
    let args = &args.with_outputs();
    args.check()?;
    let (mut studio, report) = Studio::open_textured(args.cast(), &args.grid.outputs())?;
    step.adjust(&mut studio)?;
    draw_by(step, args, &studio, report)
}

/// What is left of [`run`] when the scene is open: renders what was asked for, writes it. `args`
/// are those of [`AccelArgs::with_outputs`].
///
/// # Errors
/// An unreadable texture, a grid that is too large, an unwritable picture.
pub fn draw(args: &AccelArgs, studio: &Studio, report: Report) -> Result<(), AppError> {
    draw_by(&Plain, args, studio, report)
}

/// The same with the scene's own pictures drawn by `step`.
fn draw_by(step: &dyn Step, args: &AccelArgs, studio: &Studio, mut report: Report) -> Result<(), AppError> {
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
        None => draw_scene(args, studio, &scene, &tracer, step, &mut report)?,
    }
    report.cells = tracer.cells();
    tracer.count(&mut report.counters);
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
    step: &dyn Step,
    report: &mut Report,
) -> Result<(), AppError> {
    step.draw(args, studio, scene, tracer.as_accel(), report)?;
    let build = tracer.build_time().unwrap_or_default();
    // The ray of -trace asks before rendering begins.
    let mut waited = if args.grid.whitted.trace.is_some() { Duration::ZERO } else { build };
    for (phase, time) in &mut report.phases {
        match *phase {
            "build" => *time += build,
            "render" => *time = time.saturating_sub(std::mem::take(&mut waited)),
            _ => {}
        }
    }
    Ok(())
}
