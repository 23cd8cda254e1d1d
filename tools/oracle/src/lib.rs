//! The independent reference renderer: double precision, brute force, written for clarity.
//!
//! It draws everything that assignments 1 to 7 can draw (of the sample patterns the uniform one), and shares with the fast core only the
//! scene as it was read (`common::scene`, `common::mesh`) and the vector type. Cameras, shapes,
//! shading and the cell picture are written here a second time, straight from the pixel rules,
//! so that a mistake in one of the two renderers shows as a difference between them.
//!
//! ```text
//! Scene ── World (objects with composed transforms, lights)
//!            │
//! View ── Ray ── World::nearest ── Hit ── texture ── shade / tree ── Pictures
//!   │        └── cells (the picture of -visualize_grid)
//! sampling (places in a pixel and on a lens, filters, pictures of both)
//! ```
//!
//! [`render`] makes whole pictures. [`View::ray`] and [`World::nearest`] answer for one ray,
//! at any position inside a pixel, which is what agreement tests need.

mod cells;
mod emitter;
mod error;
mod light;
mod object;
mod optics;
mod options;
mod ray;
mod render;
mod sampling;
mod shade;
mod shape;
mod surface;
mod texture;
mod transform;
mod tree;
mod view;
mod world;

pub use cells::{CellGrid, CellHit, cell_colour};
pub use error::OracleError;
pub use optics::{fresnel_reflectance, mirror, refract};
pub use options::{CellPicture, GridFit, Model, Options, Specular};
pub use ray::{Range, Ray};
pub use render::{Pictures, Raster, Samples, render, samples};
pub use sampling::{Filter, filter_picture, pixel_places, samples_picture};
pub use surface::Surface;
pub use texture::Mixture;
pub use view::View;
pub use world::{Hit, World};
