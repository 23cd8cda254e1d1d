//! Balls and planes that paths have met, eight at a time.

use super::leaving::Leaving;
use super::places::Met;
use super::{Found, PathTracer, Scratch};
use common::counters::Counters;
use common::geometry::{Abreast, Round, Surface};
use common::math::lanes::{
    LANES, Stored, Vectors, add, dot, each, load, load_wide, narrow, scale, store, store_wide, widen,
};
use common::math::{DVec3, Vec3};
use common::simd::{Select, Simd, SimdBase, f32x8, f64x8};

/// Eight rays and what they met.
#[derive(Clone, Copy)]
struct Block {
    /// Which of the rays of this generation.
    ray: [u32; LANES],
    material: [u32; LANES],
    origin: Stored<f32>,
    direction: Stored<f32>,
    t: [f32; LANES],
    /// Centres of balls, or normals of planes.
    vector: Stored<f64>,
    /// Their radii, or offsets.
    number: [f64; LANES],
}

/// What the rays of a generation met of one kind.
#[derive(Default)]
struct Line {
    blocks: Vec<Block>,
    count: usize,
}

/// The balls and the planes that the rays of a generation met.
#[derive(Default)]
pub(super) struct Rounds {
    balls: Line,
    planes: Line,
}

/// Eight surface points.
struct Points {
    point: Stored<f64>,
    own: Stored<f64>,
    error: Stored<f64>,
    away: [f64; LANES],
    /// 1 if the ray comes from the side of the normal, else −1.
    side: [f32; LANES],
    /// Normals on the ray's side.
    normal: Stored<f32>,
}

impl Block {
    const EMPTY: Self = Self {
        ray: [0; LANES],
        material: [0; LANES],
        origin: [[0.0; LANES]; 3],
        direction: [[0.0; LANES]; 3],
        t: [0.0; LANES],
        vector: [[0.0; LANES]; 3],
        number: [0.0; LANES],
    };
}

impl Line {
    /// The place for one more, and its lane.
    #[inline(always)]
    fn next(&mut self) -> Option<(&mut Block, usize)> {
        let lane = self.count % LANES;
        if lane == 0 {
            self.blocks.push(Block::EMPTY);
        }
        self.count += 1;
        self.blocks.last_mut().map(|block| (block, lane))
    }

    fn clear(&mut self) {
        self.blocks.clear();
        self.count = 0;
    }
}

impl Rounds {
    pub fn clear(&mut self) {
        self.balls.clear();
        self.planes.clear();
    }
}

