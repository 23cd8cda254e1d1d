//! The faces of a surface in cubic cells: which are near a place, and do not look where one looks oneself?

use crate::collapse::counted::{begin, begin_again};
use crate::collapse::eight::{Eight, Frame, eight_from};
use crate::collapse::lattice::{Lattice, Met};
use crate::collapse::packed::{Block, Questions, ROUNDING, Scale};
use crate::collapse::surface::Surface;
use common::math::lanes::{LANES, Vectors, add, narrow, subtract};
use common::math::{DVec3, Vec3};
use common::simd::{self, Simd, SimdBase, dispatch, f32x8, f64x8};

/// Side of a cell, in mean sides of the faces …
const SIDES: f64 = 2.2;
/// … or in terms of how far one looks.
const REACHES: f64 = 1.5;
/// Units in the side of a cell.
const UNITS: f32 = 256.0;

/// What is asked from eight places.
pub(super) struct Asked {
    questions: Questions,
    cells: Met,
}

/// The faces of a surface, sorted by cells.
pub(super) struct Nearby<'a> {
    /// The surface.
    pub surface: &'a Surface,
    frame: Frame,
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
        let lattice = Lattice::new((SIDES * mean_side(surface)).max(REACHES * reach), surface.faces.len());
        let mut this = Self {
            surface,
            frame: Frame {
                origin: surface.points.first().map_or(Vec3::ZERO, |point| point.at),
                unit: surface.scale as f32,
            },
            lattice,
            first: vec![0; lattice.slots() + 1],
            blocks: Vec::new(),
            scale: Scale::new(UNITS * lattice.fineness()),
            large: Vec::new(),
        };
        dispatch!(simd::level(), s => this.sort(s));
        this
    }

    #[inline(always)]
    fn sort<S: Simd>(&mut self, simd: S) {
        let mut eights = Vec::with_capacity(self.surface.faces.len().div_ceil(LANES));
        self.count(simd, &mut eights);
        let all = begin(&mut self.first) as usize;
        // What is left over of the last eight is a face without size that looks nowhere: it may be told.
        self.blocks = vec![Block::EMPTY; all.div_ceil(LANES)];
        self.fill(&eights);
        begin_again(&mut self.first);
    }

    /// Finds out in which slots each face is, and how many there are in each.
    #[inline(always)]
    fn count<S: Simd>(&mut self, simd: S, eights: &mut Vec<Eight>) {
        let last = self.surface.faces.len() as u32;
        for first in (0..last).step_by(LANES) {
            let faces = eight_from(first, last);
            let eight = Eight::new(simd, self.surface, &faces, (self.frame, self.scale, self.lattice));
            for face in first..last.min(first + LANES as u32) {
                let lane = (face - first) as usize;
                if eight.is_large(lane) {
                    self.large.push(face);
                    continue;
                }
                for slot in self.lattice.slots_of(eight.cells.cells(lane)) {
                    self.first[slot] += 1;
                }
            }
            eights.push(eight);
        }
    }

    /// Puts the faces into their slots.
    #[inline(always)]
    fn fill(&mut self, eights: &[Eight]) {
        for (number, face) in self.surface.faces.iter().enumerate() {
            let (eight, lane) = (&eights[number / LANES], number % LANES);
            if eight.is_large(lane) {
                continue;
            }
            let ball = (number as u32, face.remembered());
            for slot in self.lattice.slots_of(eight.cells.cells(lane)) {
                let at = self.first[slot] as usize;
                self.first[slot] += 1;
                self.blocks[at / LANES].set(at % LANES, ball, &eight.balls, lane);
            }
        }
    }

    /// What is asked from eight places: which faces are as near as one looks, and do not look along a normal that is given in
    /// terms of its largest component?
    #[inline(always)]
    pub(super) fn ask<S: Simd>(
        &self,
        simd: S,
        (at, reach): (Vectors<f64x8<S>>, f64x8<S>),
        normal: Vectors<f32x8<S>>,
    ) -> Asked {
        let origin = self.frame.origin.as_dvec3() * self.surface.scale;
        let of = |x: f64| f64x8::splat(simd, x);
        let [x, y, z] = subtract(at, [of(origin.x), of(origin.y), of(origin.z)]);
        let p = [narrow(simd, x), narrow(simd, y), narrow(simd, z)];
        let reach = narrow(simd, reach) + f32x8::splat(simd, ROUNDING);
        let aside = reach + f32x8::splat(simd, self.lattice.spread());
        let cells = self.lattice.met(simd, subtract(p, [aside; 3]), add(p, [aside; 3]));
        Asked { questions: self.scale.questions(simd, p, reach, normal), cells }
    }

    /// Calls `what` with every face that meets the cells around one of eight places, as far as one looks, and is not known
    /// to look along a normal; with some of them more than once, and with others that are only near. If there is no normal,
    /// nothing looks along it.
    #[inline(always)]
    pub(super) fn tell<S: Simd>(&self, simd: S, asked: &Asked, lane: usize, mut what: impl FnMut(u32)) {
        if (asked.cells.many | asked.questions.too_far) >> lane & 1 != 0 {
            return (0..self.surface.faces.len() as u32).for_each(what);
        }
        let question = asked.questions.of(lane);
        for slot in self.lattice.slots_of(asked.cells.cells(lane)) {
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

    /// The same for one place.
    #[inline(always)]
    pub(super) fn near<S: Simd>(
        &self,
        simd: S,
        (at, reach): (DVec3, f64),
        normal: Vec3,
        what: impl FnMut(u32),
    ) {
        let of = |x: f64| f64x8::splat(simd, x);
        let single = |x: f32| f32x8::splat(simd, x);
        let normal = [single(normal.x), single(normal.y), single(normal.z)];
        let asked = self.ask(simd, ([of(at.x), of(at.y), of(at.z)], of(reach)), normal);
        self.tell(simd, &asked, 0, what);
    }

    /// Bytes that are held for all faces.
    #[cfg(test)]
    pub(super) fn bytes(&self) -> usize {
        4 * self.first.capacity()
            + size_of::<Block>() * self.blocks.capacity()
            + size_of::<Eight>() * self.surface.faces.len().div_ceil(LANES)
    }
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
