//! All rays of a packet against the eight boxes of a node at once, by interval arithmetic
//! (Reshetov, Soupikov & Hurley, "Multi-Level Ray Tracing Algorithm", 2005).
//!
//! Origins and inverse directions of the rays lie in intervals, so where they meet a side does
//! too. A box that this interval passes by is passed by by every ray.

use super::packet::{Lanes, Packet, RAYS};
use super::wide::{WIDTH, WideNode};
use common::math::Bounds;
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
    /// Encloses the rays of a packet if they are a bundle worth it.
    #[inline(always)]
    pub fn around(packet: &Packet, bounds: &Bounds) -> Option<Self> {
        let backward = packet.backward[0];
        let mut differing = 0;
        for lane in 1..RAYS {
            differing |= packet.backward[lane] ^ backward;
        }
        if differing != 0 {
            return None;
        }
        let size = bounds.size().max_element();
        let mut step = 0.0f32;
        for axis in 0..3 {
            step = step.max(packet.direction[axis][0].abs());
        }
        let mut f =
            Self { sign: [0.0; 3], origin: [[0.0; 2]; 3], inverse: [[0.0; 2]; 3], error: [0.0; 3], backward };
        for axis in 0..3 {
            let (low_origin, high_origin) = range(&packet.origin[axis]);
            let (low_step, high_step) = range(&packet.direction[axis]);
            // Written so that NaN is no bundle.
            let bundle = high_origin - low_origin <= size * APART && high_step - low_step <= step * SPREAD;
            if !bundle {
                return None;
            }
            let (low, high) = range(&packet.inverse[axis]);
            let (_, error) = range(&packet.error[axis]);
            let forward = backward >> axis & 1 == 0;
            f.sign[axis] = if forward { 1.0 } else { -1.0 };
            f.origin[axis] = if forward { [high_origin, low_origin] } else { [-low_origin, -high_origin] };
            f.inverse[axis] = if forward { [low, high] } else { [-high, -low] };
            f.error[axis] = error;
        }
        (f.error[0] < f32::INFINITY).then_some(f)
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

/// Whether the rays of a packet start near each other.
#[inline(always)]
pub fn starts_together(packet: &Packet, bounds: &Bounds) -> bool {
    let apart = bounds.size().max_element() * APART;
    let mut together = true;
    for axis in 0..3 {
        let (low, high) = range(&packet.origin[axis]);
        together &= high - low <= apart;
    }
    together
}

#[inline(always)]
fn range(lanes: &Lanes) -> (f32, f32) {
    let (mut low, mut high) = (lanes[0], lanes[0]);
    for &x in lanes {
        low = if x < low { x } else { low };
        high = if x > high { x } else { high };
    }
    (low, high)
}
