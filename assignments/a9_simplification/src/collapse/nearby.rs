//! The faces of a surface in cubic cells: which are near a place, and do not look where one looks oneself?

use crate::collapse::lattice::{Cell, Lattice, between};
use crate::collapse::surface::{Face, NONE, Surface};
use common::math::lanes::LANES;
use common::math::{DVec3, Vec3};
use common::simd::{Simd, SimdBase, SimdMask, f32x8};

/// Side of a cell, in mean sides of the faces …
const SIDES: f64 = 2.5;
/// … or in terms of how far one looks.
const REACHES: f64 = 1.5;
/// Places are rounded to single precision, in units of about the box: more than is lost of a distance.
const ROUNDING: f32 = 2e-6;
/// More than what is lost of a cosine where a normal is rounded to 1/511, times 511.
const LOST: f32 = 1.6;

/// The faces of a surface, sorted by cells.
pub(super) struct Nearby<'a> {
    /// The surface.
    pub surface: &'a Surface,
    origin: DVec3,
    lattice: Lattice,
    /// What is in the cells of slot i is in lanes `first[i]..first[i + 1]`.
    first: Vec<u32>,
    faces: Vec<[u32; LANES]>,
    /// Where their middles are, how far they reach from there, and where they look.
    columns: Vec<[[f32; LANES]; 7]>,
    /// Those that meet many cells.
    large: Vec<u32>,
}

impl<'a> Nearby<'a> {
    /// Of a surface; one will look about as far as `reach`.
    pub(super) fn new(surface: &'a Surface, reach: f64) -> Self {
        let origin = if surface.points.is_empty() { DVec3::ZERO } else { surface.at(0) };
        let lattice = Lattice::new((SIDES * mean_side(surface)).max(REACHES * reach), surface.faces.len());
        let place = |point: u32| (surface.at(point) - origin).as_vec3();
        let places: Vec<Vec3> = (0..surface.points.len() as u32).map(place).collect();
        let first = vec![0; lattice.slots() + 1];
        let mut this = Self {
            surface,
            origin,
            lattice,
            first,
            faces: Vec::new(),
            columns: Vec::new(),
            large: Vec::new(),
        };
        let entries = this.entries(&places);
        this.fill(&places, &entries);
        this
    }

    /// Slots and the faces in them, face by face. Counts what is in each slot, and tells where it begins.
    fn entries(&mut self, places: &[Vec3]) -> Vec<(u32, u32)> {
        let cells: Vec<Cell> = places.iter().map(|&place| self.lattice.cell(place)).collect();
        let mut entries = Vec::with_capacity(self.surface.faces.len() * 2);
        for (i, face) in (0..).zip(&self.surface.faces) {
            let [a, b, c] = face.corners();
            let cells = between(cells[a as usize], cells[b as usize], cells[c as usize]);
            if cells.are_many() {
                self.large.push(i);
                continue;
            }
            self.lattice.each_slot(&cells, |slot| {
                self.first[slot] += 1;
                entries.push((slot as u32, i));
            });
        }
        let mut before = 0;
        for first in &mut self.first {
            (*first, before) = (before, before + *first);
        }
        entries
    }

    /// Puts the faces into their slots.
    fn fill(&mut self, places: &[Vec3], entries: &[(u32, u32)]) {
        let blocks = entries.len().div_ceil(LANES);
        self.faces = vec![[0; LANES]; blocks];
        // What is left over of the last eight is a face without size that looks nowhere: it may be told.
        self.columns = vec![[[0.0; LANES]; 7]; blocks];
        let (mut last, mut entry) = (NONE, [0.0; 7]);
        for &(slot, face) in entries {
            if face != last {
                (last, entry) = (face, columns(places, &self.surface.faces[face as usize]));
            }
            let first = &mut self.first[slot as usize];
            let (block, lane) = (*first as usize / LANES, *first as usize % LANES);
            *first += 1;
            self.faces[block][lane] = face;
            let columns = &mut self.columns[block];
            columns.iter_mut().zip(entry).for_each(|(lanes, entry)| lanes[lane] = entry);
        }
        // Each slot has been filled to where the next begins.
        self.first.rotate_right(1);
        self.first[0] = 0;
    }

