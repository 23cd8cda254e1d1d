//! A2T2: light at a surface point, straight from the sources.

use crate::{Incident, Source, incident, source};
use a1_ray_casting::Mixture;
use common::cli::Skip;
use common::geometry::Surface;
use common::math::{DVec3, Vec3};
use common::scene::{PhongMaterial, Scene};

/// Where light comes from: a seam for lights that have an extent, and for shadows.
///
/// A light of one point or one direction takes one look. A larger one takes several, each at a
/// point of its own, and what these looks find is added up.
pub trait Lamps {
    /// How many looks the light at a surface point takes.
    fn looks(&self, scene: &Scene) -> usize {
        scene.lights.len()
    }

    /// The light of one look that arrives at the surface, were nothing in between.
    #[inline]
    fn look(&mut self, scene: &Scene, index: usize, surface: &Surface) -> Incident {
        incident(&scene.lights[index], surface.point)
    }

    /// Where the light of one look comes from, if that is known without looking and nothing is
    /// missed by not looking.
    fn source(&self, _scene: &Scene, _index: usize) -> Option<Source> {
        None
    }

    /// Told that a look adds nothing here, and why; returns whether to leave it out.
    fn skip(&mut self, _: Skip) -> bool {
        true
    }
}

/// One look for each light, at its centre.
pub struct Centres;

