//! Length times curvature (Melax 1998, "A simple, fast, and effective polygon reduction
//! algorithm"): the version to read first.
//!
//! An edge goes by drawing one of its ends to the other. That hurts in proportion to its length
//! and to how much the surface bends there: each triangle at the end that moves should have one
//! beside the edge that looks nearly the same way. No quadrics, no systems of equations, nothing
//! remembered.

use crate::collapse::cost::{Cost, Merge, Offer};
use crate::collapse::heap::Heap;
use crate::collapse::ring::Ring;
use crate::collapse::surface::{NONE, Surface, previous};
use common::math::DVec3;

/// Melax's cost; it needs to know nothing but the surface.
#[derive(Clone, Copy)]
pub(super) struct Curvature;

impl Cost for Curvature {
    type Line = Heap;

    fn prefetch(&self, _: u32) {}

    fn price(&self, surface: &Surface, h: u32) -> Offer {
        let (start, end) = (surface.start(h), surface.end(h));
        let length = (surface.at(end) - surface.at(start)).length();
        let [start_moves, end_moves] = [start, end].map(|moves| length * curvature(surface, moves, h));
        if end_moves <= start_moves {
            Offer { cost: end_moves, place: surface.at(start) }
        } else {
            Offer { cost: start_moves, place: surface.at(end) }
        }
    }

    /// Nothing: one learns more from the plain method.
    fn lost(_: &Ring, _: [DVec3; 2], _: DVec3) -> f64 {
        0.0
    }

    #[cfg(test)]
    fn bytes(&self) -> usize {
        0
    }

    fn merged(&mut self, _: &Surface, _: &Ring, _: &Merge) {}
}

/// How much the surface bends if `moves` goes along the edge of `h`: for each face there the least
/// angle to a face at the edge, of these the largest; 0 if flat, 1 if one turns over.
fn curvature(surface: &Surface, moves: u32, h: u32) -> f64 {
    let at_edge = [h, surface.twin(h)].map(|h| (h != NONE).then(|| look(surface, h)));
    if surface.on_boundary(moves) {
        return boundary_curvature(surface, moves, h);
    }
    let bend = |spoke: u32| {
        let normal = look(surface, spoke);
        at_edge.iter().flatten().map(|side| (1.0 - normal.dot(*side)) / 2.0).fold(1.0, f64::min)
    };
    surface.fan(moves).map(bend).fold(0.0, f64::max)
}

/// On the boundary what bends is the boundary: 0 if it goes straight on, 1 if it turns back.
fn boundary_curvature(surface: &Surface, moves: u32, h: u32) -> f64 {
    if surface.twin(h) != NONE {
        return 1.0;
    }
    let first = surface.points[moves as usize].out;
    let last = surface.fan(moves).last().map_or(first, previous);
    let from = surface.at(moves);
    let [p, q] =
        [surface.end(first), surface.start(last)].map(|p| (surface.at(p) - from).normalize_or_zero());
    (1.0 + p.dot(q)) / 2.0
}

fn look(surface: &Surface, h: u32) -> DVec3 {
    surface.normal((h >> 2) as usize).normalize_or_zero()
}
