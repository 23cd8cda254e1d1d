//! Assignment 9: simplification. Fewer triangles, the least error for them.
//!
//! [`simplify`] draws edges together, those first whose loss changes the surface least, and never
//! breaks what was whole. [`Goal`] says when to stop, [`Method`] what "least" means.

pub mod collapse;
mod goal;

pub use goal::{Goal, Method, Settings, Simplified, Stopped};
