//! Quadrics of the triangles that are there now: nothing is remembered of those that were.
//!
//! After Lindstrom & Turk 1998, "Fast and memory efficient polygonal simplification". All planes
//! of a point's triangles go through the point, so that its quadric is a 3×3 matrix about itself.
//! A step changes the triangles of the points around it; what they lose and gain is known from
//! checking the step, and so nothing is ever summed up anew.

use crate::collapse::abreast::{Edges, price_all};
use crate::collapse::cost::{Cost, LEAST_RANK, Merge, Offer, cheapest};
use crate::collapse::quadric::Symmetric;
use crate::collapse::queue::Queue;
use crate::collapse::ring::Ring;
use crate::collapse::surface::{NONE, Surface, previous};
use common::math::DVec3;
use common::math::lanes::{LANES, subtract};
use common::simd::{self, Simd, dispatch, prefetch};

/// How much the edge of a boundary counts, in terms of triangles of about its size.
const BOUNDARY: f64 = 4.0;

/// How much the squared length of an edge counts, in terms of the planes at its ends: a bend of a few ten-thousandths of
/// it is dearer than that, so that what is flat goes first, in however large faces. With less faces become steep.
const SHAPE: f64 = 1e-7;

/// For every point the sum over its triangles of √area times the squared distance to the plane.
///
/// The area itself gives a root mean square that is one part in fifty less, and spots that are
/// half as far off again.
#[derive(Clone)]
pub(super) struct Memoryless {
    of: Vec<Symmetric>,
}

/// √area·n·nᵀ for a normal as long as twice the area, up to a factor.
#[inline(always)]
pub(super) fn plane(normal: DVec3) -> Symmetric {
    let length2 = normal.length_squared();
    // Of normals whose square underflows nothing is left to count.
    let root = length2.sqrt().sqrt();
    Symmetric::outer(normal, if length2 > 0.0 { 1.0 / (root * root * root) } else { 0.0 })
}

/// The same for the edge of a boundary: length times the squared distance to its line.
pub(super) fn line(edge: DVec3) -> Symmetric {
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
        Self { of }
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

impl Memoryless {
    /// What eight edges cost; no number where [`Cost::price`] must tell.
    #[inline(always)]
    fn price_eight<S: Simd>(&self, simd: S, surface: &Surface, edges: &[u32; LANES]) -> [f64; LANES] {
        let edges = Edges::new(surface, edges);
        let [p, q] = edges.of_ends(|point| &self.of[point as usize].0);
        let edge = edges.along(simd);
        let [a, b] = [p.matrices(simd), q.matrices(simd)];
        let sum = a.plus(&b);
        let y = sum.least(simd, b.times(edge), edge, LEAST_RANK);
        let error = a.square(y) + b.square(subtract(y, edge));
        sum.costs(simd, edge, y, error, SHAPE)
    }
}

impl Cost for Memoryless {
    type Line = Queue;

    #[inline(always)]
    fn prefetch(&self, point: u32) {
        prefetch(&self.of[point as usize..]);
    }

    #[inline(always)]
    fn price(&self, surface: &Surface, h: u32) -> Offer {
        let [a, b] = [surface.start(h), surface.end(h)].map(|point| &self.of[point as usize]);
        cheapest(surface, h, SHAPE, |edge| (*a + *b, b.times(edge)), |y, z| a.square(y) + b.square(z))
    }

    fn price_all(&self, surface: &Surface, what: impl FnMut(u32, f64)) {
        let eight = |edges: &[u32; LANES]| dispatch!(simd::level(), s => self.price_eight(s, surface, edges));
        price_all(surface, eight, |h| self.price(surface, h).cost, what);
    }

    fn let_go(&mut self) {
        self.of = Vec::new();
    }

    #[cfg(test)]
    fn bytes(&self) -> usize {
        self.of.capacity() * size_of::<Symmetric>()
    }

    fn merged(&mut self, surface: &Surface, ring: &Ring, merge: &Merge) {
        let kept = merge.kept;
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
