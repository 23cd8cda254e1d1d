//! Rays and the part of them that counts.

use common::math::{DMat4, DVec3};

/// A point and a direction. World-space rays have a unit direction, so t is a distance; the
/// object-space ray of a transformed shape keeps whatever length the transform gives it, so
/// that t is the same number in both spaces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where t = 0.
    pub origin: DVec3,
    /// Change of position per unit of t; not zero.
    pub direction: DVec3,
}

impl Ray {
    /// The point at `t`.
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + t * self.direction
    }

    /// The same ray seen through an affine `matrix`, direction not normalised.
    pub(crate) fn transformed(&self, matrix: &DMat4) -> Self {
        Self {
            origin: matrix.transform_point3(self.origin),
            direction: matrix.transform_vector3(self.direction),
        }
    }
}

/// An open interval of t: both ends are excluded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Hits must lie beyond this.
    pub min: f64,
    /// Hits must lie before this.
    pub max: f64,
}

impl Range {
    /// Everything in front of the origin.
    pub const FORWARD: Self = Self { min: 0.0, max: f64::INFINITY };
    /// The whole line, as orthographic cameras see it.
    pub const LINE: Self = Self { min: f64::NEG_INFINITY, max: f64::INFINITY };

    /// Is `t` strictly inside? NaN is not.
    pub fn contains(&self, t: f64) -> bool {
        self.min < t && t < self.max
    }
}
