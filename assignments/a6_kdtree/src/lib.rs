//! Assignment 6: trees that find hits in logarithmic time.
//!
//! kd-trees by three rules ([`kdtree::KdTree`]), behind `-kdtree`, and what beats them, the
//! eight-wide bounding volume hierarchy ([`bvh::Bvh`]), behind `-accel`. Textures are still to
//! come.

mod args;
pub mod bvh;
pub mod kdtree;

pub use args::{AccelArgs, Choice, Program};

use a1_ray_casting::Studio;
use common::cli::AppError;

/// The whole program: reads the scene, renders what was asked for, writes it.
///
/// # Errors
/// Bad usage, an unreadable scene, an unwritable picture.
pub fn run(args: &AccelArgs) -> Result<(), AppError> {
    if args.grid.shows_cells() {
        return a5_grid::run(&args.grid);
    }
    args.check()?;
    let (studio, mut report) = Studio::open(args.cast(), &args.grid.outputs())?;
    args.grid.whitted.phong.draw_preview(&studio, &mut report)?;
    let cells = args.grid.cells(&studio)?;
    let structure = report.time("build", || args.structure(&studio.geometry, cells))?;
    report.notes.push(structure.describe());
    a4_whitted::shoot(&args.grid.whitted, &studio, structure.as_accel(), report)
}
