//! Shapes in their own space.
//!
//! A shape knows one thing: every point where the whole line of a ray meets it. Which of these
//! points counts (the nearest, or any before a light) is decided in one place, [`crate::World`].

mod attributes;
mod plane;
mod sphere;
mod triangle;
mod uv;

pub(crate) use attributes::Attributes;
pub(crate) use plane::Plane;
pub(crate) use sphere::Sphere;
pub(crate) use triangle::{Soup, Triangle};

use crate::{OracleError, Ray};
use attributes::barycentric;
use common::math::DVec3;
use common::scene::{Node, Scene, ShapeSpec};

/// Texture coordinates (u, v); the picture fills the unit square, v upwards.
pub(crate) type Uv = [f64; 2];

/// A point where a line meets a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Crossing {
    /// Parameter of the line.
    pub t: f64,
    /// Outward normal in the shape's space, of any length but zero.
    pub normal: DVec3,
    /// Which triangle of a mesh; 0 for everything else.
    pub triangle: usize,
}

/// The shapes of the scene format.
#[derive(Clone, Debug)]
pub(crate) enum Shape {
    Sphere(Sphere),
    Plane(Plane),
    Triangles(Soup),
}

impl Shape {
    /// Builds the shape of `node`, whose specification is `spec`.
    pub fn new(scene: &Scene, node: &Node, spec: &ShapeSpec) -> Result<Self, OracleError> {
        Ok(match *spec {
            ShapeSpec::Sphere { center, radius } => Self::Sphere(Sphere { center, radius }),
            ShapeSpec::Plane { normal, offset, disc } => Self::Plane(Plane::new(normal, offset, disc)),
            ShapeSpec::Triangle { vertices } => {
                let attributes = Attributes { uvs: vec![uv::BARE_TRIANGLE], ..Attributes::default() };
                Self::triangles(vec![vertices], attributes)
            }
            ShapeSpec::Mesh { mesh, smooth } => {
                let missing = OracleError::Missing { what: "mesh", position: node.position };
                let mesh = scene.meshes.get(mesh as usize).ok_or(missing)?;
                let corner = |i: u32| mesh.positions[i as usize].as_dvec3();
                let triangles: Vec<Triangle> = mesh.triangles.iter().map(|t| t.map(corner)).collect();
                let attributes = Attributes::new(mesh, &triangles, smooth);
                Self::triangles(triangles, attributes)
            }
        })
    }

    fn triangles(triangles: Vec<Triangle>, attributes: Attributes) -> Self {
        Self::Triangles(Soup::new(triangles, attributes))
    }

    /// The normals at the corners of a triangle of a smooth mesh, each with its weight at a
    /// `point` of that triangle; `None` for all that is shaded as flat as it is.
    pub fn corner_normals(&self, triangle: usize, point: DVec3) -> Option<[(f64, DVec3); 3]> {
        let Self::Triangles(soup) = self else { return None };
        let normals = soup.attributes.normals.get(triangle)?;
        let weights = barycentric(&soup.triangles[triangle], point);
        Some(std::array::from_fn(|k| (weights[k], normals[k])))
    }

    /// Texture coordinates at a `point` of the shape.
    pub fn uv(&self, triangle: usize, point: DVec3) -> Uv {
        match self {
            Self::Sphere(sphere) => uv::of_direction(point - sphere.center),
            Self::Plane(plane) => uv::of_plane(plane, point),
            Self::Triangles(soup) => {
                let Some(corners) = soup.attributes.uvs.get(triangle) else {
                    return uv::of_direction(point - soup.middle());
                };
                let weights = barycentric(&soup.triangles[triangle], point);
                std::array::from_fn(|k| weights.dot(DVec3::from_array(corners.map(|uv| uv[k]))))
            }
        }
    }

    /// Calls `found` for every point where the line of `ray` meets the shape, in no order.
    pub fn cross(&self, ray: &Ray, found: &mut impl FnMut(Crossing)) {
        match self {
            Self::Sphere(sphere) => sphere.cross(ray).into_iter().flatten().for_each(found),
            Self::Plane(plane) => plane.cross(ray).into_iter().for_each(found),
            Self::Triangles(soup) => soup.cross(ray, found),
        }
    }
}
