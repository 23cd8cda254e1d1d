//! What is asked of a simplification, and what comes back.

use common::mesh::Mesh;

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// At no more than this many triangles.
    Faces(usize),
    /// At no more than this share of the triangles, in [0, 1].
    Ratio(f64),
    /// Before the surface is further off than this share of the diagonal of the mesh's box: the
    /// fewest triangles that were found with [`Simplified::error`] within it.
    Error(f64),
}

/// What a step costs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Method {
    /// Quadrics that are summed up as vertices merge (Garland & Heckbert 1997): fastest.
    Qem,
    /// Quadrics of the triangles that are there now, stale ones priced anew when their turn comes
    /// (after Lindstrom & Turk 1998), and a fit to the original at the end: the least error.
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
    /// Whether [`Simplified::error`] is wanted; it costs about as much as the simplification.
    pub bound: bool,
}

/// Why it stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stopped {
    /// The goal is reached.
    Reached,
    /// No edge is left that can be drawn together without breaking something.
    Stuck,
}

/// What was found in the mesh that is not part of a surface, and what was done with it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Irregular {
    /// Triangles with a corner twice (at the same place), left out.
    pub collapsed: usize,
    /// Triangles that are there already, left out.
    pub repeated: usize,
    /// Points where more than two triangles meet at an edge, neighbours turn opposite ways or
    /// several fans of triangles touch: they stay where they are.
    pub held: usize,
}

/// A mesh of fewer triangles.
#[derive(Clone, Debug)]
pub struct Simplified {
    /// The mesh.
    pub mesh: Mesh,
    /// Why it has no fewer triangles.
    pub stopped: Stopped,
    /// Bound of the Hausdorff distance between its surface and the original's, in the mesh's own
    /// unit: no point of either is further from the other. It is a few
    /// hundredths larger than it need be where the surfaces run beside each other. There if
    /// [`Settings::bound`] asked for it or the goal was one.
    pub error: Option<f64>,
    /// How many triangles look against the original: against every triangle of it that is nearest to
    /// their middles. 0 unless no place was found for their corners at which they do not, as may
    /// be where the original is folded.
    pub against: usize,
    /// For every vertex of the original the one it became; `u32::MAX` if it is gone altogether.
    pub becomes: Vec<u32>,
    /// What was irregular in the original.
    pub irregular: Irregular,
}
