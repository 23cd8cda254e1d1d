//! The faces of a surface in cubic cells: which are near a place, and do not look where one looks oneself?

use crate::collapse::eight::{Eight, Frame};
use crate::collapse::lattice::Lattice;
use crate::collapse::packed::{Block, Packed, ROUNDING, Scale};
use crate::collapse::surface::Surface;
use common::math::lanes::LANES;
use common::math::{DVec3, Vec3};
use common::simd::{self, Simd, dispatch};

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
        let mut all = 0;
        self.each_slot(simd, |this, slot, _, _, _| {
            this.first[slot] += 1;
            all += 1;
        });
        let mut before = 0;
        for first in &mut self.first {
            (*first, before) = (before, before + *first);
        }
        // What is left over of the last eight is a face without size that looks nowhere: it may be told.
        self.blocks = vec![Block::EMPTY; (all as usize).div_ceil(LANES)];
        self.large.clear();
        self.each_slot(simd, |this, slot, face, balls, lane| {
            let at = this.first[slot] as usize;
            this.first[slot] += 1;
            let normal = this.surface.faces[face as usize].remembered();
            this.blocks[at / LANES].set(at % LANES, (face, normal), balls, lane);
        });
        // Each slot has been filled to where the next begins.
        self.first.rotate_right(1);
        self.first[0] = 0;
    }

    /// Calls `what` with every slot that a face is in, the face, and the ball around it; notes those that are large.
    #[inline(always)]
    fn each_slot<S: Simd>(&mut self, simd: S, mut what: impl FnMut(&mut Self, usize, u32, &Packed, usize)) {
        let last = self.surface.faces.len() as u32;
        let mut faces = [0; LANES];
        for first in (0..last).step_by(LANES) {
            for lane in 0..LANES {
                faces[lane] = (first + lane as u32).min(last - 1);
            }
            let eight = Eight::new(simd, self.surface, &faces, (self.frame, self.scale, self.lattice));
            for lane in 0..LANES.min((last - first) as usize) {
                let bit = 1 << lane;
                if eight.balls.too_large & bit != 0 {
                    self.large.push(faces[lane]);
                } else if eight.cells.one & bit != 0 {
                    what(self, eight.cells.slot[lane] as usize, faces[lane], &eight.balls, lane);
                } else {
                    let cells = eight.cells.cells(lane);
                    if cells.are_many() {
                        self.large.push(faces[lane]);
                        continue;
                    }
                    for slot in self.lattice.slots_of(&cells) {
                        what(self, slot, faces[lane], &eight.balls, lane);
                    }
                }
            }
        }
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
        let origin = self.frame.origin.as_dvec3() * self.surface.scale;
        let (p, reach) = ((at - origin).as_vec3(), reach as f32 + ROUNDING);
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
        4 * self.first.capacity() + size_of::<Block>() * self.blocks.capacity()
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
