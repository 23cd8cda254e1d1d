//! Lights, and what arrives from them at a point.

use common::math::DVec3;
use common::scene::{LightKind, LightSpec};

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

/// A light of the scene. A spherical one acts as a point at its centre: soft shadows come with
/// assignment 7.
#[derive(Clone, Debug)]
pub(crate) struct Light {
    color: DVec3,
    kind: Kind,
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    /// The unit vector towards the light.
    Directional(DVec3),
    /// Position and the coefficients of 1, d and d².
    Point(DVec3, [f64; 3]),
}

impl Light {
    pub fn new(spec: &LightSpec) -> Self {
        let kind = match spec.kind {
            LightKind::Directional { direction } => Kind::Directional(-direction.normalize()),
            LightKind::Point { position: p, attenuation }
            | LightKind::Sphere { center: p, attenuation, .. } => Kind::Point(p, attenuation.map(f64::from)),
        };
        Self { color: spec.color.as_dvec3(), kind }
    }

    /// What arrives at `point` if nothing is in the way. Nothing where the falloff's
    /// denominator is not above zero, and nothing exactly at the light itself.
    pub fn at(&self, point: DVec3) -> Option<Arriving> {
        match self.kind {
            Kind::Directional(direction) => {
                Some(Arriving { direction, distance: f64::INFINITY, color: self.color })
            }
            Kind::Point(position, [constant, linear, quadratic]) => {
                let distance = position.distance(point);
                let falloff = constant + linear * distance + quadratic * distance * distance;
                (distance > 0.0 && falloff > 0.0).then(|| Arriving {
                    direction: (position - point) / distance,
                    distance,
                    color: self.color / falloff,
                })
            }
        }
    }
}
