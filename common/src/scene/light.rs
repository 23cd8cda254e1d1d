//! Lights, as written.

use super::Position;
use crate::math::{DVec3, Vec3};

/// One light of the `Lights` block.
#[derive(Clone, Debug, PartialEq)]
pub struct LightSpec {
    /// Linear RGB.
    pub color: Vec3,
    /// What kind of light it is, and where.
    pub kind: LightKind,
    /// Where its keyword stands.
    pub position: Position,
}

/// The kinds of light. Attenuation divides the colour by a0 + a1·d + a2·d² at distance d.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightKind {
    /// Parallel light.
    Directional {
        /// The way the light travels, made a unit vector when it was read.
        direction: DVec3,
    },
    /// Light from one point.
    Point {
        /// Where it is, in world space.
        position: DVec3,
        /// Coefficients a0, a1, a2; 1 0 0 by default.
        attenuation: [f32; 3],
    },
    /// Light from a sphere: soft shadows (an extension).
    Sphere {
        /// Centre in world space.
        center: DVec3,
        /// Radius, above zero.
        radius: f64,
        /// Coefficients a0, a1, a2; 1 0 0 by default.
        attenuation: [f32; 3],
    },
}
