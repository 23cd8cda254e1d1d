//! Assignment 5: space cut into cells. The grid as a picture, and as a way to find hits sooner.

mod args;
mod cell_picture;
mod cells;
mod grid;
mod march;
pub mod overlap;
mod structure;
pub mod voxelise;

pub use args::{GridArgs, Program};
pub use cell_picture::{CellPicture, cell_color, shaded_face};
pub use cells::{Cells, MAX_CELLS};
pub use grid::Grid;
pub use march::{March, Step};
pub use structure::Structure;
pub use voxelise::Fit;

use a1_ray_casting::{Picture, Report, Studio};
use common::accel::List;
use common::cli::{AppError, Skip};
use common::math::{Bounds, Vec3};

/// The whole program: reads the scene, renders what was asked for, writes it.
///
/// # Errors
/// Bad usage, an unreadable scene, an unwritable picture.
pub fn run(args: &GridArgs) -> Result<(), AppError> {
    args.check()?;
    let (studio, mut report) = Studio::open(args.cast(), &args.outputs())?;
    args.whitted.phong.draw_preview(&studio, &studio.scene, &mut report)?;
    let cells = args.cells(&studio)?;
    report.cells = cells.as_ref().map(|c| c.count.map(|n| n as u32));
    if args.shows_cells() {
        return picture_of_cells(args, &studio, cells, Vec::new(), report);
    }
    let accel = report.time("build", || args.structure(&studio.geometry, cells))?;
    report.notes.push(accel.describe());
    report.counters.structures += accel.built();
    a4_whitted::shoot(&args.whitted, &studio, &studio.scene, accel.as_accel(), report)
}

/// The picture of `-visualize_grid`, with the depth and normal pictures beside it and `further`
/// ones of a later step, which need no hits. Only counts are kept of the cells, unless a picture
/// needs hits.
///
/// # Errors
/// If a grid that hits need would be too large, or a picture cannot be written.
pub fn picture_of_cells(
    args: &GridArgs,
    studio: &Studio,
    cells: Option<Cells>,
    further: Vec<Picture>,
    mut report: Report,
) -> Result<(), AppError> {
    // A scene without finite objects has no box; its picture is nothing but background.
    let cells = cells.unwrap_or_else(|| Cells::new([1; 3], &Bounds::of_points([Vec3::ZERO])));
    let fit = args.grid_fit.unwrap_or(Fit::Bounds);
    let counts = report.time("build", || voxelise::count(&cells, &studio.geometry, fit));
    let occupied = counts.iter().filter(|n| **n > 0).count();
    report.notes.push(format!("grid: {occupied} of {} cells occupied", cells.len()));
    let side = args.whitted.phong.diffuse.side_pictures();
    let needless = side.is_empty() && args.cast().general.skips(Skip::Lazy);
    let structure = match needless {
        true => {
            report.counters.skipped_structure += 1;
            report.notes.push("skipped: a structure for hits, no picture needs one".to_owned());
            Structure::List(List::new(&studio.geometry))
        }
        false => args.structure(&studio.geometry, Some(cells.clone()))?,
    };
    report.counters.structures += structure.built();
    let light = args.whitted.phong.diffuse.local_light(&studio.scene);
    let layer = CellPicture { cells: &cells, counts: &counts, light, interval: studio.camera.interval };
    let mut pictures = side;
    pictures.extend(args.cast().color_picture(layer));
    pictures.extend(further);
    studio.shoot(args.cast(), structure.as_accel(), &pictures, report)
}
