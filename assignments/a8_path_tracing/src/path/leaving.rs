//! How paths leave surfaces, material by material.

use crate::bsdf::Bsdf;
use common::math::Vec3;
use common::scene::PhongMaterial;

/// How paths leave the surfaces of a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Leaving {
    /// Eight at a time, by the matt lobe, which has this colour.
    Matt(Vec3),
    /// Eight at a time, mirrored or refracted.
    Smooth {
        /// Share of light that is sent on.
        color: Vec3,
        /// Index of refraction of glass; 0 for mirrors.
        index: f32,
        /// Light lost on the way through the body.
        absorption: Vec3,
    },
    /// One by one, since several things may happen, or light is given off.
    Alone,
    /// Another material at every point.
    Textured,
}

impl Leaving {
    /// Of a material; `None` if it is textured.
    pub fn of(material: Option<&PhongMaterial>) -> Self {
        let Some(material) = material else { return Self::Textured };
        let bsdf = Bsdf::new(material);
        if material.emissive != Vec3::ZERO {
            return Self::Alone;
        }
        if let Some(color) = bsdf.matt_color() {
            return Self::Matt(color);
        }
        let absorption = material.absorption;
        let smooth = bsdf.smooth_color().filter(|(_, index)| index.is_none_or(|index| index > 0.0));
        smooth.map_or(Self::Alone, |(color, index)| Self::Smooth {
            color,
            index: index.unwrap_or(0.0),
            absorption,
        })
    }
}
