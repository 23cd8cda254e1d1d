//! What is asked of a simplification, and what comes back.

use common::mesh::Mesh;

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// At no more than this many triangles.
    Faces(usize),
    /// At no more than this share of the triangles, in [0, 1].
    Ratio(f64),
    /// Before the surface is further off than this share of the diagonal of the mesh's box.
    Error(f64),
}

/// What a step costs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Method {
    /// Quadrics that are summed up as vertices merge (Garland & Heckbert 1997): fastest.
    Qem,
    /// Quadrics of the triangles that are there now, stale ones priced anew when their turn comes
    /// (after Lindstrom & Turk 1998): the least error.
    #[default]
    Memoryless,
    /// Length times curvature, to an end of the edge (Melax 1998): for teaching.
    Melax,
}

/// How to simplify.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Settings {
    /// What a step costs.
    pub method: Method,
}

/// Why it stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stopped {
    /// The goal is reached.
    Reached,
    /// No edge is left that can be drawn together without breaking something.
    Stuck,
}

/// A mesh of fewer triangles.
#[derive(Clone, Debug)]
pub struct Simplified {
    /// The mesh.
    pub mesh: Mesh,
    /// Why it has no fewer triangles.
    pub stopped: Stopped,
    /// Bound of the distance from its surface to the original's, in the mesh's own unit.
    pub error: f64,
    /// For every vertex of the original the one it became; `u32::MAX` if it is gone altogether.
    pub becomes: Vec<u32>,
}
