//! Which faces look against the original? Those whose normals point away from every triangle that is
//! nearest to their middles.
//!
//! To find the nearest of all triangles for each face takes as long as a fast simplification. But most
//! faces have no triangle near by that looks another way: it is enough to know some distance that is
//! no less than that of the nearest, and to look for such triangles within it.

use crate::collapse::boxes::Boxes;
use crate::collapse::locate::{locate, nearest};
use crate::collapse::surface::Surface;
use common::math::{DVec3, Vec3};

/// Size of a cell, in sides of the original's triangles.
const CELL: f64 = 1.0;
/// More than the error of a cosine in single precision.
const ROUNDING: f32 = 1e-5;
/// How much farther one looks than one need, lest rounding leave something out.
const FARTHER: f64 = 1.0 + 1e-9;

/// An original that knows which of its faces are near.
pub(super) struct Witness<'a> {
    original: &'a Surface,
    boxes: Boxes,
    /// Unit normals, or zero, to be rid of most faces quickly.
    normals: Vec<Vec3>,
    /// Side of a cell.
    cell: f64,
}

impl<'a> Witness<'a> {
    /// Sorts the original's faces.
    pub(super) fn new(original: &'a Surface) -> Self {
        let of = |i: usize| {
            let [a, b, c] = original.faces[i].corners();
            let (a, b, c) = (original.at(a), original.at(b), original.at(c));
            (a.min(b).min(c), a.max(b).max(c))
        };
        let cell = CELL * mean_side(original);
        let normal = |i: usize| original.normal(i).normalize_or_zero().as_vec3();
        let normals = (0..original.faces.len()).map(normal).collect();
        Self { original, boxes: Boxes::new(original.faces.len(), cell, of), normals, cell }
    }

    /// Bytes that are held.
    #[cfg(test)]
    pub(super) fn bytes(&self) -> usize {
        self.boxes.bytes() + self.normals.capacity() * size_of::<Vec3>()
    }

    /// The faces that look against the original. `near` tells for every point of the surface one of the
    /// original's that should be close, `was` for every face which of the original's it was.
    pub(super) fn disputes(&self, surface: &Surface, near: &[u32], was: &[u32]) -> Vec<u32> {
        let agrees = |face: usize| {
            let [a, b, c] = surface.faces[face].corners();
            let corners = [surface.at(a), surface.at(b), surface.at(c)];
            let (middle, normal) = middle(corners);
            let start = near[a as usize];
            let far = self.square(was[face], middle).min(self.original.at(start).distance_squared(middle));
            self.none_against(middle, normal, far) || self.agrees(start, corners)
        };
        (0..surface.faces.len()).filter(|&face| !agrees(face)).map(|face| face as u32).collect()
    }

    /// Whether it is known at a glance that nothing within √`far` looks against a normal.
    fn none_against(&self, p: DVec3, normal: DVec3, far: f64) -> bool {
        let (reach, mut none) = (far.sqrt() * FARTHER, true);
        if reach > self.cell {
            return false;
        }
        let quickly = normal.normalize_or_zero().as_vec3();
        self.boxes.near(p - reach, p + reach, |face| {
            if self.normals[face as usize].dot(quickly) < ROUNDING {
                let looks_along = self.original.normal(face as usize).dot(normal) >= 0.0;
                none &= looks_along || self.square(face, p) > far * FARTHER;
            }
        });
        none
    }

    /// Whether a triangle looks along something of all that is nearest to its middle; one looks for that around
    /// `start` first.
    pub(super) fn agrees(&self, start: u32, corners: [DVec3; 3]) -> bool {
        let (middle, normal) = middle(corners);
        let farthest = locate(self.original, start, middle).0.sqrt() * FARTHER;
        let mut reach = farthest.min(self.cell);
        let [along, against] = loop {
            let nearest = self.nearest(middle, normal, reach);
            let found = nearest.iter().any(|square| square.sqrt() <= reach);
            if found || reach >= farthest {
                break nearest;
            }
            reach = farthest.min(2.0 * reach);
        };
        // Distances are no better than coordinates.
        along.sqrt() <= against.sqrt() + 8.0 * f64::EPSILON * middle.abs().max_element()
    }

    /// Squared distances of the nearest face that looks along a normal and of the nearest that looks
    /// against it, among those within a distance and a few more; infinite if there is none.
    fn nearest(&self, p: DVec3, normal: DVec3, reach: f64) -> [f64; 2] {
        let mut best = [f64::INFINITY; 2];
        self.boxes.near(p - reach, p + reach, |face| {
            let best = &mut best[usize::from(self.original.normal(face as usize).dot(normal) < 0.0)];
            *best = best.min(self.square(face, p));
        });
        best
    }

    /// Middles of the original's faces that are in a box, in the order of their numbers.
    pub(super) fn middles_within(&self, low: DVec3, high: DVec3) -> Vec<DVec3> {
        let mut found = Vec::new();
        self.boxes.near(low, high, |face| found.push(face));
        found.sort_unstable();
        found.dedup();
        let corners = |face: u32| self.original.faces[face as usize].corners().map(|p| self.original.at(p));
        let middles = found.into_iter().map(|face| middle(corners(face)).0);
        middles.filter(|p| p.cmpge(low).all() && p.cmple(high).all()).collect()
    }

    /// Squared distance to a face of the original.
    #[inline(always)]
    fn square(&self, face: u32, p: DVec3) -> f64 {
        let [a, b, c] = self.original.faces[face as usize].corners();
        let (a, b, c) = (self.original.at(a), self.original.at(b), self.original.at(c));
        let [u, v, w] = nearest(p, a, b, c);
        (a * u + b * v + c * w).distance_squared(p)
    }
}

fn middle([a, b, c]: [DVec3; 3]) -> (DVec3, DVec3) {
    ((a + b + c) / 3.0, (b - a).cross(c - a))
}

/// Mean length of some sides.
fn mean_side(surface: &Surface) -> f64 {
    let stride = 1 + surface.faces.len() / 1000;
    let side = |[a, b, _]: [u32; 3]| (surface.at(a) - surface.at(b)).length();
    let sides = surface.faces.iter().step_by(stride);
    sides.map(|face| side(face.corners())).sum::<f64>() * stride as f64 / surface.faces.len().max(1) as f64
}
