//! Triangles, alone or many together.
//!
//! The test is the sheared one of Woop, Benthin and Wald, "Watertight Ray/Triangle
//! Intersection" (JCGT 2013): the ray becomes the z axis, each vertex a point of the plane, and
//! the question is whether the triangle around them contains (0, 0). The three edge functions
//! are differences of two rounded products. Rounding is monotone, so such a difference may be
//! zero when it should not, but never has the wrong sign; and zero counts as inside. Therefore
//! a ray through a shared edge or vertex always meets at least one of the triangles there.

use super::{Attributes, Crossing};
use crate::Ray;
use common::math::DVec3;

/// Three corners, counter-clockwise seen from the front.
pub(crate) type Triangle = [DVec3; 3];

/// How many neighbouring triangles share one bounding sphere.
const RUN: usize = 64;

/// Any number of triangles. Runs of them have a bounding sphere, so that a ray far from a run
/// costs one test; nothing else is skipped.
#[derive(Clone, Debug)]
pub(crate) struct Soup {
    pub triangles: Vec<Triangle>,
    pub attributes: Attributes,
    bounds: Vec<(DVec3, f64)>,
}

impl Soup {
    pub fn new(triangles: Vec<Triangle>, attributes: Attributes) -> Self {
        let bounds = triangles.chunks(RUN).map(bounding_sphere).collect();
        Self { triangles, attributes, bounds }
    }

    /// The middle of the box around all corners.
    pub fn middle(&self) -> DVec3 {
        let corners = || self.triangles.iter().flatten().copied();
        let (low, high) = (corners().reduce(DVec3::min), corners().reduce(DVec3::max));
        (low.unwrap_or_default() + high.unwrap_or_default()) / 2.0
    }

    /// Calls `found` for every triangle that the line meets, edges and corners included.
    pub fn cross(&self, ray: &Ray, found: &mut impl FnMut(Crossing)) {
        let sheared = Sheared::new(ray);
        for (run, (triangles, &bound)) in self.triangles.chunks(RUN).zip(&self.bounds).enumerate() {
            if !passes_near(ray, bound) {
                continue;
            }
            for (i, triangle) in triangles.iter().enumerate() {
                let Some(t) = sheared.cross(triangle) else {
                    continue;
                };
                let [a, b, c] = *triangle;
                let normal = (b - a).cross(c - a);
                found(Crossing { t, normal, triangle: run * RUN + i });
            }
        }
    }
}

/// Centre and radius of a sphere around the triangles, not the smallest.
fn bounding_sphere(triangles: &[Triangle]) -> (DVec3, f64) {
    let vertices = || triangles.iter().flatten();
    let center = vertices().copied().sum::<DVec3>() / (3 * triangles.len()) as f64;
    let radius = vertices().map(|v| v.distance(center)).fold(0.0, f64::max);
    (center, radius)
}

/// May the line of `ray` meet the sphere? Errs on the side of yes: the radius is enlarged by
/// far more than the rounding of the cross product, about 1e-16 of the distance.
fn passes_near(ray: &Ray, (center, radius): (DVec3, f64)) -> bool {
    let to_center = center - ray.origin;
    let reach = 1.000_001 * radius + 1e-12 * to_center.length();
    to_center.cross(ray.direction).length() <= reach * ray.direction.length()
}

/// A ray prepared for the test: which axis becomes z, and the shear that makes the direction
/// (0, 0, 1).
struct Sheared {
    origin: DVec3,
    axes: [usize; 3],
    shear: DVec3,
}

impl Sheared {
    fn new(ray: &Ray) -> Self {
        let d = ray.direction;
        let z = d.abs().max_position();
        let (x, y) = ((z + 1) % 3, (z + 2) % 3);
        let shear = DVec3::new(d[x] / d[z], d[y] / d[z], 1.0 / d[z]);
        Self { origin: ray.origin, axes: [x, y, z], shear }
    }

    /// Where a vertex lies when the ray is the z axis; its z is the ray's t.
    fn place(&self, vertex: DVec3) -> DVec3 {
        let v = vertex - self.origin;
        let [x, y, z] = self.axes.map(|axis| v[axis]);
        DVec3::new(x - self.shear.x * z, y - self.shear.y * z, self.shear.z * z)
    }

    /// The t of the crossing. Both orientations count; a triangle seen exactly from its edge
    /// does not.
    fn cross(&self, triangle: &Triangle) -> Option<f64> {
        let [a, b, c] = triangle.map(|v| self.place(v));
        let edge = |p: DVec3, q: DVec3| p.x * q.y - p.y * q.x;
        let weights = DVec3::new(edge(b, c), edge(c, a), edge(a, b));
        let inside = weights.min_element() >= 0.0 || weights.max_element() <= 0.0;
        let area = weights.x + weights.y + weights.z;
        if !inside || area == 0.0 {
            return None;
        }
        let t = weights.dot(DVec3::new(a.z, b.z, c.z)) / area;
        t.is_finite().then_some(t)
    }
}
