//! Points of balls and planes, eight side by side, each as [`Geometry::surface`] finds it.

use super::surface::{DOUBLE, SINGLE, SUBNORMAL};
use super::{Geometry, RunKind, SolidShape};
use crate::math::lanes::{
    Vectors, add, each, magnitudes, max_element, multiply, narrow, normalize_or, scale, subtract, sum3,
};
use crate::shape::plane::Plane;
use crate::shape::sphere::Sphere;
use crate::simd::{Simd, SimdBase, f32x8, f64x8};

/// What can be worked out eight at a time.
#[derive(Clone, Copy, Debug)]
pub enum Round<'g> {
    /// A ball.
    Ball(&'g Sphere),
    /// A plane or disc.
    Plane(&'g Plane),
    /// Something else.
    Other,
}

/// Eight points of surfaces, and where rays that leave them start.
pub struct Abreast<S: Simd> {
    /// The points.
    pub point: Vectors<f64x8<S>>,
    /// Unit normals of the surfaces.
    pub normal: Vectors<f64x8<S>>,
    /// How far beside the surfaces rays start.
    pub away: f64x8<S>,
}

impl<S: Simd> Abreast<S> {
    /// The points of balls nearest to points that are close to them, and the bounds of their error.
    #[inline(always)]
    pub fn on_balls(
        simd: S,
        center: Vectors<f64x8<S>>,
        radius: f64x8<S>,
        near: Vectors<f64x8<S>>,
    ) -> (Self, Vectors<f64x8<S>>) {
        let zero = f64x8::splat(simd, 0.0);
        let up = [zero, zero, f64x8::splat(simd, 1.0)];
        let out = normalize_or(simd, subtract(near, center), up);
        let point = add(center, scale(out, radius));
        let normal = normalize_or(simd, subtract(point, center), [zero; 3]);
        Self::new(simd, point, normal, max_element(magnitudes(center)) + radius)
    }

    /// The same of planes.
    #[inline(always)]
    pub fn on_planes(
        simd: S,
        normal: Vectors<f64x8<S>>,
        offset: f64x8<S>,
        near: Vectors<f64x8<S>>,
    ) -> (Self, Vectors<f64x8<S>>) {
        let point = subtract(near, scale(normal, sum3(multiply(normal, near)) - offset));
        Self::new(simd, point, normal, max_element(magnitudes(point)) + offset.abs())
    }

    #[inline(always)]
    fn new(
        simd: S,
        point: Vectors<f64x8<S>>,
        normal: Vectors<f64x8<S>>,
        size: f64x8<S>,
    ) -> (Self, Vectors<f64x8<S>>) {
        let of = |x: f64| f64x8::splat(simd, x);
        let double = size * of(DOUBLE) + of(SUBNORMAL);
        let error = each(magnitudes(point), |p| p * of(SINGLE) + double);
        let away = of(2.0) * sum3(multiply(magnitudes(normal), error));
        (Self { point, normal, away }, error)
    }

    /// Where rays start on the side of a normal that `sign`, 1 or −1, says.
    #[inline(always)]
    pub fn beside(&self, simd: S, sign: f64x8<S>) -> Vectors<f32x8<S>> {
        each(add(self.point, scale(self.normal, self.away * sign)), |p| narrow(simd, p))
    }
}

impl Geometry {
    /// What a primitive is, and its material.
    #[inline(always)]
    pub fn round(&self, primitive: u32) -> (Round<'_>, u32) {
        let (run, index) = self.locate(primitive);
        let round = match run.kind {
            RunKind::Triangle => Round::Other,
            RunKind::Sheet => Round::Plane(&self.sheets[index].plane),
            RunKind::Solid => match &self.solids[index].shape {
                SolidShape::Sphere(sphere) => Round::Ball(sphere),
                SolidShape::Ellipsoid(_) => Round::Other,
            },
        };
        (round, run.material)
    }
}
