//! Assignment 4: shadows, mirrors and glass; the ray tree.
//!
//! [`Whitted`] follows every mirrored and refracted ray until depth or weight ends it
//! (Whitted, "An improved illumination model for shaded display", 1980), and asks shadow rays
//! how much of each light arrives. A [`Recorder`] can watch; [`RayTree`] writes down all it sees.

mod args;
mod generation;
mod interface;
mod interior;
mod optics;
mod shadow;
mod tree;
mod wave;
mod whitted;

pub use args::{Program, WhittedArgs};
pub use optics::{Crossing, mirror, refract};
pub use tree::{NoRecord, RayKind, RayNode, RayTree, Recorder};
pub use whitted::{Rules, Whitted, WhittedColor};

use a1_ray_casting::{Picture, Report, Studio, World};
use common::accel::{Accel, List};
use common::cli::AppError;

/// The whole program: reads the scene, renders what was asked for, writes it.
///
/// # Errors
/// Bad usage, an unreadable scene, an unwritable picture.
pub fn run(args: &WhittedArgs) -> Result<(), AppError> {
    args.check()?;
    let (studio, mut report) = Studio::open(args.cast(), &args.outputs())?;
    args.phong.draw_preview(&studio, &studio.scene, &mut report)?;
    let list = report.time("build", || List::new(&studio.geometry));
    shoot(args, &studio, &studio.scene, &list, report)
}

/// Renders and writes the pictures of this step and those before through any structure. `scene`
/// is the studio's, and tells what its surfaces are made of.
///
/// # Errors
/// An unwritable picture.
pub fn shoot(
    args: &WhittedArgs,
    studio: &Studio,
    scene: &dyn World,
    accel: &dyn Accel,
    mut report: Report,
) -> Result<(), AppError> {
    expose(args, studio, scene, accel, Vec::new(), &mut report)?;
    report.print_if_wanted(args.cast());
    Ok(())
}

/// The same without the report, and with `further` pictures of a later step, rendered last.
///
/// # Errors
/// An unwritable picture.
pub fn expose<'a>(
    args: &'a WhittedArgs,
    studio: &'a Studio,
    scene: &'a dyn World,
    accel: &'a dyn Accel,
    further: Vec<Picture<'a>>,
    report: &mut Report,
) -> Result<(), AppError> {
    let whitted = args.whitted(scene, accel);
    args.print_ray_tree(studio, &whitted, report)?;
    let mut pictures: Vec<Picture<'a>> = args.phong.diffuse.side_pictures();
    pictures.extend(args.cast().color_picture(WhittedColor { whitted }));
    pictures.extend(further);
    studio.expose(args.cast(), accel, &pictures, report)
}
