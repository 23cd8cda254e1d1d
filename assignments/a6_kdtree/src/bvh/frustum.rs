//! All rays of a packet against the eight boxes of a node at once, by interval arithmetic
//! (Reshetov, Soupikov & Hurley, "Multi-Level Ray Tracing Algorithm", 2005).
//!
//! Origins and inverse directions of the rays lie in intervals, so where they meet a side does
//! too. A box that this interval passes by is passed by by every ray.

use super::bundle::MOST;
use super::packet::{EVERY, Lanes, Packet, RAYS};
use super::wide::{WIDTH, WideNode};
use common::math::lanes::{Vectors, greatest, least};
use common::math::{Bounds, Vec3};
use common::ray::Ray;
use common::simd::{Simd, SimdBase, SimdFloat, SimdMask, f32x8};

/// Rays whose directions differ by more than this part of the direction are no bundle …
const SPREAD: f32 = 0.1;

/// … nor are rays whose origins differ by more than this part of the scene.
const APART: f32 = 0.05;

/// What encloses the rays of a packet.
pub struct Frustum {
    /// 1 along axes on which the rays run towards larger coordinates, else −1.
    sign: [f32; 3],
    /// Greatest and least origin, times the sign.
    origin: [[f32; 2]; 3],
    /// Least and greatest magnitude of the inverse direction.
    inverse: [[f32; 2]; 3],
    error: [f32; 3],
    /// The rays' signs, a bit for each axis.
    pub backward: u32,
}

impl Frustum {
    /// Encloses the first `count` rays of a packet, a multiple of eight, if they are a bundle worth it.
    #[inline(always)]
    pub fn around<S: Simd>(simd: S, packet: &Packet<MOST>, count: usize, bounds: &Bounds) -> Option<Self> {
        let every = u32::MAX >> (32 - count);
        let one_way = packet.backward.iter().all(|rays| rays & every == 0 || rays & every == every);
        if !one_way || packet.usable & packet.ordinary & every != every {
            return None;
        }
        let backward = packet.backward[0] & 1 | packet.backward[1] & 2 | packet.backward[2] & 4;
        let origin = ranges(simd, &packet.origin, count);
        let direction = ranges(simd, &packet.direction, count);
        let (apart, step) = (bounds.size().max_element() * APART, step(&packet.direction, 0) * SPREAD);
        let beside = |[low, high]: &[f32; 2], most: f32| high - low <= most;
        let bundle = origin.iter().all(|o| beside(o, apart)) && direction.iter().all(|d| beside(d, step));
        if !bundle {
            return None;
        }
        let inverse = ranges(simd, &packet.inverse, count);
        let error = ranges(simd, &packet.error, count).map(|[_, most]| most);
        let mut f = Self { sign: [1.0; 3], origin, inverse, error, backward };
        for axis in 0..3 {
            let [low, high] = origin[axis];
            if backward >> axis & 1 == 0 {
                f.origin[axis] = [high, low];
            } else {
                f.sign[axis] = -1.0;
                f.origin[axis] = [-low, -high];
                f.inverse[axis] = [-inverse[axis][1], -inverse[axis][0]];
            }
        }
        Some(f)
    }

    /// A bit for every child whose box one of the rays may meet between `min` and `max`, and
    /// where the first of them enters.
    #[inline(always)]
    pub fn meet<S: Simd>(
        &self,
        simd: S,
        node: &WideNode,
        min: f32,
        max: f32,
        enter: &mut [f32; WIDTH],
    ) -> u32 {
        let mut near = f32x8::splat(simd, min);
        let mut far = f32x8::splat(simd, max);
        for axis in 0..3 {
            let first = (self.backward >> axis & 1) as usize;
            let sides = &node.side[axis];
            let sign = f32x8::splat(simd, self.sign[axis]);
            let [slow, fast] = self.inverse[axis];
            let (slow, fast) = (f32x8::splat(simd, slow), f32x8::splat(simd, fast));
            let error = f32x8::splat(simd, self.error[axis]);
            let ahead = f32x8::from_slice(simd, &sides[first])
                .mul_sub(sign, f32x8::splat(simd, self.origin[axis][0]));
            let behind = f32x8::from_slice(simd, &sides[first ^ 1])
                .mul_sub(sign, f32x8::splat(simd, self.origin[axis][1]));
            near = near.max((ahead * slow).min(ahead * fast) - error);
            far = far.min((behind * slow).max(behind * fast) + error);
        }
        near.store_slice(enter);
        near.simd_le(far).to_bitmask() as u32
    }
}

/// Whether all rays between two may be a bundle.
#[inline(always)]
pub fn may_be_bundle(first: &Ray, last: &Ray, bounds: &Bounds) -> bool {
    let (apart, step) = (bounds.size().max_element() * APART, first.direction.abs().max_element() * SPREAD);
    let beside = |a: Vec3, b: Vec3, most: f32| (a - b).abs().max_element() <= most;
    beside(first.origin, last.origin, apart) && beside(first.direction, last.direction, step)
}

/// Whether rays may be a bundle by the signs of their directions.
#[inline(always)]
pub fn go_one_way<S: Simd>(simd: S, direction: Vectors<f32x8<S>>) -> bool {
    let zero = f32x8::splat(simd, 0.0);
    let [x, y, z] = [direction[0].simd_lt(zero), direction[1].simd_lt(zero), direction[2].simd_lt(zero)];
    let [x, y, z] = [x.to_bitmask() as u32, y.to_bitmask() as u32, z.to_bitmask() as u32];
    (x == 0 || x == EVERY) && (y == 0 || y == EVERY) && (z == 0 || z == EVERY)
}

/// Whether the first eight rays of a packet start near each other.
#[inline(always)]
pub fn starts_together<S: Simd>(simd: S, packet: &Packet<MOST>, bounds: &Bounds) -> bool {
    let apart = bounds.size().max_element() * APART;
    // Written so that NaN is not near.
    ranges(simd, &packet.origin, RAYS).iter().all(|[low, high]| high - low <= apart)
}

/// The largest component of one ray's vector.
#[inline(always)]
fn step(vectors: &[Lanes<MOST>; 3], lane: usize) -> f32 {
    vectors[0][lane].abs().max(vectors[1][lane].abs()).max(vectors[2][lane].abs())
}

/// The least and the greatest of the first `count` numbers, a multiple of eight, for each of three axes. What
/// numbers that are not finite make of it means nothing.
#[inline(always)]
fn ranges<S: Simd>(simd: S, lanes: &[Lanes<MOST>; 3], count: usize) -> [[f32; 2]; 3] {
    // Not in a closure, which would be a call, and compiled for other instructions.
    let ((x, most_x), (y, most_y)) = (range(simd, &lanes[0], count), range(simd, &lanes[1], count));
    let (z, most_z) = range(simd, &lanes[2], count);
    let (least, most) = (least(simd, [x, y, z, z]), greatest(simd, [most_x, most_y, most_z, most_z]));
    [[least[0], most[0]], [least[1], most[1]], [least[2], most[2]]]
}

/// Eight numbers of which one is the least, and eight of which one is the greatest.
#[inline(always)]
fn range<S: Simd>(simd: S, lanes: &Lanes<MOST>, count: usize) -> (f32x8<S>, f32x8<S>) {
    let mut least = f32x8::from_slice(simd, &lanes[..RAYS]);
    let mut most = least;
    for at in (RAYS..count).step_by(RAYS) {
        let more = f32x8::from_slice(simd, &lanes[at..at + RAYS]);
        (least, most) = (least.min(more), most.max(more));
    }
    (least, most)
}
