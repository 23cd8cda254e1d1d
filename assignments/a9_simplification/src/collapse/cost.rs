//! What a step costs and where it leads: the seam between the run and its quadrics.

use crate::collapse::quadric::Symmetric;
use crate::collapse::queue::Line;
use crate::collapse::ring::Ring;
use crate::collapse::surface::Surface;
use common::math::DVec3;

/// Share of the trace by which a minimum must be determined; in directions in which it is less,
/// the middle of the edge decides. It is relative, so flat is flat at any scale.
pub(super) const LEAST_RANK: f64 = 1e-9;

/// Square of how far a minimum may be drawn away by what decides where A does not tell, in lengths of the edge.
const FAINT: f64 = 0.01;

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
    /// Who comes next.
    type Line: Line;

    /// How many drawers dearer than thought an edge may be and still not be put back.
    const PATIENCE: u32 = 0;

    /// The same as long as nothing has been forgotten: much is left that costs as little, and most prices that are worked out
    /// only say that it is not an edge's turn yet.
    const EARLY_PATIENCE: u32 = Self::PATIENCE;

    /// Whether what is sure at a quick look is not looked at closely, so that [`Cost::merged`] is told nothing of the ring;
    /// what was refused has to wait until a step ends at it.
    const IS_QUICK: bool = false;

    /// What it costs besides if the ends of an edge, which were at `from`, are drawn together at `place`, and that
    /// cuts off a tip; `ring` knows how all looks after the step.
    fn lost(ring: &Ring, from: [DVec3; 2], place: DVec3) -> f64 {
        ring.lost(from, place)
    }

    /// Asks the memory for what is known of a point.
    fn prefetch(&self, point: u32);

    /// The price of drawing the edge of a half-edge together.
    fn price(&self, surface: &Surface, h: u32) -> Offer;

    /// Calls `what` with every edge and its price.
    fn price_all(&self, surface: &Surface, mut what: impl FnMut(u32, f64)) {
        surface.edges().for_each(|h| what(h, self.price(surface, h).cost));
    }

    /// Where the point is put if an offer is taken.
    fn place(&self, _surface: &Surface, _h: u32, offer: &Offer) -> DVec3 {
        offer.place
    }

    /// Forgets what was there before, as if the surface had been so from the beginning.
    fn forget(&mut self, _surface: &Surface) {}

    /// Lets go of what is known of points: nothing is priced any more.
    fn let_go(&mut self) {}

    /// Bytes that are held for all points.
    #[cfg(test)]
    fn bytes(&self) -> usize;

    /// Takes note of a step: `surface` as it is after it, `ring` as it looked before it.
    fn merged(&mut self, surface: &Surface, ring: &Ring, merge: &Merge);
}

/// The offer for the edge of a half-edge: `form` tells for the way along it A and r as in [`minimum`], `error` what
/// it costs to put the point at y, seen from the edge's start and from its end, and `shape` how much the squared length
/// of the edge counts: so little that it only decides on flat parts, where short edges come first.
#[inline(always)]
pub(super) fn cheapest(
    surface: &Surface,
    h: u32,
    shape: f64,
    form: impl FnOnce(DVec3) -> (Symmetric, DVec3),
    error: impl Fn(DVec3, DVec3) -> f64,
) -> Offer {
    let from = surface.at(surface.start(h));
    let edge = surface.at(surface.end(h)) - from;
    let (a, r) = form(edge);
    let (y, cost) = minimum(a, r, edge, LEAST_RANK, |y| error(y, y - edge));
    Offer { cost: cost + shape * a.trace() * edge.length_squared(), place: from + y }
}

/// The same for an edge from a place if the form is A, r and c, so that it costs yᵀ·A·y − 2·r·y + c to put the point at
/// y, seen from the edge's start, and a minimum must be determined by `least_rank` of the trace. That is less to work out,
/// but what is lost by cancellation must not be more than what the length of the edge counts.
#[inline(always)]
pub(super) fn cheapest_by_form(
    from: DVec3,
    edge: DVec3,
    (least_rank, shape): (f64, f64),
    (a, r, c): (Symmetric, DVec3, f64),
) -> Offer {
    let (y, cost) = minimum(a, r, edge, least_rank, |y| y.dot(a.times(y) - r * 2.0) + c);
    Offer { cost: cost + shape * a.trace() * edge.length_squared(), place: from + y }
}

