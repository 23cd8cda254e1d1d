//! What a picture makes of a pixel's nearest hit.

use common::counters::Counters;
use common::geometry::{Geometry, Hit, Surface};
use common::math::Vec3;
use common::ray::Ray;
use common::scene::{Material, PhongMaterial, Scene};
use std::cell::OnceCell;

/// One camera ray and what it met. The surface point is worked out when first asked for, and
/// only then: a depth picture never needs it.
pub struct Sight<'a> {
    /// The camera ray, of unit direction.
    pub ray: Ray,
    /// The nearest hit; `None` also when no layer needs one.
    pub hit: Option<Hit>,
    geometry: &'a Geometry,
    surface: OnceCell<Surface>,
}

impl<'a> Sight<'a> {
    /// A sight whose surface is not yet worked out.
    pub fn new(geometry: &'a Geometry, ray: Ray, hit: Option<Hit>) -> Self {
        Self { ray, hit, geometry, surface: OnceCell::new() }
    }

    /// The surface point of the hit.
    pub fn surface(&self) -> Option<&Surface> {
        let hit = self.hit.as_ref()?;
        Some(self.surface.get_or_init(|| self.geometry.surface(&self.ray, hit)))
    }
}

/// A picture as a function of what each pixel's ray met.
pub trait Layer: Sync {
    /// Linear RGB of one camera ray.
    fn value(&self, sight: &Sight, counters: &mut Counters) -> Vec3;

    /// Whether it looks at the nearest hit at all; if no layer does, none is searched for.
    fn needs_hit(&self) -> bool {
        true
    }
}

/// A1T2: the diffuse colour of what was hit, unlit.
pub struct FlatColor<'a> {
    scene: &'a Scene,
}

impl<'a> FlatColor<'a> {
    /// The colours of this scene.
    pub fn new(scene: &'a Scene) -> Self {
        Self { scene }
    }
}

impl Layer for FlatColor<'_> {
    fn value(&self, sight: &Sight, _: &mut Counters) -> Vec3 {
        let Some(hit) = &sight.hit else { return self.scene.background.color };
        plain_material(self.scene, sight.geometry.material(hit.primitive)).diffuse
    }
}

/// A material that is no texture.
///
/// # Panics
/// If it is one; [`crate::Studio::open`] refuses such scenes before the first ray.
pub fn plain_material(scene: &Scene, index: u32) -> &PhongMaterial {
    match &scene.materials[index as usize] {
        Material::Phong(m) => m,
        Material::Solid(_) => unreachable!("scenes with textures are refused when they are opened"),
    }
}

/// A1T3: distance as grey, near white and far black; what is missed is black.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Depth {
    /// The distance that is white.
    pub min: f32,
    /// The distance that is black.
    pub max: f32,
}

impl Layer for Depth {
    fn value(&self, sight: &Sight, _: &mut Counters) -> Vec3 {
        let grey = |t: f32| ((self.max - t) / (self.max - self.min)).clamp(0.0, 1.0);
        sight.hit.map_or(Vec3::ZERO, |hit| Vec3::splat(grey(hit.t)))
    }
}
