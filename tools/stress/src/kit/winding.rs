//! Which points are inside a closed mesh, without tracing a ray.

use super::Draw;
use common::math::{Bounds, Vec3};
use std::f64::consts::PI;

/// How often a closed mesh winds around a point: the sum of the solid angles of its triangles
/// over 4π (Van Oosterom & Strackee 1983). A whole number unless the point is on the mesh.
pub fn winding(triangles: &[[Vec3; 3]], p: Vec3) -> f64 {
    let solid_angle = |t: &[Vec3; 3]| {
        let [a, b, c] = t.map(|v| v.as_dvec3() - p.as_dvec3());
        let (la, lb, lc) = (a.length(), b.length(), c.length());
        let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        2.0 * a.dot(b.cross(c)).atan2(below)
    };
    triangles.iter().map(solid_angle).sum::<f64>() / (4.0 * PI)
}

/// Whether a point lies on a triangle, its border included, or all but. Two sheets that have
/// collapsed onto each other do not show in the winding number.
fn touches(t: &[Vec3; 3], p: Vec3) -> bool {
    let [a, b, c] = t.map(|v| v.as_dvec3() - p.as_dvec3());
    let (la, lb, lc) = (a.length(), b.length(), c.length());
    let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    let rounding = 1e-9 * la * lb * lc;
    a.dot(b.cross(c)).abs() <= rounding && below <= rounding
}

/// Points from which a ray in any direction must hit: the mesh winds an odd number of times
/// around each. Up to `wanted` of them; none if the mesh has collapsed.
pub fn inside_points(triangles: &[[Vec3; 3]], wanted: usize, seed: u64) -> Vec<Vec3> {
    let bounds = Bounds::of_points(triangles.iter().flatten().copied());
    let mut draw = Draw::new(seed);
    let is_inside = |p: &Vec3| {
        let w = winding(triangles, *p);
        let odd = (w - w.round()).abs() < 1e-6 && w.round() as i64 % 2 != 0;
        odd && !triangles.iter().any(|t| touches(t, *p))
    };
    let candidates = std::iter::repeat_with(|| draw.point(bounds.min, bounds.max)).take(20 * wanted);
    candidates.filter(is_inside).take(wanted).collect()
}