/// Where yᵀ·A·y − 2·r·y is least, relative to the start of an edge, and what `error` is there. In
/// directions in which A does not tell, the middle of the edge is taken; if the minimum is far
/// from the edge, the best of its ends and its middle.
#[inline(always)]
fn minimum(
    a: Symmetric,
    r: DVec3,
    edge: DVec3,
    least_rank: f64,
    error: impl Fn(DVec3) -> f64,
) -> (DVec3, f64) {
    let mut regular = a;
    let weight = least_rank * a.trace();
    regular.add_diagonal(weight);
    let y = regular.solve(r + edge * (0.5 * weight));
    let far = 4.0 * edge.length_squared();
    // Also false if there was no solution.
    if y.length_squared() < far && (y - edge).length_squared() < far {
        return (y, error(y));
    }
    on_edge(edge, error)
}

/// The place of an offer, seen from the start of the edge, without what has drawn it to the edge's middle where A does
/// tell.
pub(super) fn without_bias(a: Symmetric, r: DVec3, edge: DVec3, least_rank: f64, y: DVec3) -> DVec3 {
    let mut regular = a;
    regular.add_diagonal(least_rank * a.trace());
    let step = regular.solve(r - a.times(y));
    // Also false if there was no solution; farther away is what is no minimum.
    if step.length_squared() < FAINT * edge.length_squared() { y + step } else { y }
}

#[cold]
fn on_edge(edge: DVec3, error: impl Fn(DVec3) -> f64) -> (DVec3, f64) {
    let tried = [0.5, 0.0, 1.0].map(|t| (edge * t, error(edge * t)));
    tried.into_iter().min_by(|a, b| a.1.total_cmp(&b.1)).expect("three were tried")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn best(a: Symmetric, b: Symmetric, edge: DVec3) -> (DVec3, f64) {
        minimum(a + b, b.times(edge), edge, LEAST_RANK, |y| a.square(y) + b.square(y - edge))
    }

    fn planes(normals: &[DVec3]) -> Symmetric {
        normals.iter().map(|&n| Symmetric::outer(n, 1.0)).fold(Symmetric::default(), |sum, plane| sum + plane)
    }

    #[test]
    fn corners_beat_edges_and_edges_beat_faces_at_any_scale() {
        let corner = planes(&[DVec3::X, DVec3::Y, DVec3::Z]);
        let (ridge, flat) = (planes(&[DVec3::Y, DVec3::Z]), planes(&[DVec3::Z]));
        for scale in [1e-20, 1.0, 1e20] {
            let along = DVec3::X * scale;
            let (y, cost) = best(corner, ridge, along);
            assert!(y.length() < 1e-8 * scale && cost < 1e-15 * scale * scale);
            let (y, cost) = best(ridge, flat, DVec3::Y * scale);
            assert!(y.length() < 1e-8 * scale && cost < 1e-15 * scale * scale);
            // Two flat points: nothing tells, so it is the middle.
            let (y, cost) = best(flat, flat, along);
            assert!((y - along * 0.5).length() < 1e-12 * scale && cost == 0.0);
        }
    }

    #[test]
    fn two_unequal_planes_share_the_way_in_proportion() {
        let (a, b) = (Symmetric::outer(DVec3::X, 3.0), Symmetric::outer(DVec3::X, 1.0));
        let (y, cost) = best(a, b, DVec3::X);
        assert!((y - DVec3::X * 0.25).length() < 1e-8);
        assert!((cost - (3.0 * 0.0625 + 0.5625)).abs() < 1e-8);
    }

    #[test]
    fn a_minimum_far_away_is_not_believed() {
        // Planes that meet at a small angle, far from the edge.
        let (n, m) = (DVec3::new(0.0, 1e-3, 1.0).normalize(), DVec3::Z);
        let (a, b) = (planes(&[n, DVec3::X]), planes(&[m, DVec3::X]));
        let edge = DVec3::new(0.0, 0.0, 1.0);
        let (y, _) = best(a, b, edge);
        assert!(y == DVec3::ZERO || y == edge || y == edge * 0.5, "{y}");
        let nothing = Symmetric::default();
        assert_eq!(best(nothing, nothing, edge).0, edge * 0.5);
    }
}
