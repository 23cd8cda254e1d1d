//! Assignment 8: light that has been anywhere.
//!
//! What a pixel shows is an integral over all ways that light can take to it (Kajiya, "The
//! rendering equation", 1986). [`path`] takes such ways at random and weighs what they bring;
//! the mean is the picture. [`film`] adds up what they bring, exactly; [`render`] decides how many
//! there are. [`run`] is the program, [`merge`] puts together what several runs have done.

mod args;
pub mod bsdf;
mod eight;
pub mod film;
mod fingerprint;
pub mod light;
pub mod merge;
pub mod numbers;
mod outputs;
pub mod path;
mod plan;
pub mod render;
mod shoot;
mod warnings;

pub use args::{PathArgs, Program};
pub use film::{Aov, Layout, Sums};
pub use path::{Found, Integrator, PathTracer, Rules, Scratch};
pub use render::{Estimator, Goal};
pub use shoot::{Traced, run};
