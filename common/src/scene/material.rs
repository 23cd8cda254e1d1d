//! Materials, as written.

use super::{Position, Xform};
use crate::math::Vec3;
use std::path::PathBuf;

/// One entry of the `Materials` block.
#[derive(Clone, Debug, PartialEq)]
pub enum Material {
    /// A plain material.
    Phong(PhongMaterial),
    /// A pattern in space that blends two other materials.
    Solid(SolidTexture),
}

/// Diffuse, specular, mirror and glass parts; colours are linear RGB, black switches a part off.
#[derive(Clone, Debug, PartialEq)]
pub struct PhongMaterial {
    /// kd: white by default.
    pub diffuse: Vec3,
    /// ks of the highlight.
    pub specular: Vec3,
    /// Sharpness of the highlight; 1 by default.
    pub exponent: f32,
    /// kr: weight of the mirrored ray.
    pub reflective: Vec3,
    /// kt: weight of the refracted ray.
    pub transparent: Vec3,
    /// Index of refraction, above zero; 1 by default.
    pub index_of_refraction: f32,
    /// Radiance given off by the surface (an extension).
    pub emissive: Vec3,
    /// Beer–Lambert coefficient per unit length inside the object (an extension).
    pub absorption: Vec3,
    /// Picture that replaces `diffuse` (an extension).
    pub image: Option<ImageTexture>,
}

impl Default for PhongMaterial {
    fn default() -> Self {
        Self {
            diffuse: Vec3::ONE,
            specular: Vec3::ZERO,
            exponent: 1.0,
            reflective: Vec3::ZERO,
            transparent: Vec3::ZERO,
            index_of_refraction: 1.0,
            emissive: Vec3::ZERO,
            absorption: Vec3::ZERO,
            image: None,
        }
    }
}

/// A picture looked up by texture coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct ImageTexture {
    /// The picture file, already resolved against the scene's folder.
    pub file: PathBuf,
    /// How many stand side by side in a unit of u and of v; negative mirrors.
    pub scale: [f32; 2],
    /// Where its keyword stands.
    pub position: Position,
}

/// A pattern p ↦ [0, 1] in space and the two materials it blends.
#[derive(Clone, Debug, PartialEq)]
pub struct SolidTexture {
    /// Which pattern.
    pub kind: SolidTextureKind,
    /// Applied to the world-space hit point as it stands, product of the list.
    pub transform: Vec<Xform>,
    /// Indices of the blended materials, both smaller than this material's own.
    pub children: [u32; 2],
    /// Where its keyword stands.
    pub position: Position,
}

/// The patterns of the course.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SolidTextureKind {
    /// Alternating unit cubes.
    Checkerboard,
    /// A sum of noise octaves.
    Noise {
        /// Number of octaves.
        octaves: u32,
    },
    /// Sine stripes along x, disturbed by noise.
    Marble {
        /// Number of octaves of the noise.
        octaves: u32,
        /// Stripes: factor of x inside the sine.
        frequency: f32,
        /// How strongly the noise disturbs them.
        amplitude: f32,
    },
    /// Sine rings around the y axis, disturbed by noise.
    Wood {
        /// Number of octaves of the noise.
        octaves: u32,
        /// Rings: factor of the distance from the axis inside the sine.
        frequency: f32,
        /// How strongly the noise disturbs them.
        amplitude: f32,
    },
}
