//! The highlight.

use common::math::Vec3;
use std::f32::consts::{PI, TAU};

/// The course's highlight, (n·h)ᵉ around the half vector h, scaled so that light straight from
/// above is sent back with exactly `color` and other light with less (Giesen, "Phong and
/// Blinn-Phong normalization factors", 2009).
#[derive(Clone, Copy, Debug)]
pub struct Glossy {
    /// ks.
    pub color: Vec3,
    exponent: f32,
    scale: f32,
}

impl Glossy {
    /// The lobe of a colour and a sharpness.
    pub fn new(color: Vec3, exponent: f32) -> Self {
        let e = exponent.max(0.0);
        let scale = (e + 2.0) * (e + 4.0) / (8.0 * PI * ((-e / 2.0).exp2() + e));
        Self { color, exponent: e, scale }
    }

    /// The lobe without its colour, per steradian, and the density of [`Glossy::half_vector`]'s
    /// mirrored direction.
    #[inline]
    pub fn value(&self, out: Vec3, into: Vec3, normal: Vec3) -> (f32, f32) {
        let half = (out + into).normalize_or_zero();
        let upright = normal.dot(half);
        if upright <= 0.0 {
            return (0.0, 0.0);
        }
        let power = upright.powf(self.exponent);
        let density = (self.exponent + 1.0) / TAU * power / (4.0 * out.dot(half).abs());
        (self.scale * power, density)
    }

    /// A half vector around `normal`, with density (e + 1)/2π · (n·h)ᵉ.
    #[inline]
    pub fn half_vector(&self, [u, v]: [f32; 2], normal: Vec3) -> Vec3 {
        let upright = (1.0 - u).powf(1.0 / (self.exponent + 1.0));
        let aside = (1.0 - upright * upright).max(0.0).sqrt();
        let (sine, cosine) = (TAU * v).sin_cos();
        let (a, b) = normal.any_orthonormal_pair();
        (a * (cosine * aside) + b * (sine * aside) + normal * upright).normalize()
    }
}
