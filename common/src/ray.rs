//! Rays.

use crate::math::{DVec3, Vec3};

/// A half line (or line, if the interval of a query says so): points origin + t·direction.
///
/// The direction need not have unit length; t counts in units of it. Camera, mirrored and
/// refracted rays have unit directions, so their t is a distance; a shadow ray towards a point
/// keeps the whole vector, so the light is at t = 1. A ray with a NaN, an infinity or a zero
/// direction hits nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where t = 0.
    pub origin: Vec3,
    /// Change of position per unit of t.
    pub direction: Vec3,
}

impl Ray {
    /// A ray from its two vectors.
    pub fn new(origin: Vec3, direction: Vec3) -> Self {
        Self { origin, direction }
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
}
