//! Quadrics of the triangles that are there now: nothing is remembered of those that were.
//!
//! After Lindstrom & Turk 1998, "Fast and memory efficient polygonal simplification". All planes
//! of a point's triangles go through the point, so that its quadric is a 3×3 matrix about itself.
//! A step changes the triangles of the points around it; what they lose and gain is known from
//! checking the step, and so nothing is ever summed up anew.

use crate::collapse::knob::knob;
use crate::collapse::engine::{Cost, Offer};
use crate::collapse::quadric::Symmetric;
use crate::collapse::ring::Ring;
use crate::collapse::surface::{NONE, Surface, previous};
use common::math::DVec3;
use common::simd::prefetch;

/// How much the edge of a boundary counts, in terms of triangles of about its size.
const BOUNDARY: f64 = 4.0;
/// Share of the trace by which a minimum must be determined; in directions in which it is less, the
/// middle of the edge decides.
const LEAST_RANK: f64 = 1e-9;
/// How much the length of the edge counts.
fn shape() -> f64 { knob("SHAPE", 1e-5) }

/// For every point the sum over its triangles of √area times the squared distance to the plane.
///
/// The area itself gives a root mean square that is one part in fifty less, and spots that are
/// half as far off again.
pub(super) struct Memoryless {
    of: Vec<Symmetric>,
    shape: f64,
}

/// √area·n·nᵀ for a normal as long as twice the area, up to a factor.
#[inline(always)]
fn plane(normal: DVec3) -> Symmetric {
    let length2 = normal.length_squared();
    // Of normals whose square underflows nothing is left to count.
    let root = length2.sqrt().sqrt();
    Symmetric::outer(normal, if length2 > 0.0 { 1.0 / (root * root * root) } else { 0.0 })
}

/// The same for the edge of a boundary: length times the squared distance to its line.
fn line(edge: DVec3) -> Symmetric {
    let length = edge.length();
    Symmetric::line(edge, if length > 0.0 { BOUNDARY / length } else { 0.0 })
}

impl Memoryless {
    /// Of all points of a surface.
    pub(super) fn new(surface: &Surface) -> Self {
        let mut of = vec![Symmetric::default(); surface.points.len()];
        for (i, face) in surface.faces.iter().enumerate() {
            let plane = plane(surface.normal(i));
            for (corner, point) in face.corners().into_iter().enumerate() {
                of[point as usize] += plane;
                let h = 4 * i as u32 + corner as u32;
                if surface.twin(h) == NONE {
                    let end = surface.end(h);
                    let line = line(surface.at(end) - surface.at(point));
                    of[point as usize] += line;
                    of[end as usize] += line;
                }
            }
        }
        Self { of, shape: shape() }
    }

    /// Sums up anew for a point on the boundary, whose edges changed.
    #[cold]
    fn renew(&mut self, surface: &Surface, point: u32) {
        let from = surface.at(point);
        let mut sum = Symmetric::default();
        for h in surface.fan(point) {
            let [p, q] = [surface.end(h), surface.start(previous(h))].map(|p| surface.at(p) - from);
            sum += plane(p.cross(q));
            if surface.twin(h) == NONE {
                sum += line(p);
            }
            if surface.turn(h) == NONE {
                sum += line(q);
            }
        }
        self.of[point as usize] = sum;
    }
}

impl Cost for Memoryless {
    #[inline(always)]
    fn prefetch(&self, point: u32) {
        prefetch(&self.of[point as usize..]);
    }

    #[inline(always)]
    fn price(&self, surface: &Surface, h: u32) -> Offer {
        let (start, end) = (surface.start(h), surface.end(h));
        let (a, b) = (&self.of[start as usize], &self.of[end as usize]);
        let from = surface.at(start);
        let edge = surface.at(end) - from;
        let mut sum = *a + *b;
        let trace = sum.trace();
        sum.add_diagonal(LEAST_RANK * trace);
        let y = sum.solve(b.times(edge) + edge * (0.5 * LEAST_RANK * trace));
        let error = |y: DVec3| a.square(y) + b.square(y - edge);
        let length2 = edge.length_squared();
        let far = 4.0 * length2;
        // Also false if there was no solution.
        let near = y.length_squared() < far && (y - edge).length_squared() < far;
        let (y, cost) = if near { (y, error(y)) } else { on_edge(edge, error) };
        Offer { cost: cost + self.shape * trace * length2, place: from + y }
    }

    fn collapsed(&mut self, surface: &Surface, ring: &Ring, kept: u32) {
        let mut sum = Symmetric::default();
        for face in &ring.stays {
            let after = plane(face.after);
            let before = plane(face.before);
            sum += after;
            for point in face.points {
                let of = &mut self.of[point as usize];
                *of += after;
                *of -= before;
            }
        }
        self.of[kept as usize] = sum;
        for face in &ring.vanishes {
            self.of[face.opposite as usize] -= plane(face.normal);
        }
        if surface.on_boundary(kept) {
            let first = surface.points[kept as usize].out;
            let last = surface.fan(kept).last().map_or(first, previous);
            for point in [kept, surface.end(first), surface.start(last)] {
                self.renew(surface, point);
            }
        }
    }
}

/// The best of both ends and the middle.
#[cold]
fn on_edge(edge: DVec3, error: impl Fn(DVec3) -> f64) -> (DVec3, f64) {
    let tried = [0.5, 0.0, 1.0].map(|t| (edge * t, error(edge * t)));
    tried.into_iter().min_by(|a, b| a.1.total_cmp(&b.1)).expect("three were tried")
}
