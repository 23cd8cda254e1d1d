//! Points of balls and planes, eight at a time.

use super::leaving::{Leaving, Look};
use super::places::{self, Met};
use super::round::Block;
use super::{Found, PathTracer, Scratch};
use common::counters::Counters;
use common::geometry::{Abreast, Surface};
use common::math::lanes::{
    LANES, Stored, Vectors, add, dot, each, load_wide, narrow, scale, store, store_wide, widen,
};
use common::math::{DVec3, Vec3};
use common::ray::Ray;
use common::simd::{Select, Simd, SimdBase, f32x8, f64x8};

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

impl Points {
    #[inline(always)]
    fn new<S: Simd>(simd: S, scratch: &Scratch, block: &Block, is_ball: bool) -> Self {
        let [origin, direction] = Ray::columns(simd, scratch.rays_of(&block.ray));
        let origin = each(origin, |o| widen(simd, o));
        let direction = each(direction, |d| widen(simd, d));
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

    #[inline(always)]
    fn point(&self, lane: usize) -> DVec3 {
        DVec3::new(self.point[0][lane], self.point[1][lane], self.point[2][lane])
    }

    #[inline(always)]
    fn own(&self, lane: usize) -> DVec3 {
        DVec3::new(self.own[0][lane], self.own[1][lane], self.own[2][lane])
    }

    #[inline(always)]
    fn normal(&self, lane: usize) -> Vec3 {
        Vec3::new(self.normal[0][lane], self.normal[1][lane], self.normal[2][lane])
    }
}

impl PathTracer<'_> {
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
        for (blocks, is_ball) in rounds.lines() {
            for block in blocks {
                let points = Points::new(simd, scratch, block, is_ball);
                if self.put_all_in_line(scratch, block, &points, generation, found) {
                    continue;
                }
                for lane in 0..block.count {
                    self.look_at_round(scratch, block, &points, lane, generation, counters, found);
                }
            }
        }
        scratch.rounds = rounds;
    }

    /// Puts all points of a block in line if they are left in the same way; false, and nothing is
    /// done, if they are not.
    #[inline(always)]
    fn put_all_in_line(
        &self,
        scratch: &mut Scratch,
        block: &Block,
        points: &Points,
        generation: u32,
        found: &mut [Found],
    ) -> bool {
        let mut leaving = [Leaving::Alone; LANES];
        let (mut matt, mut smooth) = (true, true);
        for (lane, leaving) in leaving.iter_mut().enumerate().take(block.count) {
            *leaving = self.leaving_at(block.material[lane], || points.point(lane));
            matt &= matches!(leaving, Leaving::Matt(_));
            smooth &= matches!(leaving, Leaving::Smooth { .. });
        }
        if !(matt | smooth) {
            return false;
        }
        let (mut color, mut index) = ([[0.0; LANES]; 3], [0.0; LANES]);
        for lane in 0..block.count {
            let look = Look { side: points.side[lane], normal: points.normal(lane), t: block.t[lane] };
            let path = &mut scratch.paths[block.ray[lane] as usize];
            // There is one: that was seen above.
            let lobe = self.take_lobe(path, &leaving[lane], &look, generation, found).unwrap_or_default();
            index[lane] = lobe.1;
            for (axis, lanes) in color.iter_mut().enumerate() {
                lanes[lane] = lobe.0[axis];
            }
        }
        if self.sends_on(generation) {
            (if matt { &mut scratch.matts } else { &mut scratch.smooth }).blocks.push(places::Block {
                count: block.count,
                path: block.ray,
                primitive: block.primitive,
                point: points.point,
                own: points.own,
                away: points.away,
                side: points.side,
                normal: points.normal,
                color,
                index,
            });
        }
        true
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
        let (path, primitive, material) = (block.ray[lane], block.primitive[lane], block.material[lane]);
        let (point, own, normal) = (points.point(lane), points.own(lane), points.normal(lane));
        let (side, away) = (points.side[lane], points.away[lane]);
        let met = Met { path, primitive, point, own, away, side, normal, color: Vec3::ZERO, index: 0.0 };
        if self.put_in_line(scratch, met, material, block.t[lane], generation, found) {
            return;
        }
        let error = DVec3::new(points.error[0][lane], points.error[1][lane], points.error[2][lane]);
        let surface = Surface {
            point,
            error,
            normal: normal * side,
            geometric_normal: own,
            material,
            primitive,
            weights: [0.0; 2],
        };
        let found = &mut found[scratch.paths[path as usize].slot as usize];
        self.meet(scratch, path as usize, block.t[lane], &surface, generation, counters, found);
    }
}