impl PathTracer<'_> {
    /// Puts what a ray met aside if it is to be looked at with others; false if it is something
    /// else.
    #[inline(always)]
    pub(super) fn put_aside(&self, scratch: &mut Scratch, number: usize, primitive: u32, t: f32) -> bool {
        let (round, material) = self.studio.geometry.round(primitive);
        let (met, vector, size) = match round {
            Round::Ball(ball) => (&mut scratch.rounds.balls, ball.center, ball.radius),
            Round::Plane(plane) => (&mut scratch.rounds.planes, plane.normal, plane.offset),
            Round::Other => return false,
        };
        let ray = &scratch.rays[number];
        let Some((block, lane)) = met.next() else { return false };
        block.ray[lane] = number as u32;
        block.material[lane] = material;
        block.t[lane] = t;
        block.number[lane] = size;
        for axis in 0..3 {
            block.origin[axis][lane] = ray.origin[axis];
            block.direction[axis][lane] = ray.direction[axis];
            block.vector[axis][lane] = vector[axis];
        }
        true
    }

    /// Looks at all that was put aside.
    #[inline(always)]
    pub(super) fn look_at_rounds<S: Simd>(
        &self,
        simd: S,
        scratch: &mut Scratch,
        generation: u32,
        counters: &mut Counters,
        found: &mut [Found],
    ) {
        let rounds = std::mem::take(&mut scratch.rounds);
        for (is_ball, met) in [(true, &rounds.balls), (false, &rounds.planes)] {
            for (number, block) in met.blocks.iter().enumerate() {
                let points = Points::new(simd, block, is_ball);
                let count = LANES.min(met.count - number * LANES);
                for lane in 0..count {
                    self.look_at_round(scratch, block, &points, lane, generation, counters, found);
                }
            }
        }
        scratch.rounds = rounds;
    }

    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "the body of a loop over paths")]
    fn look_at_round(
        &self,
        scratch: &mut Scratch,
        block: &Block,
        points: &Points,
        lane: usize,
        generation: u32,
        counters: &mut Counters,
        found: &mut [Found],
    ) {
        let (number, material) = (block.ray[lane] as usize, block.material[lane]);
        let Some(primitive) = scratch.hits[number].map(|hit| hit.primitive) else { return };
        let vector = |v: &Stored<f64>| DVec3::new(v[0][lane], v[1][lane], v[2][lane]);
        let normal = Vec3::new(points.normal[0][lane], points.normal[1][lane], points.normal[2][lane]);
        let (point, own, side) = (vector(&points.point), vector(&points.own), points.side[lane]);
        let (path, away) = (number as u32, points.away[lane]);
        let met = Met { path, primitive, point, own, away, side, normal, color: Vec3::ZERO, index: 0.0 };
        if self.put_in_line(scratch, met, material, block.t[lane], generation, found) {
            return;
        }
        let surface = Surface {
            point,
            error: vector(&points.error),
            normal: normal * side,
            geometric_normal: own,
            material,
            primitive,
            weights: [0.0; 2],
        };
        let found = &mut found[scratch.paths[number].slot as usize];
        self.meet(scratch, number, block.t[lane], &surface, generation, counters, found);
    }

    /// Puts a surface in line with others that are left in the same way; false if it is to be looked
    /// at alone. `t` is where the ray met it.
    #[inline(always)]
    pub(super) fn put_in_line(
        &self,
        scratch: &mut Scratch,
        mut met: Met,
        material: u32,
        t: f32,
        generation: u32,
        found: &mut [Found],
    ) -> bool {
        let mut leaving = self.leaving[material as usize];
        if leaving == Leaving::Textured
            && let Some(leaf) = self.world.leaf(material, met.point)
        {
            leaving = self.leaving[leaf as usize];
        }
        let path = &mut scratch.paths[met.path as usize];
        match leaving {
            Leaving::Matt(color) => met.color = color,
            Leaving::Smooth { color, index, absorption } => {
                (met.color, met.index) = (color, index);
                if met.side < 0.0 && index > 0.0 && absorption != Vec3::ZERO {
                    path.throughput *= (absorption * -t).exp();
                }
            }
            Leaving::Alone | Leaving::Textured => return false,
        }
        if generation == 0 {
            let found = &mut found[path.slot as usize];
            (found.albedo, found.normal, found.depth) = (met.color, met.normal, t);
        }
        if self.sends_on(generation) {
            let is_matt = matches!(leaving, Leaving::Matt(_));
            (if is_matt { &mut scratch.matts } else { &mut scratch.smooth }).push(&met);
        }
        true
    }
}

impl Points {
    #[inline(always)]
    fn new<S: Simd>(simd: S, block: &Block, is_ball: bool) -> Self {
        let direction = each(load(simd, &block.direction), |d| widen(simd, d));
        let origin = each(load(simd, &block.origin), |o| widen(simd, o));
        let t = widen(simd, f32x8::from_slice(simd, &block.t));
        let near: Vectors<f64x8<S>> = add(origin, scale(direction, t));
        let (vector, number) = (load_wide(simd, &block.vector), f64x8::from_slice(simd, &block.number));
        let (at, error) = if is_ball {
            Abreast::on_balls(simd, vector, number, near)
        } else {
            Abreast::on_planes(simd, vector, number, near)
        };
        let of = |x: f64| f64x8::splat(simd, x);
        let side = dot(at.normal, direction).simd_gt(of(0.0)).select(of(-1.0), of(1.0));
        let side = narrow(simd, side);
        Self {
            point: store_wide(at.point),
            own: store_wide(at.normal),
            error: store_wide(error),
            away: *at.away,
            side: *side,
            normal: store(each(at.normal, |n| narrow(simd, n) * side)),
        }
    }
}
