//! Rays.

use crate::math::lanes::{LANES, Vectors, turn};
use crate::math::{DVec3, Vec3};
use crate::simd::{Simd, SimdBase, f32x4, f32x8, mask32x8};

/// A half line (or line, if the interval of a query says so): points origin + t·direction.
///
/// The direction need not have unit length; t counts in units of it. Camera, mirrored and
/// refracted rays have unit directions, so their t is a distance; a shadow ray towards a point
/// keeps the whole vector, so the light is at t = 1. A ray with a NaN, an infinity or a zero
/// direction hits nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)] // So that what is loaded at once lies side by side.
pub struct Ray {
    /// Where t = 0.
    pub origin: Vec3,
    /// Change of position per unit of t.
    pub direction: Vec3,
    /// Number of the primitive that it leaves; [`Ray::ANYWHERE`] if it leaves none.
    pub home: u32,
}

impl Ray {
    /// The home of rays that leave nothing.
    pub const ANYWHERE: u32 = u32::MAX;

    /// A ray from its two vectors.
    #[inline]
    pub fn new(origin: Vec3, direction: Vec3) -> Self {
        Self { origin, direction, home: Self::ANYWHERE }
    }

    /// The same for a ray that starts beside the primitive of this number and goes away from it. If
    /// that is flat (a triangle, a plane, a disc), the ray cannot hit it, and no structure asks it:
    /// a triangle is so near that only the test in double precision could tell. A round one is asked
    /// like all.
    #[inline]
    pub fn leaving(primitive: u32, origin: Vec3, direction: Vec3) -> Self {
        Self { origin, direction, home: primitive }
    }

    /// The point at parameter t, in `f64`.
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin.as_dvec3() + self.direction.as_dvec3() * t
    }

    /// Whether it can hit anything at all: finite, with a direction.
    #[inline]
    pub fn is_usable(&self) -> bool {
        self.origin.is_finite() && self.direction.is_finite() && self.direction != Vec3::ZERO
    }

    /// [`Ray::is_usable`] of eight rays side by side.
    #[inline(always)]
    pub fn are_usable<S: Simd>(
        simd: S,
        origin: Vectors<f32x8<S>>,
        direction: Vectors<f32x8<S>>,
    ) -> mask32x8<S> {
        let zero = f32x8::splat(simd, 0.0);
        let (mut nothing, mut step) = (zero, zero);
        for axis in 0..3 {
            // 0 of what is finite, else NaN.
            nothing += origin[axis] * zero + direction[axis] * zero;
            step = step.max(direction[axis].abs());
        }
        nothing.simd_eq(zero) & step.simd_gt(zero)
    }

    /// Origins and directions of eight rays side by side. What is beside each other in memory is
    /// loaded at once, and turned in registers.
    #[inline(always)]
    pub fn columns<S: Simd>(simd: S, [a, b, c, d, e, f, g, h]: [&Self; LANES]) -> [Vectors<f32x8<S>>; 2] {
        let (low, high) = (coordinates(simd, [a, b, c, d]), coordinates(simd, [e, f, g, h]));
        let both = |column: usize| simd.combine_f32x4(low[column], high[column]);
        [[both(0), both(1), both(2)], [both(3), both(4), both(5)]]
    }
}

/// The six coordinates of four rays, each in its vector.
#[inline(always)]
fn coordinates<S: Simd>(simd: S, rays: [&Ray; 4]) -> [f32x4<S>; 6] {
    let front = |i: usize| {
        let Ray { origin: o, direction: d, .. } = rays[i];
        f32x4::from_slice(simd, &[o.x, o.y, o.z, d.x])
    };
    let back = |i: usize| {
        let Ray { origin: o, direction: d, .. } = rays[i];
        f32x4::from_slice(simd, &[o.z, d.x, d.y, d.z])
    };
    let [ox, oy, oz, dx] = turn(simd, [front(0), front(1), front(2), front(3)]);
    let [_, _, dy, dz] = turn(simd, [back(0), back(1), back(2), back(3)]);
    [ox, oy, oz, dx, dy, dz]
}
