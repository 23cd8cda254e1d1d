//! Exact overlap with a box, touching included.

use super::aabb::Aabb;
use crate::shape::{Sphere, Triangle};
use common::math::{DMat3, DMat4, DVec3};

/// Does the solid sphere meet the box? By the distance of its centre from the box (Arvo, in
/// Graphics Gems, 1990).
pub(super) fn sphere_touches(sphere: &Sphere, cell: &Aabb) -> bool {
    let nearest = sphere.center.clamp(cell.min, cell.max);
    nearest.distance(sphere.center) <= sphere.radius
}

/// Does the solid `sphere`, placed in the world by the inverse of `to_object`, meet the box?
///
/// The squared distance of a point's image from the centre is a convex quadratic function of
/// the point. Its least value over the box lies inside, on a face, on an edge or at a corner:
/// along each axis the point is free or at one of two ends, and of these 27 cases the least
/// that lies in the box is the answer.
pub(super) fn ellipsoid_touches(sphere: &Sphere, to_object: &DMat4, cell: &Aabb) -> bool {
    let linear = DMat3::from_mat4(*to_object);
    let toward = linear.transpose() * (sphere.center - to_object.transform_point3(DVec3::ZERO));
    let ends = |axis: usize| [None, Some(cell.min[axis]), Some(cell.max[axis])];
    let cases = ends(0).map(|x| ends(1).map(|y| ends(2).map(|z| [x, y, z])));
    let mut points = cases.as_flattened().as_flattened().iter().map(|fixed| {
        // Where the gradient vanishes along the free axes: (AᵀA)p = Aᵀ(c − A0), row by row.
        let mut rows = (linear.transpose() * linear).transpose();
        let mut right = toward;
        for (axis, end) in fixed.iter().enumerate() {
            if let Some(end) = end {
                *rows.col_mut(axis) = DVec3::AXES[axis];
                right[axis] = *end;
            }
        }
        rows.transpose().inverse() * right
    });
    points.any(|p| {
        let inside = p.clamp(cell.min, cell.max);
        to_object.transform_point3(inside).distance(sphere.center) <= sphere.radius
    })
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
