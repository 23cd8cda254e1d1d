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
use crate::collapse::looks::{Least, Look, Looks, are_along, bounds};
use crate::collapse::surface::Surface;
use crate::collapse::witness::FARTHER;
use common::math::DVec3;

/// Size of the cells in which one looks closely, in sides of the original's faces.
pub(super) const CELL: f64 = 1.0;

/// Slots for each face of the original.
const SLOTS: usize = 2;

/// Least size of a cell in terms of how far middles are from the original.
const REACHES: f64 = 1.5;

/// Least squared sine of a corner at which weights are not lost by rounding …
const LEAST_SINE2: f64 = 1e-4;
/// … of more than this share.
const ROUNDING: f64 = 1e-6;

/// A face of a surface: where and where to it looks.
#[derive(Clone, Copy)]
pub(super) struct Probe {
    pub middle: DVec3,
    pub normal: DVec3,
    /// What the original is not farther than.
    pub reach: f64,
    /// The cells that what is within its reach can be in, as long as that is asked.
    pub cells: Cells,
    /// Bounds of its normal, likewise.
    pub least: Least,
}

/// The faces of a surface that may look against the original: few more than those that do. `near` tells for
/// every point of the surface one of the original's that should be close, `was` for every face which of the
/// original's it was.
pub(super) fn suspects(original: &Surface, surface: &Surface, near: &[u32], was: &[u32]) -> Vec<u32> {
    let probe = |face: usize| probe(original, surface, near, was, face);
    let mut probes: Vec<Probe> = (0..was.len()).map(probe).collect();
    let against = against(&Grid::new(original, CELL), &mut probes);
    let is_suspect = |&face: &usize| {
        let start = near[surface.faces[face].corners()[0] as usize];
        against[face] < f64::INFINITY && !probes[face].looks_along(original, start, against[face])
    };
    (0..was.len()).filter(is_suspect).map(|face| face as u32).collect()
}

fn mean_reach(probes: &[Probe]) -> f64 {
    probes.iter().map(|probe| probe.reach).sum::<f64>() / probes.len() as f64
}

#[inline(always)]
fn probe(original: &Surface, surface: &Surface, near: &[u32], was: &[u32], face: usize) -> Probe {
    let a = surface.faces[face].corners()[0];
    let (middle, normal) = middle(surface.places(face));
    let triangle = Triangle::of(original, was[face]);
    let square = triangle.square_above(middle).unwrap_or_else(|| {
        let start = original.at(near[a as usize]).distance_squared(middle);
        triangle.square(middle).min(start)
    });
    Probe { middle, normal, reach: square.sqrt() * FARTHER, cells: Cells::default(), least: Least::default() }
}

/// For every probe the squared distance of what is nearest of all that looks against it, infinite if there is
/// nothing of that kind within reach.
fn against(original: &Grid, probes: &mut [Probe]) -> Vec<f64> {
    let lattice =
        original.coarser(REACHES * mean_reach(probes)).with_slots(SLOTS * original.surface.faces.len());
    let mut looks = Looks::new(lattice);
    for probe in &mut *probes {
        (probe.cells, probe.least) = (probe.around(&lattice), bounds(probe.normal));
        looks.add(&probe.cells, &probe.least);
    }
    let Asking { faces, slots } = Asking::of(original, &lattice, &looks);
    let boxes = Boxes::new(lattice, probes.len(), |i| probes[i].cells, |slot| slots[slot]);
    let mut against = vec![f64::INFINITY; probes.len()];
    for face in faces {
        let look = Look::of(original.surface.faces[face as usize].look());
        boxes.near(&original.cells(&lattice, face), |i| {
            let probe = &probes[i as usize];
            if !are_along(&probe.least, &look)
                && let Some(square) = probe.against(&Triangle::of(original.surface, face))
            {
                let nearest = &mut against[i as usize];
                *nearest = nearest.min(square);
            }
        });
    }
    against
}

/// The faces of an original that may look against some of what is near them, and in which slots.
struct Asking {
    faces: Vec<u32>,
    slots: Vec<bool>,
}

impl Asking {
    fn of(original: &Grid, lattice: &Lattice, looks: &Looks) -> Self {
        let (mut faces, mut slots) = (Vec::new(), vec![false; lattice.slots()]);
        for (i, face) in (0..).zip(&original.surface.faces) {
            let (cells, look) = (original.cells(lattice, i), Look::of(face.look()));
            let mut asks = looks.anywhere || cells.are_many();
            looks.not_along(&cells, &look, |slot| (asks, slots[slot]) = (true, true));
            if asks {
                faces.push(i);
            }
        }
        Self { faces, slots }
    }
}

/// Bytes that are held while one looks for suspects among so many faces, if each is in two cells.
#[cfg(test)]
pub(super) fn bytes(original: &Grid, faces: usize) -> usize {
    let each_slot = size_of::<Least>() + size_of::<u32>() + size_of::<bool>();
    let each_face = size_of::<Probe>() + size_of::<f64>() + 2 * size_of::<u32>();
    let slots = original.coarser(0.0).with_slots(SLOTS * original.surface.faces.len()).slots();
    original.bytes() + slots * each_slot + faces * each_face
}

impl Probe {
    /// The cells of what is within its reach.
    #[inline(always)]
    pub(super) fn around(&self, lattice: &Lattice) -> Cells {
        lattice.cells(self.middle - self.reach, self.middle + self.reach)
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
        let corners = original.places(face as usize);
        Self { corners, normal: middle(corners).1 }
    }

    /// Squared distance to a point that is surely above the inside of the triangle, or below; no sliver has such.
    #[inline(always)]
    fn square_above(&self, p: DVec3) -> Option<f64> {
        let [a, b, c] = self.corners;
        let (u, v, w) = (b - a, c - a, p - a);
        let (uu, uv, vv, uw, vw) = (u.dot(u), u.dot(v), v.dot(v), u.dot(w), v.dot(w));
        // Weights of b and c, and of all three, up to a factor.
        let (of_b, of_c, all) = (vv * uw - uv * vw, uu * vw - uv * uw, uu * vv - uv * uv);
        let least = ROUNDING * all;
        let is_above =
            all > LEAST_SINE2 * uu * vv && of_b > least && of_c > least && of_b + of_c < all - least;
        let above = self.normal.dot(w);
        is_above.then(|| above * above / self.normal.length_squared())
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
