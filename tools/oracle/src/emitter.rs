//! Emissive surfaces as lights: triangles, spheres and discs, cut into small pieces.

use crate::World;
use crate::light::Arriving;
use crate::object::Object;
use crate::sampling::grid;
use crate::shape::Shape;
use common::math::{DMat3, DVec3};
use std::f64::consts::{FRAC_1_PI, PI};

/// A small piece of an emissive surface, taken for flat.
#[derive(Clone, Debug)]
pub(crate) struct Patch {
    /// Its middle, in world space.
    point: DVec3,
    /// Along the normal, as long as the area is large.
    area: DVec3,
    /// Radiance that it sends out, on the side of its normal only.
    radiance: DVec3,
}

impl Patch {
    /// What arrives at `point` if nothing is in the way, to be multiplied with kd·N·L: radiance
    /// times solid angle over π.
    pub fn at(&self, point: DVec3) -> Option<Arriving> {
        let way = self.point - point;
        let distance = way.length();
        let direction = way / distance;
        let solid_angle = -direction.dot(self.area) / (distance * distance);
        // NaN, from a point on the piece itself, gives nothing.
        (solid_angle > 0.0).then(|| Arriving {
            direction,
            distance,
            color: self.radiance * solid_angle * FRAC_1_PI,
        })
    }
}

/// A piece in the space of its object: triangle number, middle, and vector area.
type Piece = (usize, DVec3, DVec3);

/// The pieces of an object, `side`² for each triangle, sphere or disc; none for planes without
/// end, which give light only to those who look at them.
pub(crate) fn patches(world: &World, object: &Object, side: u32) -> Vec<Patch> {
    let linear = DMat3::from_mat4(object.to_world);
    // Area vectors transform with the cofactors of the matrix. A mirroring one turns them round,
    // but normals keep to the side that the course calls outward.
    let cofactors = linear.determinant().abs() * linear.inverse().transpose();
    let placed = |(triangle, point, area): Piece| {
        let point = object.to_world.transform_point3(point);
        let radiance = world.mixture_at(object, triangle, point).sum(|surface| surface.emissive);
        Patch { point, area: cofactors * area, radiance }
    };
    pieces(&object.shape, side).into_iter().map(placed).collect()
}

fn pieces(shape: &Shape, side: u32) -> Vec<Piece> {
    match shape {
        Shape::Plane(plane) => {
            let Some(disc) = plane.disc else { return Vec::new() };
            let area = PI * disc.radius * disc.radius / f64::from(side * side) * plane.normal;
            let (across, upward) = plane.normal.any_orthonormal_pair();
            // Areas grow with the square of the radius.
            let aside = grid(side).map(|[u, v]| u.sqrt() * on_sphere(0.0, v));
            aside.map(|p| (0, disc.center + disc.radius * (p.x * across + p.y * upward), area)).collect()
        }
        Shape::Sphere(sphere) => {
            let area = 4.0 * PI * sphere.radius * sphere.radius / f64::from(side * side);
            // Equal steps of height cut a sphere into equal areas (Archimedes).
            let normals = grid(side).map(|[u, v]| on_sphere(1.0 - 2.0 * u, v));
            normals.map(|n| (0, sphere.center + sphere.radius * n, area * n)).collect()
        }
        Shape::Triangles(soup) => {
            let numbered = soup.triangles.iter().enumerate();
            numbered.flat_map(|(i, t)| of_triangle(*t, side).map(move |(p, area)| (i, p, area))).collect()
        }
    }
}

/// The unit vector of height `z` at a part `v` of a full turn about z.
fn on_sphere(z: f64, v: f64) -> DVec3 {
    let (sin, cos) = (2.0 * PI * v).sin_cos();
    let radius = (1.0 - z * z).max(0.0).sqrt();
    DVec3::new(radius * cos, radius * sin, z)
}

/// The `side`² equal triangles that lines parallel to its sides cut a triangle into.
fn of_triangle([a, b, c]: [DVec3; 3], side: u32) -> impl Iterator<Item = (DVec3, DVec3)> {
    let n = f64::from(side);
    let area = (b - a).cross(c - a) / (2.0 * n * n);
    let cells = (0..side).flat_map(move |row| (0..side - row).map(move |column| (column, row)));
    // Each cell of the slanted grid holds an upright triangle and, but for the last of its row, an
    // upside-down one: their middles are at thirds.
    let thirds = cells.flat_map(move |(column, row)| {
        let upside_down = (column + row + 1 < side).then_some(2.0 / 3.0);
        let place = move |third: f64| [column, row].map(|at| (f64::from(at) + third) / n);
        [Some(1.0 / 3.0), upside_down].into_iter().flatten().map(place)
    });
    thirds.map(move |[u, v]| (a + u * (b - a) + v * (c - a), area))
}
