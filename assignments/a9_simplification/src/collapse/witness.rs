//! The faces of an original that are near some places, and which of them look along a normal.

use crate::collapse::against::{Triangle, middle};
use crate::collapse::around::Faces;
use crate::collapse::boxes::Boxes;
use crate::collapse::lattice::{Cells, Grid, Lattice};
use crate::collapse::surface::Surface;
use common::math::DVec3;
use common::math::lanes::LANES;
use common::simd::{self, dispatch};

/// Cells along a side of a place.
const CELLS: f64 = 3.0;
/// The same for cells in which faces are looked for.
const FINER: f64 = 8.0;
/// Slots for each face.
const SLOTS: usize = 2;
/// How much farther one looks than one need, lest rounding leave something out.
pub(super) const FARTHER: f64 = 1.0 + 1e-9;

/// The faces of an original that are near some places.
pub(super) struct Witness<'a> {
    original: &'a Surface,
    /// The slots of cells of which all faces are known; empty if all are.
    known: Vec<bool>,
    coarse: Lattice,
    /// Faces that are known, and their boxes.
    faces: Vec<u32>,
    lattice: Lattice,
    boxes: Boxes,
}

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

impl<'a> Witness<'a> {
    /// Of what is in some boxes, given by their lowest and highest corners, and in cells that they meet.
    pub(super) fn around(original: &Grid<'a>, places: Vec<(DVec3, DVec3)>) -> Self {
        let sizes: f64 = places.iter().map(|&(low, high)| (high - low).max_element()).sum();
        let size = sizes / places.len() as f64;
        let coarse = original.coarser(size / CELLS);
        let known = marked(&coarse, &places);
        let all = 0..original.surface.faces.len() as u32;
        let faces: Vec<u32> =
            all.filter(|&face| meets(&coarse, &known, &original.cells(&coarse, face))).collect();
        let lattice = original.coarser(size / FINER).with_slots(SLOTS * faces.len());
        let boxes = Boxes::new(lattice, faces.len(), |i| original.cells(&lattice, faces[i]), |_| true);
        Self { original: original.surface, coarse, known, faces, lattice, boxes }
    }

    /// Calls `what` with every face that meets a box, with some more than once, and with others.
    #[inline(always)]
    fn near(&self, low: DVec3, high: DVec3, mut what: impl FnMut(u32)) {
        if knows(&self.coarse, &self.known, &self.coarse.cells(low, high)) {
            self.boxes.near(&self.lattice.cells(low, high), |i| what(self.faces[i as usize]));
        } else {
            self.far_off(&mut what);
        }
    }

    #[cold]
    #[inline(never)]
    fn far_off(&self, what: &mut dyn FnMut(u32)) {
        (0..self.original.faces.len() as u32).for_each(what);
    }

    /// Every face that meets a box, and others, by their numbers.
    fn faces_near(&self, low: DVec3, high: DVec3) -> Vec<u32> {
        let mut found = Vec::new();
        self.near(low, high, |face| found.push(face));
        found.sort_unstable();
        found.dedup();
        found
    }

    /// What is not farther than `reach` from a place, by how far it is.
    fn within(&self, p: DVec3, reach: f64) -> Vec<(f64, Triangle)> {
        let found = self.faces_near(p - reach, p + reach);
        let (mut half_edges, mut near) = (found.into_iter().map(|face| 4 * face), Vec::new());
        loop {
            let faces = Faces::of(self.original, &mut half_edges);
            let squares = dispatch!(simd::level(), s => faces.nearest(s, self.original.scale, p)).squares;
            for (square, face) in squares.into_iter().zip(faces.numbers).take(faces.count) {
                let distance = square.sqrt();
                if distance <= reach {
                    near.push((distance, Triangle::of(self.original, face)));
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
        let faces = self.faces_near(low, high).into_iter();
        let middles = faces.map(|face| middle(Triangle::of(self.original, face).corners).0);
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

/// The slots of the cells that some boxes meet; none at all if there are too many.
fn marked(lattice: &Lattice, places: &[(DVec3, DVec3)]) -> Vec<bool> {
    let mut marked = vec![false; lattice.slots()];
    for &(low, high) in places {
        let cells = lattice.cells(low, high);
        if cells.are_many() {
            return Vec::new();
        }
        lattice.each(&cells, |slot| marked[slot] = true);
    }
    marked
}

/// Whether all that is in some cells is known.
#[inline(always)]
fn knows(lattice: &Lattice, known: &[bool], cells: &Cells) -> bool {
    let mut all = known.is_empty() || !cells.are_many();
    if all && !known.is_empty() {
        lattice.each(cells, |slot| all &= known[slot]);
    }
    all
}

/// Whether something with these cells may be in a cell that is known.
#[inline(always)]
fn meets(lattice: &Lattice, known: &[bool], cells: &Cells) -> bool {
    let mut any = known.is_empty() || cells.are_many();
    if !any {
        lattice.each(cells, |slot| any |= known[slot]);
    }
    any
}
