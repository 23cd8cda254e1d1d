//! A2T2: light at a surface point, straight from the sources.

use crate::{Incident, incident};
use a1_ray_casting::Mixture;
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
    /// the ray that hit it). `reflect` is the share of one light that a material sends on, given
    /// normal, direction to the light and direction to the viewer, all unit; a mixture sends on
    /// the weighted sum. It must be black for light from behind. However many materials are
    /// mixed, what stands before a light is asked for once.
    ///
    /// A surface seen from behind is black, ambient light included, unless `shade_back` turns
    /// its normal round first.
    pub fn radiance(
        &self,
        surface: &Surface,
        mixture: &Mixture,
        view: Vec3,
        reflect: impl Fn(&PhongMaterial, Vec3, Vec3, Vec3) -> Vec3,
        visibility: &mut impl Visibility,
    ) -> Vec3 {
        let from_behind = view.dot(surface.normal) > 0.0;
        if from_behind && !self.shade_back {
            return Vec3::ZERO;
        }
        let side = if from_behind { -1.0 } else { 1.0 };
        let normal = surface.normal * side;
        let mut radiance = self.scene.background.ambient_light * mixture.blend(|m| m.diffuse);
        for light in &self.scene.lights {
            let light = incident(light, surface.point);
            let nothing = adds_nothing(&light, surface, side);
            if nothing.is_some_and(|why| visibility.skip(why)) {
                continue;
            }
            let reflected = match nothing {
                Some(Skip::Behind) => Vec3::ZERO,
                _ => mixture.blend(|m| reflect(m, normal, light.direction, -view)),
            };
            radiance += visibility.transmitted(surface, &light) * light.color * reflected;
        }
        radiance
    }
}

/// Why a light need not be looked at, if so. `side` is 1 if the viewer is on the side of the
/// surface's normal, else −1.
///
/// A smooth normal may lean towards a light that the surface itself turns its back to. Such
/// light would have to come through the surface, so it does not count.
fn adds_nothing(light: &Incident, surface: &Surface, side: f32) -> Option<Skip> {
    if light.color == Vec3::ZERO {
        return Some(Skip::Dark);
    }
    let through = || {
        surface.is_smooth()
            && surface.geometric_normal.dot(light.direction.as_dvec3()) * f64::from(side) <= 0.0
    };
    // Written so that NaN counts as behind.
    let in_front = surface.normal.dot(light.direction) * side > 0.0 && !through();
    (!in_front).then_some(Skip::Behind)
}
