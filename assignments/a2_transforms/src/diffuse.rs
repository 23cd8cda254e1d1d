//! A2T2: Lambert's cosine law.

use crate::LocalLight;
use a1_ray_casting::{Layer, Sight, World};
use common::counters::Counters;
use common::math::Vec3;
use common::scene::PhongMaterial;

/// kd · max(0, N·L): the share of light that an ideally matt surface sends to every side.
#[inline]
pub fn diffuse(material: &PhongMaterial, normal: Vec3, to_light: Vec3, _to_viewer: Vec3) -> Vec3 {
    material.diffuse * normal.dot(to_light).max(0.0)
}

/// The picture of assignment 2: ambient and diffuse light.
pub struct DiffuseColor<'a> {
    /// Materials and background.
    pub scene: &'a dyn World,
    /// Its lights.
    pub light: LocalLight<'a>,
}

impl Layer for DiffuseColor<'_> {
    fn value(&self, sight: &Sight, _: &mut Counters) -> Vec3 {
        let Some(surface) = sight.surface() else { return self.scene.as_scene().background.color };
        let mixture = self.scene.at(surface);
        self.light.radiance(surface, &mixture, sight.ray.direction, diffuse)
    }
}
