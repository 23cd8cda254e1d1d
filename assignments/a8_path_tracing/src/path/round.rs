//! Balls and planes that paths have met, put aside to be looked at eight at a time.

use super::leaving::Leaving;
use super::{PathTracer, Scratch};
use common::geometry::{Hit, Round};
use common::math::lanes::{LANES, Stored};

/// What up to eight rays met.
#[derive(Clone, Copy)]
pub(super) struct Block {
    /// How many there are.
    pub count: usize,
    /// Which of the rays of this generation.
    pub ray: [u32; LANES],
    pub material: [u32; LANES],
    pub primitive: [u32; LANES],
    pub t: [f32; LANES],
    /// Centres of balls, or normals of planes.
    pub vector: Stored<f64>,
    /// Their radii, or offsets.
    pub number: [f64; LANES],
}

/// Shapes.
const SHAPES: usize = 2;

/// Ways to leave a surface: the matt lobe, mirrors and glass, and others.
const WAYS: usize = 3;

/// What the rays of a generation met, shape by shape and by how it is left, so that eight of the same
/// kind come together.
#[derive(Default)]
pub(super) struct Rounds {
    lines: [Vec<Block>; SHAPES * WAYS],
}

impl Block {
    const EMPTY: Self = Self {
        count: 0,
        ray: [0; LANES],
        material: [0; LANES],
        primitive: [0; LANES],
        t: [0.0; LANES],
        vector: [[0.0; LANES]; 3],
        number: [0.0; LANES],
    };
}

impl Rounds {
    pub fn clear(&mut self) {
        self.lines.iter_mut().for_each(Vec::clear);
    }

    /// The blocks, line by line, and whether they are balls.
    pub fn lines(&self) -> impl Iterator<Item = (&[Block], bool)> {
        self.lines.iter().enumerate().map(|(number, blocks)| (&blocks[..], number < WAYS))
    }

    /// The place for one more, and its lane.
    #[inline(always)]
    fn next(&mut self, is_ball: bool, way: usize) -> Option<(&mut Block, usize)> {
        let line = &mut self.lines[if is_ball { way } else { WAYS + way }];
        if line.last().is_none_or(|block| block.count == LANES) {
            line.push(Block::EMPTY);
        }
        let block = line.last_mut()?;
        let lane = block.count % LANES;
        block.count += 1;
        Some((block, lane))
    }
}

impl PathTracer<'_> {
    /// Puts what a ray met aside if it is to be looked at with others; false if it is something
    /// else.
    #[inline(always)]
    pub(super) fn put_aside(&self, scratch: &mut Scratch, ray: usize, hit: &Hit) -> bool {
        let (round, material) = self.studio.geometry.round(hit.primitive);
        let (is_ball, vector, size) = match round {
            Round::Ball(ball) => (true, ball.center, ball.radius),
            Round::Plane(plane) => (false, plane.normal, plane.offset),
            Round::Other => return false,
        };
        let way = match self.leaving[material as usize] {
            Leaving::Matt(_) => 0,
            Leaving::Smooth { .. } => 1,
            Leaving::Alone | Leaving::Textured => 2,
        };
        let Some((block, lane)) = scratch.rounds.next(is_ball, way) else { return false };
        block.ray[lane] = ray as u32;
        block.material[lane] = material;
        block.primitive[lane] = hit.primitive;
        block.t[lane] = hit.t;
        block.number[lane] = size;
        for axis in 0..3 {
            block.vector[axis][lane] = vector[axis];
        }
        true
    }
}
