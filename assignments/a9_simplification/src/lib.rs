//! Assignment 9: simplification. Fewer triangles, the least error for them.
//!
//! [`simplify()`] draws edges together, those first whose loss changes the surface least, and never
//! breaks what was whole. [`Goal`] says when to stop, [`Method`] what "least" means.

mod collapse;
mod goal;
mod simplify;

pub use goal::{Goal, Irregular, Method, Settings, Simplified, Stopped};
pub use simplify::{SimplifyError, simplify};
