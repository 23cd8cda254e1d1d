//! The faces of a surface in cubic cells: which are near a place, and do not look where one looks oneself?

use crate::collapse::lattice::{Cell, Lattice, between};
use crate::collapse::packed::{Ball, Block, ROUNDING, Scale};
use crate::collapse::surface::{Face, Surface};
use common::math::lanes::LANES;
use common::math::{DVec3, Vec3};
use common::simd::Simd;

/// Side of a cell, in mean sides of the faces …
const SIDES: f64 = 1.9;
/// … or in terms of how far one looks.
const REACHES: f64 = 1.5;
/// Units in the side of a cell.
const UNITS: f32 = 256.0;

/// The faces of a surface, sorted by cells.
pub(super) struct Nearby<'a> {
    /// The surface.
    pub surface: &'a Surface,
    origin: DVec3,
    lattice: Lattice,
    /// What is in the cells of slot i is in lanes `first[i]..first[i + 1]`.
    first: Vec<u32>,
    blocks: Vec<Block>,
    scale: Scale,
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
            blocks: Vec::new(),
            scale: Scale::new(UNITS * lattice.fineness()),
            large: Vec::new(),
        };
        let entries = this.entries(&places);
        this.fill(&places, &entries);
        this
    }

    /// The slots that each face is in, face by face, and in how many it is. Counts what is in each slot, and tells where it
    /// begins.
    fn entries(&mut self, places: &[Vec3]) -> (Vec<u32>, Vec<u16>) {
        let cells: Vec<Cell> = places.iter().map(|&place| self.lattice.cell(place)).collect();
        let mut slots = Vec::with_capacity(self.surface.faces.len() * 5 / 2);
        let mut counts = Vec::with_capacity(self.surface.faces.len());
        for (i, face) in (0..).zip(&self.surface.faces) {
            let [a, b, c] = face.corners();
            let cells = between(cells[a as usize], cells[b as usize], cells[c as usize]);
            let before = slots.len();
            if cells.are_many() || ball(places, self.scale, face).is_none() {
                self.large.push(i);
            } else {
                self.lattice.each_slot(&cells, |slot| {
                    self.first[slot] += 1;
                    slots.push(slot as u32);
                });
            }
            counts.push((slots.len() - before) as u16);
        }
        let mut before = 0;
        for first in &mut self.first {
            (*first, before) = (before, before + *first);
        }
        (slots, counts)
    }

    /// Puts the faces into their slots.
    fn fill(&mut self, places: &[Vec3], (slots, counts): &(Vec<u32>, Vec<u16>)) {
        // What is left over of the last eight is a face without size that looks nowhere: it may be told.
        self.blocks = vec![Block::EMPTY; slots.len().div_ceil(LANES)];
        let mut slots = slots.iter();
        for ((number, face), &count) in (0..).zip(&self.surface.faces).zip(counts) {
            let Some(ball) = ball(places, self.scale, face) else { continue };
            for &slot in slots.by_ref().take(count.into()) {
                let at = self.first[slot as usize] as usize;
                self.first[slot as usize] += 1;
                self.blocks[at / LANES].set(at % LANES, number, ball);
            }
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
        let question = self.scale.question(p, reach, normal).filter(|_| !cells.are_many());
        let Some(question) = question else {
            return (0..self.surface.faces.len() as u32).for_each(what);
        };
        for slot in self.lattice.slots_of(&cells) {
            let (from, to) = (self.first[slot] as usize, self.first[slot + 1] as usize);
            if from == to {
                continue;
            }
            for block in &self.blocks[from / LANES..to.div_ceil(LANES)] {
                let mut found = block.found(simd, &question);
                while found != 0 {
                    what(block.numbers[found.trailing_zeros() as usize]);
                    found &= found - 1;
                }
            }
        }
        self.large.iter().for_each(|&face| what(face));
    }

    /// Bytes that are held for all faces.
    #[cfg(test)]
    pub(super) fn bytes(&self) -> usize {
        4 * self.first.capacity()
            + size_of::<Block>() * self.blocks.capacity()
            + 28 * self.surface.points.len()
    }
}

/// The ball around a face.
#[inline(always)]
fn ball(places: &[Vec3], scale: Scale, face: &Face) -> Option<Ball> {
    let [a, b, c] = face.corners();
    let [a, b, c] = [places[a as usize], places[b as usize], places[c as usize]];
    let middle = (a + b + c) * (1.0 / 3.0);
    let squares = [a.distance_squared(middle), b.distance_squared(middle), c.distance_squared(middle)];
    let reach = squares[0].max(squares[1]).max(squares[2]).sqrt();
    scale.ball(middle, reach, face.remembered())
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
