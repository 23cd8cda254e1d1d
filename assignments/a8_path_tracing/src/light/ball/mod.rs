//! Light that comes to a point over a ball of mirror or glass.
//!
//! A path meets a small lamp's image in a ball so rarely that pictures are full of bright dots.
//! But a ball has an axis through any point, and all that a ray does at it happens in one plane:
//! which ways lead from a point over the ball to another is a question of one angle, and has at
//! most one answer by reflection and three by refraction in and out (Mitchell & Hanrahan,
//! "Illumination from curved reflectors", 1992, answer it for other shapes by iteration).

mod plane;
mod root;
#[cfg(test)]
mod tests;

use crate::bsdf::Bsdf;
use a4_whitted::refract;
use common::geometry::{Geometry, SolidShape};
use common::math::{DVec3, Vec3};
use common::shape::sphere::Sphere;
use plane::Plane;

/// A ball that mirrors or refracts.
#[derive(Clone, Copy, Debug)]
pub struct Ball {
    /// Its primitive.
    pub primitive: u32,
    sphere: Sphere,
    mirror: Vec3,
    glass: Vec3,
    index_of_refraction: f64,
    absorption: Vec3,
}

/// A way from a point over a ball to a point of a light.
#[derive(Clone, Copy, Debug)]
pub struct BallWay {
    /// Unit direction at its beginning.
    pub direction: DVec3,
    /// Where it meets the ball first.
    pub entry: DVec3,
    /// Where it leaves the ball, if it goes through.
    pub exit: Option<DVec3>,
    /// Where it comes from at the light: unit direction towards the light.
    pub arrival: DVec3,
    /// What is left of the light.
    pub share: Vec3,
    /// Solid angle of directions at the beginning for an area at the light, were it seen upright.
    pub per_area: f64,
}

impl Ball {
    /// All balls among the primitives that mirror or refract in the same way all over; `plain`
    /// gives the lobes of such a material, with its absorption.
    pub fn all(geometry: &Geometry, plain: impl Fn(u32) -> Option<(Bsdf, Vec3)>) -> Vec<Self> {
        let ball = |solid: &common::geometry::Solid| {
            let SolidShape::Sphere(sphere) = solid.shape else { return None };
            let (bsdf, absorption) = plain(geometry.material(solid.primitive))?;
            let (mirror, glass, index) = bsdf.specular_parts();
            let worth = mirror != Vec3::ZERO || glass != Vec3::ZERO;
            (worth && (glass == Vec3::ZERO || index >= 1.0)).then_some(Self {
                primitive: solid.primitive,
                sphere,
                mirror,
                glass,
                index_of_refraction: f64::from(index),
                absorption,
            })
        };
        geometry.solids().iter().filter_map(ball).collect()
    }

    /// Its centre.
    pub fn center(&self) -> DVec3 {
        self.sphere.center
    }

    /// [`BallWay::per_area`] of the way that begins with this direction, if it leads to the second
    /// point; `None` where it cannot be told.
    pub fn per_area(&self, from: DVec3, direction: DVec3, to: DVec3, through: bool) -> Option<f64> {
        let plane = Plane::new(self, from, to)?;
        let off = (self.sphere.center - from).cross(direction).length();
        let angle = (off / self.sphere.radius).min(1.0).asin();
        let slope = if through { plane.swept_refracted(angle).1 } else { plane.swept_mirrored(angle).1 };
        let per_area = plane.per_area(angle, slope);
        per_area.is_finite().then_some(per_area)
    }

    /// Its radius.
    pub fn radius(&self) -> f64 {
        self.sphere.radius
    }

    /// All ways between two points outside: mirrored once, or refracted in and out where
    /// `through` says so. There are at most four.
    pub fn ways(&self, from: DVec3, to: DVec3, through: bool) -> impl Iterator<Item = BallWay> {
        let plane = Plane::new(self, from, to);
        let mirrored = plane.as_ref().and_then(Plane::mirrored);
        let through = through && self.glass != Vec3::ZERO;
        let refracted = plane.filter(|_| through).map_or([None; 3], |plane| plane.refracted());
        [mirrored].into_iter().chain(refracted).flatten()
    }

    /// What is left of light on a way; by symmetry Fresnel's share is the same on both sides.
    fn share(&self, direction: DVec3, normal: DVec3, through: bool, inner: f64) -> Vec3 {
        let mirrored = match self.glass == Vec3::ZERO {
            true => 1.0,
            false => refract(direction, normal, self.index_of_refraction).reflectance,
        };
        if !through {
            return self.mirror + self.glass * mirrored as f32;
        }
        let chord = (2.0 * self.sphere.radius * inner.cos()) as f32;
        self.glass
            * self.glass
            * ((1.0 - mirrored) * (1.0 - mirrored)) as f32
            * (self.absorption * -chord).exp()
    }
}
