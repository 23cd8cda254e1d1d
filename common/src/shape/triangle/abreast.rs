//! Eight pairs of ray and triangle side by side.
//!
//! Each lane goes through the steps of [`intersect`](super::intersect), so that it has the bits that the
//! pair would have alone. Where rounding could hide a sign nothing is decided.

use super::{EDGE_ERROR, TriangleHit};
use crate::math::UNIT_ROUNDOFF;
use crate::math::lanes::{
    LANES, Stored, Vectors, magnitudes, max_element, multiply, narrow, subtract, sum3, widen,
};
use crate::ray::Ray;
use crate::simd::{Simd, SimdBase, SimdMask, f32x8, f64x8};

/// Corners of eight triangles.
pub type Corners = [Stored<f32>; 3];

/// How eight lines pass their triangles.
pub struct Passages {
    /// A bit for every pair of which that is known.
    pub decided: u32,
    /// A bit for every line that passes inside.
    inside: u32,
    /// Where; see [`TriangleHit`].
    t: [f32; LANES],
    u: [f32; LANES],
    v: [f32; LANES],
}

impl Passages {
    /// That of one pair, if it is decided and passes inside.
    #[inline(always)]
    pub fn hit(&self, lane: usize) -> Option<TriangleHit> {
        let hit = TriangleHit { t: self.t[lane], u: self.u[lane], v: self.v[lane] };
        ((self.decided & self.inside) >> lane & 1 == 1).then_some(hit)
    }
}

/// How usable rays pass triangles.
#[inline(always)]
pub fn intersect_eight<S: Simd>(simd: S, rays: [&Ray; LANES], corners: [Vectors<f32x8<S>>; 3]) -> Passages {
    let [origin, direction] = Ray::columns(simd, rays);
    let (origin, direction) = (widen_all(simd, origin), widen_all(simd, direction));
    let a = subtract(widen_all(simd, corners[0]), origin);
    let b = subtract(widen_all(simd, corners[1]), origin);
    let c = subtract(widen_all(simd, corners[2]), origin);

    let weights = [edge(direction, b, c), edge(direction, c, a), edge(direction, a, b)];
    let corner_reach =
        max_element([max_element(magnitudes(a)), max_element(magnitudes(b)), max_element(magnitudes(c))]);
    let ray_reach = max_element(magnitudes(direction));
    let zero = f64x8::splat(simd, 0.0);
    let error = f64x8::splat(simd, EDGE_ERROR) * ray_reach * corner_reach * corner_reach;
    let (least, most) = extremes(weights);
    let all_positive = least.simd_gt(zero);
    let one_sign = all_positive | most.simd_lt(zero);
    let [x, y, z] = magnitudes(weights);
    let certain = x.simd_gt(error) & y.simd_gt(error) & z.simd_gt(error);
    let total = weights[0] + weights[1] + weights[2];
    // In thin triangles the weights' error would move the point too far.
    let thin =
        (error * size([a, b, c])).simd_gt(total.abs() * corner_reach * f64x8::splat(simd, UNIT_ROUNDOFF));
    let doubtful = !certain | (one_sign & thin);

    let share = [weights[0] / total, weights[1] / total, weights[2] / total];
    let along = [dot(a, direction), dot(b, direction), dot(c, direction)];
    let t = dot(share, along) / dot(direction, direction);
    let mut passages = Passages {
        decided: !doubtful.to_bitmask() as u32 & ((1 << LANES) - 1),
        inside: one_sign.to_bitmask() as u32,
        t: [0.0; LANES],
        u: [0.0; LANES],
        v: [0.0; LANES],
    };
    narrow(simd, t).store_slice(&mut passages.t);
    narrow(simd, share[1]).store_slice(&mut passages.u);
    narrow(simd, share[2]).store_slice(&mut passages.v);
    passages
}

// Not by closures, which would be calls, and compiled for other instructions.
#[inline(always)]
fn widen_all<S: Simd>(simd: S, [x, y, z]: Vectors<f32x8<S>>) -> Vectors<f64x8<S>> {
    [widen(simd, x), widen(simd, y), widen(simd, z)]
}

/// As [`dot3`](crate::math::dot3).
#[inline(always)]
fn dot<S: Simd>(a: Vectors<f64x8<S>>, b: Vectors<f64x8<S>>) -> f64x8<S> {
    sum3(multiply(a, b))
}

/// d · (p × q).
#[inline(always)]
fn edge<S: Simd>(d: Vectors<f64x8<S>>, p: Vectors<f64x8<S>>, q: Vectors<f64x8<S>>) -> f64x8<S> {
    sum3([
        d[0] * (p[1] * q[2] - p[2] * q[1]),
        d[1] * (p[2] * q[0] - p[0] * q[2]),
        d[2] * (p[0] * q[1] - p[1] * q[0]),
    ])
}

#[inline(always)]
fn extremes<S: Simd>([x, y, z]: Vectors<f64x8<S>>) -> (f64x8<S>, f64x8<S>) {
    (x.min(y).min(z), x.max(y).max(z))
}

/// Largest side of the box around the two edges at the first corner.
#[inline(always)]
fn size<S: Simd>([a, b, c]: [Vectors<f64x8<S>>; 3]) -> f64x8<S> {
    let (first, second) = (max_element(magnitudes(subtract(b, a))), max_element(magnitudes(subtract(c, a))));
    first.max(second)
}

#[cfg(test)]
mod tests;
