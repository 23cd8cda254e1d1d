//! Assignment 1: cameras, spheres, the nearest hit; pictures of colour and depth.
//!
//! The idea of this step: for every pixel one ray, for every ray the nearest hit, and a picture
//! is whatever one makes of that hit. A [`Layer`] is that last part. All later steps render
//! through [`Studio::render`] and differ in their layers and in the structure that finds hits.

mod args;
mod checks;
mod layer;
mod report;
mod studio;
mod world;

pub use args::{CastArgs, Program};
pub use layer::{Depth, FlatColor, Layer, Sight};
pub use report::Report;
pub use studio::{Picture, Studio, picture};
pub use world::{Mixture, Part, World};

use common::accel::List;
use common::cli::AppError;

/// The whole program: reads the scene, renders what was asked for, writes it.
///
/// # Errors
/// Bad usage, an unreadable scene, an unwritable picture.
pub fn run(args: &CastArgs) -> Result<(), AppError> {
    args.refuse_idleness(&args.outputs(), "-output, -depth")?;
    let (studio, mut report) = Studio::open(args, &args.outputs())?;
    let list = report.time("build", || List::new(&studio.geometry));
    let color = FlatColor::new(&studio.scene);
    let mut pictures = Vec::new();
    pictures.extend(args.color_picture(color));
    pictures.extend(args.depth_picture());
    studio.shoot(args, &list, &pictures, report)
}