impl Lamps for Centres {
    fn source(&self, scene: &Scene, index: usize) -> Option<Source> {
        Some(source(&scene.lights[index]))
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
    /// Light that `surface` sends against `view` (the unit direction of the ray that hit it),
    /// nothing standing between it and the lights; see [`LocalLight::gather`].
    pub fn radiance(
        &self,
        surface: &Surface,
        mixture: &Mixture,
        view: Vec3,
        reflect: impl Fn(&PhongMaterial, Vec3, Vec3, Vec3) -> Vec3,
    ) -> Vec3 {
        let mut direct = Vec3::ZERO;
        let add = |_: usize, _: &Incident, reflected: Vec3| direct += reflected;
        let own = self.gather(surface, mixture, view, reflect, &mut Centres, add);
        own + direct
    }

    /// The surface's own light and what it returns of ambient light; then, told to `each` look by
    /// look, what it would return of the lights if nothing stood before them.
    ///
    /// `reflect` is the share of one light that a material sends on, given normal, direction to
    /// the light and direction to the viewer, all unit; a mixture sends on the weighted sum. It
    /// must be black for light from behind. However many materials are mixed, a light is told of
    /// once.
    ///
    /// A surface seen from behind is black, its own light included, unless `shade_back` turns its
    /// normal round first.
    #[inline(always)]
    pub fn gather(
        &self,
        surface: &Surface,
        mixture: &Mixture,
        view: Vec3,
        reflect: impl Fn(&PhongMaterial, Vec3, Vec3, Vec3) -> Vec3,
        lamps: &mut impl Lamps,
        mut each: impl FnMut(usize, &Incident, Vec3),
    ) -> Vec3 {
        let from_behind = view.dot(surface.normal) > 0.0;
        if from_behind && !self.shade_back {
            return Vec3::ZERO;
        }
        let normal = if from_behind { -surface.normal } else { surface.normal };
        let leaning_from = surface.is_smooth().then_some(match from_behind {
            true => -surface.geometric_normal,
            false => surface.geometric_normal,
        });
        for index in 0..lamps.looks(self.scene) {
            let light = lamps.look(self.scene, index, surface);
            let nothing = adds_nothing(&light, normal, leaning_from);
            if nothing.is_some_and(|why| lamps.skip(why)) {
                continue;
            }
            let reflected = match nothing {
                Some(Skip::Behind) => Vec3::ZERO,
                _ => mixture.blend(|m| reflect(m, normal, light.direction, -view)),
            };
            each(index, &light, light.color * reflected);
        }
        self.own(mixture)
    }

    /// What a surface sends on whatever the lights do: its own light and its share of ambient light.
    #[inline(always)]
    pub fn own(&self, mixture: &Mixture) -> Vec3 {
        let ambient = self.scene.background.ambient_light;
        mixture.blend(|m| m.emissive) + ambient * mixture.blend(|m| m.diffuse)
    }
}

/// Why a light need not be looked at, if so. `normal` points to the viewer's side, and so does
/// the normal of the surface itself, which is given if `normal` leans away from it. A smooth one
/// may lean towards a light that the surface turns its back to; such light would have to come
/// through the surface, so it does not count.
#[inline(always)]
fn adds_nothing(light: &Incident, normal: Vec3, leaning_from: Option<DVec3>) -> Option<Skip> {
    if light.color == Vec3::ZERO {
        return Some(Skip::Dark);
    }
    // Written so that NaN counts as behind.
    let in_front = normal.dot(light.direction) > 0.0
        && leaning_from.is_none_or(|own| own.dot(light.direction.as_dvec3()) > 0.0);
    (!in_front).then_some(Skip::Behind)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diffuse;
    use common::mesh::{Mesh, MeshError};
    use common::scene::{MeshSource, PhongMaterial, parse_str};
    use std::sync::Arc;

    struct NoMesh;

    impl MeshSource for NoMesh {
        fn mesh(&mut self, name: &str) -> Result<Arc<Mesh>, MeshError> {
            Err(MeshError::new(format!("no mesh `{name}` here")))
        }
    }

    /// A lamp that shines along `direction`, and no ambient light.
    fn lit(direction: &str) -> Scene {
        let text = format!(
            "PerspectiveCamera {{ center 0 0 5 direction 0 0 -1 up 0 1 0 angle 40 }}
             Lights {{ numLights 1 DirectionalLight {{ direction {direction} color 1 1 1 }} }}
             Group {{ numObjects 0 }}"
        );
        parse_str("test", &text, &mut NoMesh).unwrap_or_else(|e| panic!("{e}"))
    }

    /// Looks at everything, also at lights that add nothing.
    struct Thorough;

    impl Lamps for Thorough {
        fn skip(&mut self, _: Skip) -> bool {
            false
        }
    }

    /// The floor y = 0 with a smooth normal that leans along x by 45°, seen from above or below.
    fn floor(light: &str, view: Vec3) -> [f32; 2] {
        let scene = lit(light);
        let local = LocalLight { scene: &scene, shade_back: true };
        let surface = Surface {
            point: DVec3::ZERO,
            error: DVec3::ZERO,
            normal: Vec3::new(1.0, 1.0, 0.0).normalize(),
            geometric_normal: DVec3::Y,
            material: 0,
            primitive: 0,
            weights: [0.0; 2],
        };
        let (material, view) = (PhongMaterial::default(), view.normalize());
        let mixture = Mixture::Plain(&material);
        let skipped = local.radiance(&surface, &mixture, view, diffuse);
        let mut thorough = 0.0;
        let add = |_: usize, _: &Incident, reflected: Vec3| thorough += reflected.x;
        local.gather(&surface, &mixture, view, diffuse, &mut Thorough, add);
        [skipped.x, thorough]
    }

    #[test]
    fn a_leaning_normal_lets_no_light_through_the_surface() {
        let cosine = 0.5f32.sqrt();
        let near = |found: [f32; 2], expected: f32| found.iter().all(|x| (x - expected).abs() < 1e-6);
        assert!(near(floor("0 -1 0", Vec3::NEG_Y), cosine), "from above, seen from above");
        assert!(near(floor("-1 0.1 0", Vec3::NEG_Y), 0.0), "from below, though the normal leans to it");
        assert!(near(floor("1 -0.1 0", Vec3::NEG_Y), 0.0), "from above, though behind the normal");
        assert!(near(floor("0 1 0", Vec3::Y), cosine), "from below, seen from below");
        assert!(near(floor("1 -0.1 0", Vec3::new(0.5, 1.0, 0.0)), 0.0), "from above, seen from below");
    }
}
