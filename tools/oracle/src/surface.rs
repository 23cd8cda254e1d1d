//! Plain materials in double precision.

use common::math::DVec3;
use common::scene::PhongMaterial;

/// What a surface does to light; colours are linear RGB.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// kd.
    pub diffuse: DVec3,
    /// Radiance that the surface sends out by itself.
    pub emissive: DVec3,
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
    /// Takes over a material, all but its picture.
    pub(crate) fn new(material: &PhongMaterial) -> Self {
        Self {
            diffuse: material.diffuse.as_dvec3(),
            emissive: material.emissive.as_dvec3(),
            specular: material.specular.as_dvec3(),
            exponent: f64::from(material.exponent),
            reflective: material.reflective.as_dvec3(),
            transparent: material.transparent.as_dvec3(),
            index_of_refraction: f64::from(material.index_of_refraction),
            absorption: material.absorption.as_dvec3(),
        }
    }

    /// Does light pass through?
    pub fn is_transparent(&self) -> bool {
        self.transparent != DVec3::ZERO
    }
}
