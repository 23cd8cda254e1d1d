//! Materials in double precision.

use crate::OracleError;
use common::math::DVec3;
use common::scene::{Material, Position};

/// What a surface does to light; colours are linear RGB.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// kd.
    pub diffuse: DVec3,
    /// ks of the highlight.
    pub specular: DVec3,
    /// Sharpness of the highlight.
    pub exponent: f64,
    /// kr: weight of the mirrored ray.
    pub reflective: DVec3,
    /// kt: weight of the refracted ray.
    pub transparent: DVec3,
    /// Index of refraction of the inside; outside it is 1.
    pub index_of_refraction: f64,
    /// Beer–Lambert coefficient per unit length of the inside.
    pub absorption: DVec3,
}

impl Surface {
    /// Takes over a material. `position` is that of the shape that uses it, for errors:
    /// textures and image textures are refused. Emission is ignored, as in assignments 1 to 5.
    pub(crate) fn new(material: &Material, position: Position) -> Result<Self, OracleError> {
        match material {
            Material::Phong(m) if m.image.is_none() => Ok(Self {
                diffuse: m.diffuse.as_dvec3(),
                specular: m.specular.as_dvec3(),
                exponent: f64::from(m.exponent),
                reflective: m.reflective.as_dvec3(),
                transparent: m.transparent.as_dvec3(),
                index_of_refraction: f64::from(m.index_of_refraction),
                absorption: m.absorption.as_dvec3(),
            }),
            _ => Err(OracleError::Texture(position)),
        }
    }

    /// Does light pass through?
    pub fn is_transparent(&self) -> bool {
        self.transparent != DVec3::ZERO
    }
}
