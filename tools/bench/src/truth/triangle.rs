//! A ray against a triangle by signed volumes, in double precision.

use common::math::{DVec3, Vec3};
use common::ray::Ray;

/// A ray in double precision.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// Where t = 0.
    pub origin: DVec3,
    /// Change of position per unit of t.
    pub direction: DVec3,
}

impl Line {
    /// The same ray in double precision.
    pub fn new(ray: &Ray) -> Self {
        Self { origin: ray.origin.as_dvec3(), direction: ray.direction.as_dvec3() }
    }

    /// Where the line meets a triangle, edges included; `None` if it passes it by or runs in its
    /// plane.
    pub fn meets(&self, corners: [Vec3; 3]) -> Option<f64> {
        let [u, v, w] = self.volumes(corners);
        let (least, most) = (u.min(v).min(w), u.max(v).max(w));
        if least < 0.0 && most > 0.0 {
            return None;
        }
        let t = self.crosses_plane(corners);
        // A line in the plane gives an infinity or NaN.
        t.is_finite().then_some(t)
    }

    /// What the line spans with the edge opposite each corner. It passes on the same side of all
    /// three edges if these volumes have the same sign (Plücker coordinates; Amanatides & Choi
    /// 1997). The volume of an edge is, bit for bit, the negative of that of the reversed edge,
    /// so nothing can slip between two triangles that share one.
    pub fn volumes(&self, corners: [Vec3; 3]) -> [f64; 3] {
        let [a, b, c] = corners.map(|p| p.as_dvec3() - self.origin);
        let volume = |p: DVec3, q: DVec3| self.direction.dot(p.cross(q));
        [volume(b, c), volume(c, a), volume(a, b)]
    }

    /// Where the line crosses the triangle's plane; an infinity or NaN if it runs along it.
    pub fn crosses_plane(&self, corners: [Vec3; 3]) -> f64 {
        let [a, b, c] = corners.map(|p| p.as_dvec3() - self.origin);
        let normal = (b - a).cross(c - a);
        normal.dot(a) / normal.dot(self.direction)
    }
}

/// |cosine| of the angle between a direction and a triangle's normal; NaN if either has none.
pub fn cosine(direction: DVec3, corners: [Vec3; 3]) -> f64 {
    let [a, b, c] = corners.map(|p| p.as_dvec3());
    let normal = (b - a).cross(c - a);
    normal.dot(direction).abs() / (normal.length() * direction.length())
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [Vec3; 3] = [Vec3::ZERO, Vec3::X, Vec3::Y];

    fn down(x: f32, y: f32) -> Option<f64> {
        Line::new(&Ray::new(Vec3::new(x, y, 3.0), Vec3::new(0.0, 0.0, -2.0))).meets(CORNERS)
    }

    #[test]
    fn inside_edges_and_corners_are_hit_and_the_rest_is_not() {
        for (x, y) in [(0.2, 0.3), (0.0, 0.5), (0.5, 0.5), (0.5, 0.0), (0.0, 0.0), (1.0, 0.0), (0.0, 1.0)] {
            assert_eq!(down(x, y), Some(1.5), "{x} {y}");
        }
        for (x, y) in [(-1e-7, 0.5), (0.5, -1e-7), (0.6, 0.5), (2.0, 0.0), (0.0, -1.0)] {
            assert_eq!(down(x, y), None, "{x} {y}");
        }
    }

    #[test]
    fn behind_is_negative_and_along_is_nothing() {
        let up = Ray::new(Vec3::new(0.2, 0.2, 3.0), Vec3::Z);
        assert_eq!(Line::new(&up).meets(CORNERS), Some(-3.0));
        let along = Ray::new(Vec3::new(-1.0, 0.2, 0.0), Vec3::X);
        assert_eq!(Line::new(&along).meets(CORNERS), None);
        assert!((cosine(DVec3::new(0.0, 3.0, 4.0), CORNERS) - 0.8).abs() < 1e-15);
    }
}
