//! A2T2: light at a surface point, straight from the sources.

use crate::{Incident, incident};
use common::cli::Skip;
use common::geometry::Surface;
use common::math::Vec3;
use common::scene::{PhongMaterial, Scene};

/// What stands between a surface and a light.
pub trait Visibility {
    /// The share of the light, per colour channel, that reaches the surface.
    fn transmitted(&mut self, surface: &Surface, light: &Incident) -> Vec3;

    /// Told that a light adds nothing here, and why; returns whether to leave it out.
    fn skip(&mut self, why: Skip) -> bool;
}

/// Nothing stands between.
pub struct Unshadowed;

impl Visibility for Unshadowed {
    fn transmitted(&mut self, _: &Surface, _: &Incident) -> Vec3 {
        Vec3::ONE
    }

    fn skip(&mut self, _: Skip) -> bool {
        true
    }
}

/// The scene's lights, and how surfaces seen from behind are treated.
#[derive(Clone, Copy)]
pub struct LocalLight<'a> {
    /// Lights and ambient light.
    pub scene: &'a Scene,
    /// Light both sides.
    pub shade_back: bool,
}

impl LocalLight<'_> {
    /// Ambient and direct light that `surface` sends back against `view` (the unit direction of
    /// the ray that hit it). `reflect` is the share of one light that the material sends on,
    /// given normal, direction to the light and direction to the viewer, all unit; it must be
    /// black for light from behind.
    ///
    /// A surface seen from behind is black, ambient light included, unless `shade_back` turns
    /// its normal round first.
    pub fn radiance(
        &self,
        surface: &Surface,
        material: &PhongMaterial,
        view: Vec3,
        reflect: impl Fn(&PhongMaterial, Vec3, Vec3, Vec3) -> Vec3,
        visibility: &mut impl Visibility,
    ) -> Vec3 {
        let from_behind = view.dot(surface.normal) > 0.0;
        if from_behind && !self.shade_back {
            return Vec3::ZERO;
        }
        let normal = if from_behind { -surface.normal } else { surface.normal };
        let mut radiance = self.scene.background.ambient_light * material.diffuse;
        for light in &self.scene.lights {
            let light = incident(light, surface.point);
            if adds_nothing(&light, normal).is_some_and(|why| visibility.skip(why)) {
                continue;
            }
            let reflected = reflect(material, normal, light.direction, -view);
            radiance += visibility.transmitted(surface, &light) * light.color * reflected;
        }
        radiance
    }
}

/// Why a light need not be looked at, if so.
fn adds_nothing(light: &Incident, normal: Vec3) -> Option<Skip> {
    if light.color == Vec3::ZERO {
        return Some(Skip::Dark);
    }
    // Written so that NaN counts as behind.
    let in_front = normal.dot(light.direction) > 0.0;
    (!in_front).then_some(Skip::Behind)
}
