//! Assignment 2: planes, triangles, meshes under transforms; diffuse shading; pictures of normals.
//!
//! The shapes and their placement live in `common` (`geometry`, `shape`), because every later
//! step needs them; the idea of this step is what light does at a surface. [`LocalLight`] adds
//! up ambient and direct light; later steps hand it a richer reflectance (assignment 3) and ask
//! shadow rays what stands before each light (assignment 4).

mod args;
mod diffuse;
mod incident;
mod local;
mod normals;

pub use args::{DiffuseArgs, Program};
pub use diffuse::{DiffuseColor, diffuse};
pub use incident::{Incident, Source, falloff, incident, source};
pub use local::{Centres, Lamps, LocalLight};
pub use normals::Normals;

use a1_ray_casting::Studio;
use common::accel::List;
use common::cli::AppError;

/// The whole program: reads the scene, renders what was asked for, writes it.
///
/// # Errors
/// Bad usage, an unreadable scene, an unwritable picture.
pub fn run(args: &DiffuseArgs) -> Result<(), AppError> {
    args.refuse_idleness()?;
    let (studio, mut report) = Studio::open(&args.cast, &args.outputs())?;
    let list = report.time("build", || List::new(&studio.geometry));
    let color = DiffuseColor { scene: &studio.scene, light: args.local_light(&studio.scene) };
    let mut pictures = args.side_pictures();
    pictures.extend(args.cast.color_picture(color));
    studio.shoot(&args.cast, &list, &pictures, report)
}
