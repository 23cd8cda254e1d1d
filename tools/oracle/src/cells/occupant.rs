//! What can fill a cell: the finite objects of a scene in world space.

use super::aabb::Aabb;
use super::overlap::{ellipsoid_touches, sphere_touches, triangle_touches};
use crate::object::Object;
use crate::shape::{Shape, Sphere, Triangle};
use crate::{GridFit, World};
use common::math::{DMat4, DVec3};

/// One object as the grid counts it.
pub(super) struct Occupant {
    /// Its box by §6.1.
    pub bounds: Aabb,
    form: Form,
}

enum Form {
    /// A sphere under no transform.
    Sphere(Sphere),
    /// A sphere under transforms, with the map from the world to its own space.
    Ellipsoid(Sphere, DMat4),
    Triangle(Triangle),
}

impl Occupant {
    /// Does the object belong into a cell, by the rule `fit`?
    pub fn fills(&self, cell: &Aabb, fit: GridFit) -> bool {
        match (&self.form, fit) {
            (Form::Sphere(sphere), GridFit::Bounds) => {
                let reach = sphere.radius + cell.half().length();
                cell.center().distance(sphere.center) <= reach
            }
            (Form::Sphere(sphere), GridFit::Exact) => sphere_touches(sphere, cell),
            (Form::Ellipsoid(..) | Form::Triangle(_), GridFit::Bounds) => self.bounds.touches(cell),
            (Form::Ellipsoid(sphere, to_object), GridFit::Exact) => {
                self.bounds.touches(cell) && ellipsoid_touches(sphere, to_object, cell)
            }
            (Form::Triangle(triangle), GridFit::Exact) => {
                self.bounds.touches(cell) && triangle_touches(triangle, cell)
            }
        }
    }
}

/// The finite objects of a world, meshes taken apart into triangles.
pub(super) fn occupants(world: &World) -> Vec<Occupant> {
    world.objects.iter().flat_map(of_object).collect()
}

fn of_object(object: &Object) -> Vec<Occupant> {
    match &object.shape {
        Shape::Plane(_) => Vec::new(),
        Shape::Sphere(sphere) => vec![of_sphere(object, sphere)],
        Shape::Triangles(soup) => {
            soup.triangles.iter().map(|triangle| of_triangle(object, triangle)).collect()
        }
    }
}

fn of_sphere(object: &Object, sphere: &Sphere) -> Occupant {
    let corners = sphere.box_corners().map(|p| object.to_world.transform_point3(p));
    let form = match object.transformed {
        true => Form::Ellipsoid(*sphere, object.to_object),
        false => Form::Sphere(*sphere),
    };
    Occupant { bounds: Aabb::of(&corners), form }
}

/// Vertices are rounded to single precision, as the core keeps them: which cell a vertex on a
/// border touches would otherwise depend on the precision.
fn of_triangle(object: &Object, triangle: &Triangle) -> Occupant {
    let place = |v: DVec3| object.to_world.transform_point3(v).as_vec3().as_dvec3();
    let vertices = triangle.map(place);
    Occupant { bounds: Aabb::of(&vertices), form: Form::Triangle(vertices) }
}
