//! Assignment 6: trees that find hits in logarithmic time, and textures.
//!
//! kd-trees by three rules ([`kdtree::KdTree`]), behind `-kdtree`, and what beats them, the
//! eight-wide bounding volume hierarchy ([`bvh::Bvh`]), behind `-accel`. Solid textures and
//! pictures are worked out by [`texture::TexturedScene`], which shading asks through the seam
//! [`a1_ray_casting::World`].

mod args;
pub mod bvh;
pub mod kdtree;
pub mod texture;

pub use args::{AccelArgs, Choice, Program};

use a1_ray_casting::Studio;
use common::cli::AppError;
use texture::TexturedScene;

/// The whole program: reads the scene, renders what was asked for, writes it.
///
/// # Errors
/// Bad usage, an unreadable scene, an unwritable picture.
pub fn run(args: &AccelArgs) -> Result<(), AppError> {
    if args.grid.shows_cells() {
        args.grid.check()?
    } else {
        args.check()?
    }
    let (studio, mut report) = Studio::open_textured(args.cast(), &args.grid.outputs())?;
    let load = || TexturedScene::load(&studio.scene, &studio.geometry, &args.cast().input);
    let scene = report.time("textures", load)?;
    report.notes.extend(scene.describe());
    args.grid.whitted.phong.draw_preview(&studio, &scene, &mut report)?;
    let cells = args.grid.cells(&studio)?;
    if args.grid.shows_cells() {
        report.cells = cells.as_ref().map(|c| c.count.map(|n| n as u32));
        return a5_grid::picture_of_cells(&args.grid, &studio, cells, report);
    }
    let structure = report.time("build", || args.structure(&studio.geometry, cells))?;
    report.notes.push(structure.describe());
    a4_whitted::shoot(&args.grid.whitted, &studio, &scene, structure.as_accel(), report)
}