    /// Calls `what` with every face that meets the cells around a place, as far as one looks, and is not known to look
    /// along a normal, given in terms of its largest component; with some of them more than once, and with others that are
    /// only near. If there is no normal, nothing looks along it.
    #[inline(always)]
    pub(super) fn near<S: Simd>(
        &self,
        simd: S,
        (at, reach): (DVec3, f64),
        normal: Vec3,
        mut what: impl FnMut(u32),
    ) {
        let (p, reach) = ((at - self.origin).as_vec3(), reach as f32 + ROUNDING);
        let cells = self.lattice.cells(p - reach, p + reach);
        if cells.are_many() {
            return (0..self.surface.faces.len() as u32).for_each(what);
        }
        let of = |x: f32| f32x8::splat(simd, x);
        for slot in self.lattice.slots_of(&cells) {
            let (from, to) = (self.first[slot] as usize, self.first[slot + 1] as usize);
            if from == to {
                continue;
            }
            let blocks = from / LANES..to.div_ceil(LANES);
            for (columns, faces) in self.columns[blocks.clone()].iter().zip(&self.faces[blocks]) {
                let lanes = |i: usize| f32x8::from_slice(simd, &columns[i]);
                let (x, y, z, far) =
                    (lanes(0) - of(p.x), lanes(1) - of(p.y), lanes(2) - of(p.z), lanes(3) + of(reach));
                let cosine = lanes(4) * of(normal.x) + lanes(5) * of(normal.y) + lanes(6) * of(normal.z);
                let is_near = (x * x + y * y + z * z).simd_le(far * far);
                let mut found = (is_near & cosine.simd_le(of(LOST))).to_bitmask();
                while found != 0 {
                    what(faces[found.trailing_zeros() as usize]);
                    found &= found - 1;
                }
            }
        }
        self.large.iter().for_each(|&face| what(face));
    }

    /// Bytes that are held for all faces.
    #[cfg(test)]
    pub(super) fn bytes(&self) -> usize {
        4 * (self.first.capacity() + 8 * LANES * self.faces.capacity()) + 28 * self.surface.points.len()
    }
}

/// Where the middle of a face is, how far it reaches from there, and where it looks.
#[inline(always)]
fn columns(places: &[Vec3], face: &Face) -> [f32; 7] {
    let [a, b, c] = face.corners();
    let [a, b, c] = [places[a as usize], places[b as usize], places[c as usize]];
    let middle = (a + b + c) * (1.0 / 3.0);
    let squares = [a.distance_squared(middle), b.distance_squared(middle), c.distance_squared(middle)];
    let reach = squares[0].max(squares[1]).max(squares[2]).sqrt();
    let [u, v, w] = face.look();
    [middle.x, middle.y, middle.z, reach + ROUNDING, f32::from(u), f32::from(v), f32::from(w)]
}

/// Mean length of some sides.
fn mean_side(surface: &Surface) -> f64 {
    let stride = 1 + surface.faces.len() / 1000;
    let side = |[a, b, _]: [u32; 3]| (surface.at(a) - surface.at(b)).length();
    let sides = surface.faces.iter().step_by(stride);
    sides.map(|face| side(face.corners())).sum::<f64>() * stride as f64 / surface.faces.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collapse::locate::square;
    use crate::collapse::scattered::{random, scattered};
    use common::simd::{self, dispatch};

    #[test]
    fn everything_within_reach_that_may_look_elsewhere_is_told() {
        let mut random = random();
        let surface = scattered(400, &mut random);
        let mut told_of = [0, 0];
        for reach in [0.0, 0.01, 0.1, 2.0] {
            let nearby = Nearby::new(&surface, reach);
            for i in 0..100 {
                let at = Vec3::new(random(), random(), random()).as_dvec3() * surface.scale;
                let normal = Vec3::new(random() - 0.5, random() - 0.5, random() - 0.5);
                let normal = if i % 9 == 0 { Vec3::ZERO } else { normal / normal.abs().max_element() };
                let mut told = vec![false; 400];
                dispatch!(simd::level(), s => nearby.near(s, (at, reach), normal, |face| told[face as usize] = true));
                for (face, told) in told.into_iter().enumerate() {
                    let is_near = square(at, surface.places(face)) <= reach * reach;
                    let looks_along = surface.normal(face).dot(normal.as_dvec3()) > 0.0;
                    assert!(told || !is_near || looks_along, "{face} from {at}");
                    told_of[usize::from(told)] += 1;
                }
            }
        }
        assert!(told_of[0] > told_of[1], "hardly anything is left out: {told_of:?}");
    }
}
