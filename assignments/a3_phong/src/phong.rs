//! A3T1: the highlight.

use crate::Specular;
use a1_ray_casting::{Layer, Sight, World};
use a2_transforms::{LocalLight, diffuse};
use common::counters::Counters;
use common::geometry::Surface;
use common::math::Vec3;
use common::scene::PhongMaterial;

/// Diffuse reflection with a highlight.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Phong {
    /// Form of the highlight.
    pub specular: Specular,
}

impl Phong {
    /// kd·max(0, N·L) + ks·max(0, cos α)ⁿ·max(0, N·L), with α between normal and half vector
    /// or, on demand, between mirrored light direction and viewer. The second factor N·L keeps
    /// highlights off the side that the light does not reach.
    #[inline]
    pub fn reflect(&self, material: &PhongMaterial, normal: Vec3, to_light: Vec3, to_viewer: Vec3) -> Vec3 {
        let matt = diffuse(material, normal, to_light, to_viewer);
        if material.specular == Vec3::ZERO {
            return matt;
        }
        let cosine = match self.specular {
            Specular::Blinn => normal.dot((to_light + to_viewer).normalize_or_zero()),
            Specular::Phong => (normal * (2.0 * normal.dot(to_light)) - to_light).dot(to_viewer),
        };
        // Written so that NaN has no highlight.
        let lit = normal.dot(to_light);
        if !(cosine > 0.0 && lit > 0.0) && material.exponent > 0.0 {
            return matt;
        }
        let highlight = cosine.max(0.0).powf(material.exponent) * lit.max(0.0);
        matt + material.specular * highlight
    }
}

/// The picture of assignment 3: ambient, diffuse and specular light.
pub struct PhongColor<'a> {
    /// Materials and background.
    pub scene: &'a dyn World,
    /// Its lights.
    pub light: LocalLight<'a>,
    /// The reflection model.
    pub phong: Phong,
}

impl PhongColor<'_> {
    /// The light that a surface sends back against `view`, the unit direction of sight. The
    /// preview asks for it at corners of polygons, the ray tracer at hits.
    pub fn shade(&self, surface: &Surface, view: Vec3) -> Vec3 {
        let mixture = self.scene.at(surface);
        let reflect = |m: &PhongMaterial, n, l, v| self.phong.reflect(m, n, l, v);
        self.light.radiance(surface, &mixture, view, reflect)
    }
}

impl Layer for PhongColor<'_> {
    fn value(&self, sight: &Sight, _: &mut Counters) -> Vec3 {
        let Some(surface) = sight.surface() else { return self.scene.as_scene().background.color };
        self.shade(surface, sight.ray.direction)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn glossy(exponent: f32) -> PhongMaterial {
        PhongMaterial { diffuse: Vec3::ZERO, specular: Vec3::ONE, exponent, ..PhongMaterial::default() }
    }

    #[test]
    fn a3t1_peak_is_at_the_mirror_direction_in_both_forms() {
        let (l, v) = (Vec3::new(0.6, 0.8, 0.0), Vec3::new(-0.6, 0.8, 0.0));
        for specular in [Specular::Blinn, Specular::Phong] {
            let at_peak = Phong { specular }.reflect(&glossy(50.0), Vec3::Y, l, v);
            assert!((at_peak.x - 0.8).abs() < 1e-5, "{specular:?} {at_peak}");
        }
    }

    #[test]
    fn a3t1_no_highlight_on_the_dark_side() {
        let below = Vec3::new(0.1, -0.995, 0.0);
        for specular in [Specular::Blinn, Specular::Phong] {
            assert_eq!(Phong { specular }.reflect(&glossy(1.0), Vec3::Y, below, Vec3::Y), Vec3::ZERO);
        }
    }

    /// Near the peak the half vector turns half as fast, so exponent n in one form looks like
    /// 4n in the other.
    #[test]
    fn a3t1_forms_agree_at_a_quarter_of_the_exponent() {
        let (s, c) = 0.1f32.sin_cos();
        let v = Vec3::new(s, c, 0.0);
        let blinn = Phong { specular: Specular::Blinn }.reflect(&glossy(80.0), Vec3::Y, Vec3::Y, v);
        let phong = Phong { specular: Specular::Phong }.reflect(&glossy(20.0), Vec3::Y, Vec3::Y, v);
        assert!((blinn.x - phong.x).abs() < 0.002, "{blinn} {phong}");
    }
}
