//! What a step costs and where it leads: the seam between the run and its quadrics.

use crate::collapse::quadric::Symmetric;
use crate::collapse::ring::Ring;
use crate::collapse::surface::Surface;
use common::math::DVec3;

/// Share of the trace by which a minimum must be determined; in directions in which it is less,
/// the middle of the edge decides. It is relative, so flat is flat at any scale.
const LEAST_RANK: f64 = 1e-9;

/// What it costs to draw an edge together, and the place that costs least.
#[derive(Clone, Copy, Debug)]
pub(super) struct Offer {
    pub cost: f64,
    pub place: DVec3,
}

/// Two points that became one.
pub(super) struct Merge {
    /// The number that the point has now.
    pub kept: u32,
    /// The number that the other point had.
    pub gone: u32,
    /// Where they were, `kept` first.
    pub from: [DVec3; 2],
    /// Where the point is now.
    pub place: DVec3,
}

/// How steps are priced.
pub(super) trait Cost: Clone {
    /// How many drawers dearer than thought an edge may be and still not be put back.
    const PATIENCE: u32 = 0;

    /// Asks the memory for what is known of a point.
    fn prefetch(&self, point: u32);

    /// The price of drawing the edge of a half-edge together.
    fn price(&self, surface: &Surface, h: u32) -> Offer;

    /// Takes note of a step: `surface` as it is after it, `ring` as it looked before it.
    fn merged(&mut self, surface: &Surface, ring: &Ring, merge: &Merge);
}

/// Where yᵀ·A·y − 2·r·y is least, relative to the start of an edge, and what `error` is there. In
/// directions in which A does not tell, the middle of the edge is taken; if the minimum is far
/// from the edge, the best of its ends and its middle.
#[inline(always)]
pub(super) fn minimum(a: Symmetric, r: DVec3, edge: DVec3, error: impl Fn(DVec3) -> f64) -> (DVec3, f64) {
    let mut regular = a;
    let weight = LEAST_RANK * a.trace();
    regular.add_diagonal(weight);
    let y = regular.solve(r + edge * (0.5 * weight));
    let far = 4.0 * edge.length_squared();
    // Also false if there was no solution.
    if y.length_squared() < far && (y - edge).length_squared() < far {
        return (y, error(y));
    }
    on_edge(edge, error)
}

#[cold]
fn on_edge(edge: DVec3, error: impl Fn(DVec3) -> f64) -> (DVec3, f64) {
    let tried = [0.5, 0.0, 1.0].map(|t| (edge * t, error(edge * t)));
    tried.into_iter().min_by(|a, b| a.1.total_cmp(&b.1)).expect("three were tried")
}
