//! Assignment 3: specular highlights, and a preview drawn without rays.
//!
//! [`Phong`] adds the highlight to the diffuse light of assignment 2. The preview tessellates
//! the scene and draws it with a z-buffer, flat or Gouraud shaded; the interactive window and
//! `-preview` use it.

mod args;
mod phong;
mod preview;
mod raster;
mod tessellate;

pub use args::{PhongArgs, Program, Specular};
pub use phong::{Phong, PhongColor};
pub use preview::{Preview, Shading};
pub use raster::{Canvas, Corner, rasterise};
pub use tessellate::{Face, Resolution, Tessellation, Tessellator, Vertex};

use a1_ray_casting::Studio;
use common::accel::List;
use common::cli::AppError;

/// The whole program: reads the scene, renders what was asked for, writes it.
///
/// # Errors
/// Bad usage, an unreadable scene, an unwritable picture.
pub fn run(args: &PhongArgs) -> Result<(), AppError> {
    args.check()?;
    let (studio, mut report) = Studio::open(args.cast(), &args.outputs())?;
    args.draw_preview(&studio, &studio.scene, &mut report)?;
    let list = report.time("build", || List::new(&studio.geometry));
    let color = args.color(&studio.scene);
    let mut pictures = args.diffuse.side_pictures();
    pictures.extend(args.cast().color_picture(color));
    studio.shoot(args.cast(), &list, &pictures, report)
}
