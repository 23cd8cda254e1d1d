//! Which faces look against the original? Those whose normals point away from every triangle that is
//! nearest to their middles.
//!
//! To find the nearest of all triangles for each face takes as long as a fast simplification. But most
//! faces have no triangle near by that looks another way: it is enough to know some distance that is
//! no less than that of the nearest, and to ask each triangle whose middle is as near as that to it. Only
//! around the faces that are left then the original is sorted.

use crate::collapse::boxes::Boxes;
use crate::collapse::lattice::{Cells, Grid, Lattice};
use crate::collapse::locate::{locate, square};
#[cfg(test)]
use crate::collapse::looks::Least;
use crate::collapse::looks::{Look, Looks};
use crate::collapse::surface::Surface;
use crate::collapse::witness::FARTHER;
use common::math::DVec3;

/// Least size of a cell in terms of how far middles are from the original.
const REACHES: f64 = 1.5;

/// A face of a surface: where and where to it looks.
#[derive(Clone, Copy)]
pub(super) struct Probe {
    pub middle: DVec3,
    pub normal: DVec3,
    /// What the original is not farther than.
    pub reach: f64,
}

/// The faces of a surface that may look against the original: few more than those that do. `near` tells for
/// every point of the surface one of the original's that should be close, `was` for every face which of the
/// original's it was.
pub(super) fn suspects(original: &Grid, surface: &Surface, near: &[u32], was: &[u32]) -> Vec<u32> {
    let probe = |face: usize| probe(original.surface, surface, near, was, face);
    let probes: Vec<Probe> = (0..was.len()).map(probe).collect();
    let against = against(original, &probes);
    let is_suspect = |&face: &usize| {
        let start = near[surface.faces[face].corners()[0] as usize];
        against[face] < f64::INFINITY && !probes[face].looks_along(original.surface, start, against[face])
    };
    (0..was.len()).filter(is_suspect).map(|face| face as u32).collect()
}

#[inline(always)]
fn probe(original: &Surface, surface: &Surface, near: &[u32], was: &[u32], face: usize) -> Probe {
    let [a, b, c] = surface.faces[face].corners();
    let (middle, normal) = middle([surface.at(a), surface.at(b), surface.at(c)]);
    let start = original.at(near[a as usize]).distance_squared(middle);
    let reach = Triangle::of(original, was[face]).square(middle).min(start).sqrt() * FARTHER;
    Probe { middle, normal, reach }
}

/// For every probe the squared distance of what is nearest of all that looks against it, infinite if there is
/// nothing of that kind within reach.
fn against(original: &Grid, probes: &[Probe]) -> Vec<f64> {
    let mean_reach = probes.iter().map(|probe| probe.reach).sum::<f64>() / probes.len() as f64;
    let lattice = original.coarser(REACHES * mean_reach);
    let boxes = Boxes::new(lattice, probes.len(), |i| probes[i].cells(&lattice));
    let looks = Looks::new(lattice, probes);
    let mut against = vec![f64::INFINITY; probes.len()];
    for (i, face) in original.surface.faces.iter().enumerate() {
        let (face, look) = (i as u32, Look::of(face.look()));
        let mut triangle = None;
        let ask = |probe: u32| {
            let triangle = triangle.get_or_insert_with(|| Triangle::of(original.surface, face));
            if let Some(square) = probes[probe as usize].against(triangle) {
                let nearest = &mut against[probe as usize];
                *nearest = nearest.min(square);
            }
        };
        boxes.near(&original.cells(&lattice, face), |slot| looks.all_along(slot, &look), ask);
    }
    against
}

/// Bytes that are held while one looks for suspects among so many faces, if each is in two cells.
#[cfg(test)]
pub(super) fn bytes(original: &Grid, faces: usize) -> usize {
    let each_slot = size_of::<Least>() + 2 * size_of::<u32>();
    let each_face = size_of::<Probe>() + size_of::<f64>() + 2 * size_of::<u32>();
    original.bytes() + original.coarser(0.0).slots() * each_slot + faces * each_face
}

impl Probe {
    /// The box around what is within its reach.
    #[inline(always)]
    fn around(&self) -> (DVec3, DVec3) {
        (self.middle - self.reach, self.middle + self.reach)
    }

    /// The cells that it meets.
    #[inline(always)]
    pub(super) fn cells(&self, lattice: &Lattice) -> Cells {
        let (low, high) = self.around();
        lattice.cells(low, high)
    }

    /// The squared distance of a triangle if it is within reach and looks the other way.
    #[inline(always)]
    fn against(&self, triangle: &Triangle) -> Option<f64> {
        if triangle.normal.dot(self.normal) >= 0.0 {
            return None;
        }
        let reach2 = self.reach * self.reach * FARTHER;
        let above = triangle.normal.dot(self.middle - triangle.corners[0]);
        if above * above > reach2 * FARTHER * triangle.normal.length_squared() {
            return None;
        }
        Some(triangle.square(self.middle)).filter(|square| *square <= reach2)
    }

    /// Whether it is known at a glance that something along which it looks is as near as what is not.
    fn looks_along(&self, original: &Surface, start: u32, against: f64) -> bool {
        let (square, landing) = locate(original, start, self.middle);
        square <= against && original.normal(landing.face as usize).dot(self.normal) >= 0.0
    }
}

/// A face of the original.
pub(super) struct Triangle {
    /// Where its corners are.
    pub corners: [DVec3; 3],
    /// As long as twice the area.
    pub normal: DVec3,
}

impl Triangle {
    #[inline(always)]
    pub(super) fn of(original: &Surface, face: u32) -> Self {
        let corners = original.faces[face as usize].corners().map(|p| original.at(p));
        Self { corners, normal: middle(corners).1 }
    }

    /// Squared distance to a point.
    #[inline(always)]
    pub(super) fn square(&self, p: DVec3) -> f64 {
        square(p, self.corners)
    }
}

/// Middle and normal of a triangle.
pub(super) fn middle([a, b, c]: [DVec3; 3]) -> (DVec3, DVec3) {
    ((a + b + c) / 3.0, (b - a).cross(c - a))
}
