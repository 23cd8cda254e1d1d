//! A8T1: what surfaces do with light.
//!
//! A [`Bsdf`] is what a material of the scene file is to a path: four lobes, of which a path takes
//! one at random. Whatever the file says, no more light leaves than arrives: a material whose
//! parts sum to more than 1 is dimmed until they do not.
//!
//! | part | lobe |
//! |---|---|
//! | `diffuseColor` kd | matt, kd/π, on both sides |
//! | `specularColor` ks | highlight around the half vector, as in the pictures of assignment 3, scaled so that it sends back at most ks |
//! | `reflectiveColor` kr | perfect mirror |
//! | `transparentColor` kt | smooth glass: Fresnel's share is mirrored, the rest refracted |
//!
//! Radiance is counted in units of the squared index of refraction (*basic radiance*), which does
//! not change at a surface of clear glass.

mod glossy;
mod sample;

pub use glossy::Glossy;
pub use sample::Scattered;

use common::math::Vec3;
use common::scene::PhongMaterial;
use std::f32::consts::FRAC_1_PI;

/// What a surface does with light at a point.
#[derive(Clone, Copy, Debug)]
pub struct Bsdf {
    diffuse: Vec3,
    glossy: Glossy,
    mirror: Vec3,
    glass: Vec3,
    index_of_refraction: f32,
    /// Chance of each lobe, in this order; they sum to 1, or to 0 if all is black.
    chances: [f32; 4],
}

/// Light that a surface sends on, and how likely the way is to be taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Value {
    /// The BSDF times the cosine of the angle to the light.
    pub response: Vec3,
    /// Density of [`Bsdf::sample`] in this direction, per steradian.
    pub pdf: f32,
}

impl Bsdf {
    /// Of a plain material.
    pub fn new(material: &PhongMaterial) -> Self {
        let m = material;
        let total = m.diffuse + m.specular + m.reflective + m.transparent;
        let dim = 1.0 / total.max_element().max(1.0);
        let parts = [m.diffuse, m.specular, m.reflective, m.transparent].map(|part| part * dim);
        let [diffuse, specular, mirror, glass] = parts;
        let sum: f32 = parts.iter().map(|p| p.element_sum()).sum();
        let chances = parts.map(|p| if sum > 0.0 { p.element_sum() / sum } else { 0.0 });
        let glossy = Glossy::new(specular, m.exponent);
        Self { diffuse, glossy, mirror, glass, index_of_refraction: m.index_of_refraction, chances }
    }

    /// Whether no light leaves at all.
    #[inline]
    pub fn is_black(&self) -> bool {
        self.chances == [0.0; 4]
    }

    /// Whether light from any direction but one or two counts for nothing: then lights need not
    /// be asked.
    #[inline]
    pub fn is_specular(&self) -> bool {
        self.chances[0] + self.chances[1] == 0.0
    }

    /// Whether all light that is sent on is scattered by the matt lobe.
    #[inline]
    pub fn is_matt(&self) -> bool {
        self.chances[0] == 1.0
    }

    /// The colour of a surface that only scatters light by the matt lobe.
    #[inline]
    pub fn matt_color(&self) -> Option<Vec3> {
        self.is_matt().then_some(self.diffuse)
    }

    /// The colour of a surface that only mirrors light, or of one that is glass and nothing else, with
    /// the index of refraction.
    #[inline]
    pub fn smooth_color(&self) -> Option<(Vec3, Option<f32>)> {
        match self.chances {
            [0.0, 0.0, 1.0, 0.0] => Some((self.mirror, None)),
            [0.0, 0.0, 0.0, 1.0] => Some((self.glass, Some(self.index_of_refraction))),
            _ => None,
        }
    }

    /// What is mirrored whatever the angle, what is shared by Fresnel's equations, and the index of
    /// refraction of that.
    pub fn specular_parts(&self) -> (Vec3, Vec3, f32) {
        (self.mirror, self.glass, self.index_of_refraction)
    }

    /// Share of light that is sent on, for pictures of the albedo: of the highlight what it sends
    /// back at most, of glass all.
    pub fn albedo(&self) -> Vec3 {
        self.diffuse + self.glossy.color + self.mirror + self.glass
    }

    /// The matt and the glossy lobe for light from `into`, seen from `out`; all unit vectors that
    /// point away from the surface. `normal` is on the side of `out`. Mirrors and glass send
    /// nothing between two given directions.
    #[inline]
    pub fn value(&self, out: Vec3, into: Vec3, normal: Vec3) -> Value {
        let cosine = normal.dot(into);
        if cosine <= 0.0 {
            return Value { response: Vec3::ZERO, pdf: 0.0 };
        }
        let matt = Value {
            response: self.diffuse * (FRAC_1_PI * cosine),
            pdf: self.chances[0] * (FRAC_1_PI * cosine),
        };
        if self.chances[1] == 0.0 {
            return matt;
        }
        let (lobe, density) = self.glossy.value(out, into, normal);
        Value {
            response: matt.response + self.glossy.color * (lobe * cosine),
            pdf: matt.pdf + self.chances[1] * density,
        }
    }
}
