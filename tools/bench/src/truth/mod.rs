//! What rays really hit: double precision, independent of the house's structures and shapes.
//!
//! A binary tree cut at medians, boxes widened against rounding, and a watertight test of
//! triangles. Slow beside the structures it judges, but a million rays against ten million
//! triangles take seconds where asking every triangle would take weeks.

mod tree;
mod triangle;

pub use tree::Tree;
pub use triangle::{Line, cosine};

/// The nearest hit of one ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Truth {
    /// In units of the ray's direction; +∞ for a miss.
    pub t: f64,
    /// The triangle, the lowest-numbered one at that t; [`MISS`] for a miss.
    pub primitive: u32,
}

/// The triangle that stands for none.
pub const MISS: u32 = u32::MAX;

impl Truth {
    /// Whether anything is hit.
    pub fn is_hit(&self) -> bool {
        self.primitive != MISS
    }
}
