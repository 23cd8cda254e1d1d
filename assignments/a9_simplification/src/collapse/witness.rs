//! The faces of an original that are near some places, and which of them look along a normal.

use crate::collapse::against::{Triangle, middle};
use crate::collapse::around::Faces;
use crate::collapse::nearby::Nearby;
use common::math::lanes::LANES;
use common::math::{DVec3, Vec3};
use common::simd::{self, dispatch};

/// How much farther one looks than one need, lest rounding leave something out.
pub(super) const FARTHER: f64 = 1.0 + 1e-9;

/// An original whose faces are sorted.
pub(super) struct Witness<'a>(pub &'a Nearby<'a>);

/// What of the original is near the middle of a triangle.
pub(super) struct Vicinity {
    middle: DVec3,
    /// What the nearest is not farther than.
    farthest: f64,
    /// How far the middle may move, and all that is near it is still there.
    room: f64,
    /// Triangles by how far they are, nearest first.
    near: Vec<(f64, Triangle)>,
}

impl Witness<'_> {
    /// Every face that is within reach of a place, and others, by their numbers.
    fn faces_near(&self, at: DVec3, reach: f64) -> Vec<u32> {
        let mut found = Vec::new();
        dispatch!(simd::level(), s => self.0.near(s, (at, reach), Vec3::ZERO, |face| found.push(face)));
        found.sort_unstable();
        found.dedup();
        found
    }

    /// What is not farther than `reach` from a place, by how far it is.
    fn within(&self, p: DVec3, reach: f64) -> Vec<(f64, Triangle)> {
        let (original, found) = (self.0.surface, self.faces_near(p, reach));
        let (mut half_edges, mut near) = (found.into_iter().map(|face| 4 * face), Vec::new());
        loop {
            let faces = Faces::of(original, &mut half_edges);
            let squares = dispatch!(simd::level(), s => faces.nearest(s, original.scale, p)).squares;
            for (square, face) in squares.into_iter().zip(faces.numbers).take(faces.count) {
                let distance = square.sqrt();
                if distance <= reach {
                    near.push((distance, Triangle::of(original, face)));
                }
            }
            if faces.count < LANES {
                break;
            }
        }
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        near
    }

    /// Sees to it that the middle has room to move so far.
    pub(super) fn widen(&self, vicinity: &mut Vicinity, room: f64) {
        if room > vicinity.room || vicinity.near.is_empty() {
            vicinity.room = room;
            vicinity.near = self.within(vicinity.middle, (vicinity.farthest + 2.0 * room) * FARTHER);
        }
    }

    /// Whether a triangle looks along something of all that is nearest to its middle, which is not farther
    /// than `farthest`.
    pub(super) fn agrees(&self, corners: [DVec3; 3], farthest: f64) -> bool {
        let mut vicinity = Vicinity::of(middle(corners).0, farthest);
        self.widen(&mut vicinity, 0.0);
        vicinity.agrees(corners)
    }

    /// Middles of the original's faces that are in a box, in the order of their numbers.
    pub(super) fn middles_within(&self, low: DVec3, high: DVec3) -> Vec<DVec3> {
        let (at, reach) = ((low + high) / 2.0, low.distance(high) / 2.0);
        let faces = self.faces_near(at, reach).into_iter();
        let middles = faces.map(|face| middle(self.0.surface.places(face as usize)).0);
        middles.filter(|middle| middle.cmpge(low).all() && middle.cmple(high).all()).collect()
    }
}

impl Vicinity {
    /// Of a place, with nothing near as yet.
    pub(super) fn of(middle: DVec3, farthest: f64) -> Self {
        Self { middle, farthest, room: 0.0, near: Vec::new() }
    }

    /// Whether a triangle looks along something of all that is nearest to its middle, which has moved no
    /// farther than there is room.
    pub(super) fn agrees(&self, corners: [DVec3; 3]) -> bool {
        let (middle, normal) = middle(corners);
        let moved = middle.distance(self.middle) * FARTHER;
        // Distances are no better than coordinates.
        let rounding = 8.0 * f64::EPSILON * middle.abs().max_element();
        let [mut along, mut against] = [f64::INFINITY; 2];
        for (distance, triangle) in &self.near {
            if *distance > along.min(against) * FARTHER + moved + rounding {
                break;
            }
            let best = if triangle.normal.dot(normal) < 0.0 { &mut against } else { &mut along };
            *best = best.min(triangle.square(middle).sqrt());
        }
        along <= against + rounding
    }
}
