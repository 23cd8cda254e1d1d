//! Light sources (course rules §4.3 and §4.5; spherical ones §1.5).

use crate::sampling::grid;
use common::math::DVec3;
use common::scene::{LightKind, LightSpec};
use std::f64::consts::TAU;

/// Light arriving at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Arriving {
    /// Unit vector from the point towards the light.
    pub direction: DVec3,
    /// How far away the light is; infinite for directional lights.
    pub distance: f64,
    /// Linear RGB after falloff, before any shadow.
    pub color: DVec3,
}

/// A light of the scene.
#[derive(Clone, Debug)]
pub(crate) struct Light {
    color: DVec3,
    kind: Kind,
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    /// The unit vector towards the light.
    Directional(DVec3),
    /// Position, radius (0 for a point) and the coefficients of 1, d and d².
    Ball(DVec3, f64, [f64; 3]),
}

impl Light {
    pub fn new(spec: &LightSpec) -> Self {
        let kind = match spec.kind {
            LightKind::Directional { direction } => Kind::Directional(-direction.normalize()),
            LightKind::Point { position, attenuation } => {
                Kind::Ball(position, 0.0, attenuation.map(f64::from))
            }
            LightKind::Sphere { center, radius, attenuation } => {
                Kind::Ball(center, radius, attenuation.map(f64::from))
            }
        };
        Self { color: spec.color.as_dvec3(), kind }
    }

    /// What arrives at `point` if nothing is in the way: from a sphere in `side`² directions, or
    /// all from its centre if `side` is 1. Nothing where the falloff's denominator is not above
    /// zero, and nothing exactly at a point light itself.
    pub fn at(&self, point: DVec3, side: u32) -> Vec<Arriving> {
        let (center, radius, [constant, linear, quadratic]) = match self.kind {
            Kind::Directional(direction) => {
                return vec![Arriving { direction, distance: f64::INFINITY, color: self.color }];
            }
            Kind::Ball(center, radius, attenuation) => (center, radius, attenuation),
        };
        let distance = center.distance(point);
        let falloff = constant + linear * distance + quadratic * distance * distance;
        // NaN gives nothing.
        if falloff.is_nan() || falloff <= 0.0 {
            return Vec::new();
        }
        let color = self.color / falloff;
        if radius > 0.0 && side > 1 {
            return from_sphere(center - point, radius, color, side);
        }
        let direction = (center - point) / distance;
        (distance > 0.0).then_some(Arriving { direction, distance, color }).into_iter().collect()
    }
}

/// Light from `side`² directions, uniform over those in which the sphere is seen: a cone, or all
/// of them from inside. `to_center` is the way to the sphere's centre.
fn from_sphere(to_center: DVec3, radius: f64, color: DVec3, side: u32) -> Vec<Arriving> {
    let distance = to_center.length();
    let inside = distance <= radius;
    let axis = to_center.try_normalize().unwrap_or(DVec3::Z);
    let (across, upward) = axis.any_orthonormal_pair();
    // 1 − cos of the cone's half angle, in a form that does not cancel for far spheres.
    let sine = radius / distance;
    let depth = if inside { 2.0 } else { sine * sine / (1.0 + (1.0 - sine * sine).sqrt()) };
    let color = color / f64::from(side * side);
    let towards = |[u, v]: [f64; 2]| {
        let along = 1.0 - u * depth;
        let aside = (1.0 - along * along).max(0.0).sqrt();
        let (sin, cos) = (TAU * v).sin_cos();
        let direction = along * axis + aside * (cos * across + sin * upward);
        let closest = direction.dot(to_center);
        let half_chord = (radius * radius - (distance * aside).powi(2)).max(0.0).sqrt();
        let distance = if inside { closest + half_chord } else { closest - half_chord };
        Arriving { direction, distance, color }
    };
    grid(side).map(towards).collect()
}
