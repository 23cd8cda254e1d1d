//! All that shines in a scene, as one light.

use super::EmitterShape;
use a1_ray_casting::World;
use common::geometry::{Geometry, Surface};
use common::math::{DVec3, Vec3};
use common::scene::{Material, Scene};

/// The primitives whose material gives off light, chosen in proportion to area times brightness.
/// They shine from their front.
pub struct Emitters<'a> {
    geometry: &'a Geometry,
    world: &'a dyn World,
    all: Vec<(u32, EmitterShape)>,
    /// Sum of the shares up to each, the last being 1.
    cumulated: Vec<f64>,
    /// Planes without a rim that shine; they are seen, and light nothing.
    pub endless: usize,
}

/// A point of a light as another point sees it.
#[derive(Clone, Copy, Debug)]
pub struct LightPoint {
    /// The point.
    pub surface: Surface,
    /// Unit direction towards it.
    pub direction: DVec3,
    /// Radiance that comes from there if nothing is in between; black from behind.
    pub radiance: Vec3,
    /// Density of choosing this direction, per steradian, over all lights; 0 if there is none.
    pub pdf: f64,
}

impl<'a> Emitters<'a> {
    /// Of a scene; `world` tells what its surfaces are made of.
    pub fn new(geometry: &'a Geometry, world: &'a dyn World) -> Self {
        let brightness = brightness(world.as_scene());
        let shines = |number: u32| brightness[geometry.material(number) as usize];
        let endless =
            geometry.sheets().iter().filter(|s| s.plane.disc.is_none() && shines(s.primitive) > 0.0);
        let endless = endless.count();
        let (mut all, mut cumulated, mut sum) = (Vec::new(), Vec::new(), 0.0);
        // Most scenes have none, and then a million triangles need not be looked at.
        if brightness.iter().any(|b| *b > 0.0) {
            for (number, shape) in EmitterShape::all(geometry) {
                let power = shines(number) * shape.area();
                if power > 0.0 {
                    sum += power;
                    cumulated.push(sum);
                    all.push((number, shape));
                }
            }
        }
        cumulated.iter_mut().for_each(|share| *share /= sum);
        Self { geometry, world, all, cumulated, endless }
    }

    /// Whether nothing shines.
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// The point for a point of the unit square, as seen from `from`; `None` if nothing shines.
    pub fn point(&self, from: DVec3, [u, v]: [f64; 2]) -> Option<LightPoint> {
        let last = self.all.len().checked_sub(1)?;
        let index = self.cumulated.partition_point(|share| *share <= u).min(last);
        let below = if index == 0 { 0.0 } else { self.cumulated[index - 1] };
        let share = self.cumulated[index] - below;
        let within = ((u - below) / share).clamp(0.0, 1.0 - f64::EPSILON);
        let (number, shape) = &self.all[index];
        let point = shape.point(self.geometry, *number, from, [within, v]);
        let in_front = point.surface.geometric_normal.dot(point.direction) < 0.0;
        let radiance = match in_front && point.pdf > 0.0 {
            true => self.world.at(&point.surface).blend(|m| m.emissive),
            false => Vec3::ZERO,
        };
        Some(LightPoint {
            surface: point.surface,
            direction: point.direction,
            radiance,
            pdf: point.pdf * share,
        })
    }
}

/// How bright each material is: the sum of its three channels, of a texture the mean of what it
/// blends.
pub fn brightness(scene: &Scene) -> Vec<f64> {
    let mut all: Vec<f64> = Vec::with_capacity(scene.materials.len());
    for material in &scene.materials {
        all.push(match material {
            Material::Phong(m) => f64::from(m.emissive.element_sum()),
            Material::Solid(s) => s.children.iter().map(|child| all[*child as usize]).sum::<f64>() / 2.0,
        });
    }
    all
}
