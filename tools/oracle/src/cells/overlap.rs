//! Exact overlap with a box, touching included.

use super::aabb::Aabb;
use crate::shape::{Sphere, Triangle};
use common::math::DVec3;

/// Does the solid sphere meet the box? By the distance of its centre from the box (Arvo, in
/// Graphics Gems, 1990).
pub(super) fn sphere_touches(sphere: &Sphere, cell: &Aabb) -> bool {
    let nearest = sphere.center.clamp(cell.min, cell.max);
    nearest.distance(sphere.center) <= sphere.radius
}

/// Does the triangle meet the box, given that their boxes overlap? By separating axes: the
/// triangle's normal and the cross products of its edges with the box's (Akenine-Möller, "Fast
/// 3D Triangle-Box Overlap Testing", 2001). A zero axis separates nothing.
///
/// An axis must separate by more than its rounding error, a few units in the last place of the
/// coordinates: what touches counts, and rounding must not pull it apart.
pub(super) fn triangle_touches(triangle: &Triangle, cell: &Aabb) -> bool {
    let [a, b, c] = triangle.map(|v| v - cell.center());
    let half = cell.half();
    let scale =
        [cell.min, cell.max].iter().chain(triangle).fold(0.0, |s: f64, v| s.max(v.abs().max_element()));
    let separates = |u: DVec3, v: DVec3| {
        let axis = u.cross(v);
        let along = DVec3::new(axis.dot(a), axis.dot(b), axis.dot(c));
        let slack = 16.0 * f64::EPSILON * u.length() * v.length() * scale;
        let reach = axis.abs().dot(half) + slack;
        along.min_element() > reach || along.max_element() < -reach
    };
    let edges = [b - a, c - b, a - c];
    let crossed = |unit: DVec3| edges.iter().any(|&edge| separates(unit, edge));
    !separates(edges[0], edges[1]) && ![DVec3::X, DVec3::Y, DVec3::Z].into_iter().any(crossed)
}
