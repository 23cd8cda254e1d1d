//! Shapes in their own space.
//!
//! A shape knows one thing: every point where the whole line of a ray meets it. Which of these
//! points counts (the nearest, or any before a light) is decided in one place, [`crate::World`].

mod plane;
mod sphere;
mod triangle;

pub(crate) use plane::Plane;
pub(crate) use sphere::Sphere;
pub(crate) use triangle::{Soup, Triangle};

use crate::{OracleError, Ray};
use common::math::DVec3;
use common::scene::{Node, Scene, ShapeSpec};

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
            ShapeSpec::Triangle { vertices } => Self::Triangles(Soup::new(vec![vertices])),
            ShapeSpec::Mesh { smooth: true, .. } => return Err(OracleError::Smooth(node.position)),
            ShapeSpec::Mesh { mesh, .. } => {
                let missing = OracleError::Missing { what: "mesh", position: node.position };
                let mesh = scene.meshes.get(mesh as usize).ok_or(missing)?;
                let corner = |i: u32| mesh.positions[i as usize].as_dvec3();
                Self::Triangles(Soup::new(mesh.triangles.iter().map(|t| t.map(corner)).collect()))
            }
        })
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
