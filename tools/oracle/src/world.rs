//! The scene ready for brute force, and the nearest hit.

use crate::emitter::{Patch, patches};
use crate::light::{Arriving, Light};
use crate::object::{Object, objects};
use crate::shape::Crossing;
use crate::texture::{Materials, Mixture};
use crate::{OracleError, Range, Ray};
use common::math::DVec3;
use common::scene::Scene;

/// A point where a ray meets the scene.
#[derive(Clone, Debug)]
pub struct Hit<'a> {
    /// Distance along the ray, whose direction has unit length; may be negative.
    pub t: f64,
    /// Index of the shape in `Scene::nodes`.
    pub node: usize,
    /// Which triangle of a mesh; 0 for everything else.
    pub triangle: usize,
    /// The point in world space.
    pub point: DVec3,
    /// Unit normal in world space, on the side that the course calls outward.
    pub normal: DVec3,
    /// Unit normal in world space that lights, mirrors and glass go by: interpolated on smooth
    /// meshes, the same as `normal` on everything else.
    pub shading_normal: DVec3,
    /// What was hit.
    pub(crate) object: &'a Object,
    /// How far from the surface a secondary ray starts.
    pub(crate) standoff: f64,
}

impl Hit<'_> {
    /// A ray from the hit point in unit `direction`, started a little on the side of the
    /// surface that it goes to.
    pub(crate) fn leave(&self, direction: DVec3) -> Ray {
        let side = self.normal.dot(direction).signum();
        Ray { origin: self.point + side * self.standoff * self.normal, direction }
    }
}

/// Everything a ray can meet, and the lights.
#[derive(Clone, Debug)]
pub struct World {
    pub(crate) objects: Vec<Object>,
    lights: Vec<Light>,
    /// The pieces of the emissive surfaces, if these are lights.
    patches: Vec<Patch>,
    /// What spherical lights are cut into, squared.
    light_side: u32,
    materials: Materials,
    pub(crate) background: DVec3,
    pub(crate) ambient: DVec3,
}

impl World {
    /// Composes the transforms of a scene and takes over its shapes, materials and lights.
    /// Refuses what later assignments add, and transforms without an inverse.
    pub fn new(scene: &Scene) -> Result<Self, OracleError> {
        if scene.background.environment.is_some() {
            let (what, position) = ("an environment light", scene.camera.position);
            return Err(OracleError::Later { what, assignment: 8, position });
        }
        Ok(Self {
            objects: objects(scene)?,
            materials: Materials::new(scene)?,
            lights: scene.lights.iter().map(Light::new).collect(),
            patches: Vec::new(),
            light_side: 1,
            background: scene.background.color.as_dvec3(),
            ambient: scene.background.ambient_light.as_dvec3(),
        })
    }

    /// The same world with lights that have an extent: spherical lights are cut into `side`²
    /// directions, every emissive triangle, sphere and disc into as many pieces. With 1 nothing changes.
    pub fn with_extended_lights(mut self, side: u32) -> Self {
        if side > 1 {
            self.light_side = side;
            let emitting = self.objects.iter().filter(|object| self.materials.emits(object.material));
            self.patches = emitting.flat_map(|object| patches(&self, object, side)).collect();
        }
        self
    }

    /// All light that arrives at a point, if nothing is in the way.
    pub(crate) fn arriving(&self, point: DVec3) -> Vec<Arriving> {
        let lights = self.lights.iter().flat_map(|light| light.at(point, self.light_side));
        lights.chain(self.patches.iter().filter_map(|patch| patch.at(point))).collect()
    }

    /// Calls `found` for every point where the line of `ray` meets an object.
    pub(crate) fn cross<'a>(&'a self, ray: &Ray, mut found: impl FnMut(&'a Object, Crossing)) {
        for object in &self.objects {
            let local = ray.transformed(&object.to_object);
            object.shape.cross(&local, &mut |crossing| found(object, crossing));
        }
    }

    /// The plain surfaces that the material of `hit` blends there.
    pub fn mixture(&self, hit: &Hit) -> Mixture {
        self.mixture_at(hit.object, hit.triangle, hit.point)
    }

    /// The plain surfaces of an object at a point of its triangle (0 for other shapes).
    pub(crate) fn mixture_at(&self, object: &Object, triangle: usize, point: DVec3) -> Mixture {
        self.materials.at(object.material, point, || object.uv(triangle, point))
    }

    /// The nearest hit inside `range`: the least t, which may be negative; of equal ones the
    /// first in file order. `ray` has a unit direction.
    pub fn nearest(&self, ray: &Ray, range: Range) -> Option<Hit<'_>> {
        let mut nearest: Option<(&Object, Crossing)> = None;
        self.cross(ray, |object, crossing| {
            let nearer = nearest.is_none_or(|(_, best)| crossing.t < best.t);
            if range.contains(crossing.t) && nearer {
                nearest = Some((object, crossing));
            }
        });
        nearest.map(|(object, crossing)| object.hit(ray, crossing))
    }
}
