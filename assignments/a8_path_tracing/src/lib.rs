//! Assignment 8: light that has been anywhere.
//!
//! What a pixel shows is an integral over all ways that light can take to it (Kajiya, "The
//! rendering equation", 1986). [`path`] takes such ways at random and weighs what they bring;
//! the mean is the picture.

mod args;
pub mod bsdf;
pub mod light;
pub mod numbers;
pub mod path;

pub use args::{PathArgs, Program, run};
pub use path::{Found, Integrator, PathTracer, Rules, Scratch, Tally};
