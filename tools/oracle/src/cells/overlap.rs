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
pub(super) fn triangle_touches(triangle: &Triangle, cell: &Aabb) -> bool {
    let [a, b, c] = triangle.map(|v| v - cell.center());
    let half = cell.half();
    let separates = |axis: DVec3| {
        let along = DVec3::new(axis.dot(a), axis.dot(b), axis.dot(c));
        let reach = axis.abs().dot(half);
        along.min_element() > reach || along.max_element() < -reach
    };
    let edges = [b - a, c - b, a - c];
    let crossed = |unit: DVec3| edges.iter().any(|&edge| separates(unit.cross(edge)));
    !separates(edges[0].cross(edges[1])) && ![DVec3::X, DVec3::Y, DVec3::Z].map(crossed).contains(&true)
}
