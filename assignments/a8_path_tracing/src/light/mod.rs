//! A8T3: where light comes from, and how it is asked for.
//!
//! | light | how a surface asks it | whether a path can meet it |
//! |---|---|---|
//! | shining surface | by points of it | yes |
//! | `PointLight`, `DirectionalLight` | where it is | no |
//! | `SphereLight` | by the cone it fills, as in assignment 7 | no |
//! | environment picture | in proportion to its brightness | yes |
//! | background colour | not at all: every way on finds it as well | yes |
//!
//! A light that has a place is chosen by the [`LightTree`]; one infinitely far away is as likely
//! as all of those together. Lights of the course light a white surface under them as much as in
//! the pictures of the steps below, so they count π times their colour.

mod area;
mod ball;
mod environment;
mod offers;
mod target;
mod tree;

pub use area::{AreaLight, AreaShape, Seen};
pub use ball::{Ball, BallWay};
pub use environment::Environment;
pub use offers::{Offers, Receivers};
pub use target::Target;
pub use tree::{Cluster, Leaf, LightTree, Receiver};

use a1_ray_casting::World;
use a2_transforms::{Incident, Source, falloff, incident};
use a7_sampling::light::{Cone, brightness};
use common::geometry::{Geometry, Surface};
use common::math::{Bounds, DVec3, Vec3};
use common::picture::{PictureError, Transfer, read};
use common::scene::{LightKind, LightSpec};
use common::shape::sphere::Sphere;
use std::f64::consts::PI;

/// All lights of a scene.
pub struct Lights<'a> {
    geometry: &'a Geometry,
    world: &'a dyn World,
    areas: Vec<AreaLight>,
    /// First primitive of each of `areas`, in increasing order, with its index.
    by_primitive: Vec<(u32, u32)>,
    /// Lights of the `Lights` block that have a place; numbered after `areas`.
    placed: Vec<&'a LightSpec>,
    /// Those that have none.
    far: Vec<&'a LightSpec>,
    tree: LightTree,
    environment: Option<Environment>,
}

/// Light that a surface is offered.
#[derive(Clone, Copy, Debug)]
pub struct Offer {
    /// Unit direction towards it.
    pub direction: DVec3,
    /// Where the shadow ray ends; `None` if infinitely far away.
    pub end: Option<Vec3>,
    /// Radiance over the density of choosing it, per steradian.
    pub light: Vec3,
    /// The density, per steradian; infinite if no path can meet the light.
    pub pdf: f32,
}

impl<'a> Lights<'a> {
    /// Of a scene, whose sky is read if it has one; `world` tells what its surfaces are made of.
    ///
    /// # Errors
    /// If the picture of the sky cannot be read.
    pub fn load(geometry: &'a Geometry, world: &'a dyn World) -> Result<Self, PictureError> {
        let file = world.as_scene().background.environment.as_ref();
        let sky = file.map(|file| read(file, Transfer::Linear)).transpose()?.map(Environment::new);
        Ok(Self::new(geometry, world, sky.filter(|sky| !sky.is_black())))
    }

    /// Of a scene; `world` tells what its surfaces are made of.
    pub fn new(geometry: &'a Geometry, world: &'a dyn World, environment: Option<Environment>) -> Self {
        let scene = world.as_scene();
        let brightness = brightness(scene);
        let shines = |primitive: u32| brightness[geometry.material(primitive) as usize] > 0.0;
        // Most scenes have none, and then a million triangles need not be looked at.
        let any = brightness.iter().any(|b| *b > 0.0);
        let areas = if any { AreaLight::all(geometry, shines) } else { Vec::new() };
        let (far, placed): (Vec<_>, Vec<_>) =
            scene.lights.iter().partition(|l| matches!(l.kind, LightKind::Directional { .. }));
        let power =
            |light: &AreaLight| brightness[geometry.material(light.primitive) as usize] * light.area();
        let of_areas = areas.iter().map(|light| area_cluster(light, power(light)));
        let clusters = of_areas.chain(placed.iter().map(|light| placed_cluster(light)));
        let leaves = (0..).zip(clusters).map(|(light, cluster)| Leaf { light, cluster });
        let tree =
            LightTree::new(leaves.filter(|l| l.cluster.power > 0.0).collect(), areas.len() + placed.len());
        let mut by_primitive: Vec<(u32, u32)> = areas.iter().map(|l| l.primitive).zip(0..).collect();
        by_primitive.sort_unstable();
        Self { geometry, world, areas, by_primitive, placed, far, tree, environment }
    }

    /// Whether no light can be asked for.
    pub fn is_empty(&self) -> bool {
        self.tree.is_empty() && self.far.is_empty() && self.environment.is_none()
    }

    /// Whether there are lights that no way meets by chance: points and directions.
    pub fn has_points(&self) -> bool {
        !self.placed.is_empty() || !self.far.is_empty()
    }

    /// Lights infinitely far away, the environment being one.
    fn far_count(&self) -> usize {
        self.far.len() + usize::from(self.environment.is_some())
    }

    /// The probability of choosing among those that have a place.
    fn near_share(&self) -> f64 {
        let near = f64::from(u8::from(!self.tree.is_empty()));
        near / (near + self.far_count() as f64)
    }

