//! Assignment 9: simplification. Fewer triangles, the least error for them.
//!
//! [`simplify()`] draws edges together, those first whose loss changes the surface least, and never
//! breaks what was whole. [`Goal`] says when to stop, [`Method`] what "least" means. How good the
//! result is, [`measure`] tells; [`files`] reads and writes meshes.

mod args;
mod collapse;
pub mod files;
mod goal;
pub mod measure;
mod program;
mod render;
pub mod report;
mod simplify;

pub use args::{Program, SimplifyArgs};
pub use goal::{Goal, Irregular, Method, Settings, Simplified, Stopped};
pub use program::run;
pub use simplify::{SimplifyError, simplify};
