//! What surfaces are made of: the seam that textures fill.
//!
//! Most materials are the same all over. A texture is not: what it is made of at a point is a
//! [`Mixture`] of such plain materials. The steps that shade ask a [`World`] for the mixture and
//! need not know where it comes from; up to assignment 5 the world is the [`Scene`] itself.

use common::geometry::Surface;
use common::math::{DVec3, Vec3};
use common::scene::{Material, PhongMaterial, Scene};
use std::borrow::Cow;

/// A scene in which every surface point is known to be made of something.
pub trait World: Sync {
    /// What the file says of it.
    fn as_scene(&self) -> &Scene;

    /// The material of this index if it is the same all over; `None` if only a point can tell.
    /// Lets a caller that has not worked out the surface point do without it.
    fn plain(&self, index: u32) -> Option<&PhongMaterial>;

    /// The plain material that a surface of this material is made of at a point, if it is one and the
    /// point alone can tell.
    fn leaf(&self, material: u32, point: DVec3) -> Option<u32> {
        let _ = point;
        self.plain(material).map(|_| material)
    }

    /// What the surface is made of at this point.
    fn at(&self, surface: &Surface) -> Mixture<'_>;
}

/// Plain materials and their shares. What holds for the mixture (the light it sends on, the
/// colour of its mirror, …) is the weighted sum of what holds for each.
#[derive(Clone, Debug, PartialEq)]
pub enum Mixture<'a> {
    /// One material, unmixed.
    Plain(&'a PhongMaterial),
    /// Several, or one that exists at this point only; their weights sum to 1.
    Blend(Vec<Part<'a>>),
}

/// One material of a [`Mixture`].
#[derive(Clone, Debug, PartialEq)]
pub struct Part<'a> {
    /// Its share, above 0 and at most 1.
    pub weight: f32,
    /// What it is like here.
    pub material: Cow<'a, PhongMaterial>,
}

impl Mixture<'_> {
    /// The weighted sum of a property; for an unmixed material the property itself, to the bit.
    #[inline]
    pub fn blend(&self, property: impl Fn(&PhongMaterial) -> Vec3) -> Vec3 {
        match self {
            Self::Plain(material) => property(material),
            Self::Blend(parts) => parts.iter().map(|p| property(&p.material) * p.weight).sum(),
        }
    }

    /// Its materials with their weights.
    pub fn parts(&self) -> impl Iterator<Item = (f32, &PhongMaterial)> + Clone {
        let (one, several): (Option<&PhongMaterial>, &[Part]) = match self {
            Self::Plain(material) => (Some(material), &[]),
            Self::Blend(parts) => (None, parts),
        };
        one.into_iter().map(|m| (1.0, m)).chain(several.iter().map(|p| (p.weight, &*p.material)))
    }
}

/// A scene without textures. [`crate::Studio::open`] lets no other pass.
impl World for Scene {
    fn as_scene(&self) -> &Scene {
        self
    }

    fn plain(&self, index: u32) -> Option<&PhongMaterial> {
        match &self.materials[index as usize] {
            Material::Phong(material) => Some(material),
            Material::Solid(_) => None,
        }
    }

    /// # Panics
    /// If the material is a texture.
    fn at(&self, surface: &Surface) -> Mixture<'_> {
        match self.plain(surface.material) {
            Some(material) => Mixture::Plain(material),
            None => unreachable!("scenes with textures are refused when they are opened"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(level: f32) -> PhongMaterial {
        PhongMaterial { diffuse: Vec3::splat(level), ..PhongMaterial::default() }
    }

    #[test]
    fn a_blend_is_the_weighted_sum() {
        let part = |weight, level| Part { weight, material: Cow::Owned(grey(level)) };
        let mixture = Mixture::Blend(vec![part(0.25, 1.0), part(0.5, 0.5), part(0.25, 0.0)]);
        assert_eq!(mixture.blend(|m| m.diffuse), Vec3::splat(0.5));
        assert_eq!(mixture.parts().map(|(weight, _)| weight).sum::<f32>(), 1.0);
    }

    #[test]
    fn a_plain_material_is_itself_to_the_bit() {
        let material = grey(0.1);
        let mixture = Mixture::Plain(&material);
        assert_eq!(mixture.blend(|m| m.diffuse), material.diffuse);
        assert_eq!(mixture.parts().collect::<Vec<_>>(), [(1.0, &material)]);
    }
}