    /// Light for a point of the unit square that could reach `point` from the side of `normal`.
    #[inline]
    pub fn offer(&self, point: DVec3, normal: Vec3, [u, v]: [f64; 2]) -> Option<Offer> {
        let near = self.near_share();
        if u < near || self.far_count() == 0 {
            let at = Receiver { point: point.as_vec3(), normal };
            let (light, probability, u) = self.tree.choose(&at, u / near)?;
            return self.near_offer(light as usize, f64::from(probability) * near, point, [u, v]);
        }
        let each = (1.0 - near) / self.far_count() as f64;
        let index = (((u - near) / each) as usize).min(self.far_count() - 1);
        let Some(light) = self.far.get(index) else {
            let u = ((u - near) / each - index as f64).clamp(0.0, 1.0 - f64::EPSILON);
            let (direction, radiance, pdf) = self.environment.as_ref()?.sample([u, v])?;
            let pdf = pdf * each;
            let light = radiance * (1.0 / pdf) as f32;
            return Some(Offer { direction, end: None, light, pdf: pdf as f32 });
        };
        Some(certain(incident(light, point), each))
    }

    fn near_offer(&self, index: usize, chance: f64, point: DVec3, uv: [f64; 2]) -> Option<Offer> {
        let Some(area) = self.areas.get(index) else {
            let light = self.placed[index - self.areas.len()];
            return Some(certain(from_placed(light, point, uv), chance));
        };
        let seen = area.sample(self.geometry, point, uv)?;
        let pdf = seen.pdf * chance;
        let radiance = self.emitted(&seen.surface);
        // The shadow ray ends beside what shines, on the side it is seen from.
        let end = Some(seen.surface.leave(-seen.direction));
        Some(Offer { direction: seen.direction, end, light: radiance * (1.0 / pdf) as f32, pdf: pdf as f32 })
    }

    /// The shining surface that a primitive belongs to.
    fn light_of(&self, primitive: u32) -> Option<u32> {
        let after = self.by_primitive.partition_point(|(first, _)| *first <= primitive);
        let (first, index) = self.by_primitive[after.checked_sub(1)?];
        (primitive - first < self.areas[index as usize].primitives()).then_some(index)
    }

    /// Radiance from the front of a surface.
    #[inline]
    fn emitted(&self, surface: &Surface) -> Vec3 {
        match self.world.plain(surface.material) {
            Some(material) => material.emissive,
            None => self.world.at(surface).blend(|m| m.emissive),
        }
    }

    /// Density with which [`Lights::offer`] at `from` would have been this point of a shining
    /// surface, per steradian; 0 if it is not asked for.
    pub fn pdf(&self, from: DVec3, normal: Vec3, direction: DVec3, distance: f64, surface: &Surface) -> f32 {
        let Some(index) = self.light_of(surface.primitive) else { return 0.0 };
        let area = &self.areas[index as usize];
        let chance = self.tree.probability(&Receiver { point: from.as_vec3(), normal }, index);
        let pdf = area.pdf(from, direction, distance, surface);
        (pdf * f64::from(chance) * self.near_share()) as f32
    }

    /// What comes from infinitely far away in a unit direction, and the density with which
    /// [`Lights::offer`] would have been it.
    #[inline]
    pub fn from_afar(&self, direction: Vec3) -> (Vec3, f32) {
        match &self.environment {
            None => (self.world.as_scene().background.color, 0.0),
            Some(environment) => {
                let each = (1.0 - self.near_share()) / self.far_count() as f64;
                let (radiance, pdf) = environment.look(direction.as_dvec3());
                (radiance, (pdf * each) as f32)
            }
        }
    }
}

/// Light that no path can meet, chosen with this probability.
fn certain(incident: Incident, chance: f64) -> Offer {
    let (direction, end) = match incident.source {
        Source::Direction(direction) => (direction, None),
        Source::Point(position) => (incident.direction.as_dvec3(), Some(position.as_vec3())),
    };
    Offer { direction, end, light: incident.color * (PI / chance) as f32, pdf: f32::INFINITY }
}

/// What a point light sends, or a light sphere from one point of the cone that it fills.
fn from_placed(light: &LightSpec, point: DVec3, uv: [f64; 2]) -> Incident {
    let LightKind::Sphere { center, radius, attenuation } = light.kind else {
        return incident(light, point);
    };
    let (direction, distance) = Cone::new(&Sphere { center, radius }, point).direction(uv);
    let color = light.color * falloff(attenuation, (center - point).length());
    let source = Source::Point(point + direction * distance);
    Incident { direction: direction.as_vec3(), color, source }
}

fn area_cluster(light: &AreaLight, power: f64) -> Cluster {
    let facing = light.facing();
    let axis = facing.unwrap_or(DVec3::Z).as_vec3();
    // Rounded normals may lie a little aside.
    let cos_spread = if facing.is_some() { 1.0 - 1e-6 } else { -1.0 };
    Cluster { bounds: light.bounds(), power: power as f32, axis, cos_spread }
}

fn placed_cluster(light: &LightSpec) -> Cluster {
    let around = |center: DVec3, radius: f64| Bounds {
        min: (center - DVec3::splat(radius)).as_vec3(),
        max: (center + DVec3::splat(radius)).as_vec3(),
    };
    let bounds = match light.kind {
        LightKind::Point { position, .. } => around(position, 0.0),
        LightKind::Sphere { center, radius, .. } => around(center, radius),
        LightKind::Directional { .. } => around(DVec3::ZERO, 0.0),
    };
    let power = light.color.max(Vec3::ZERO).element_sum() * PI as f32;
    Cluster { bounds, power, axis: Vec3::Z, cos_spread: -1.0 }
}
