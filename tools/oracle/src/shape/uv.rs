//! Texture coordinates of shapes that bring none along.

use super::{Plane, Uv};
use common::math::DVec3;
use std::f64::consts::PI;

/// A triangle by itself shows the lower left half of the picture.
pub(super) const BARE_TRIANGLE: [Uv; 3] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];

/// Longitude and latitude of a direction. The poles are on the y axis; u runs
/// eastwards from −z, so that the middle of the picture faces +z, and v from the south pole to
/// the north pole.
pub(super) fn of_direction(p: DVec3) -> Uv {
    let p = p.normalize_or(DVec3::Z);
    let longitude = p.x.atan2(p.z);
    [0.5 + longitude / (2.0 * PI), 0.5 + p.y.clamp(-1.0, 1.0).asin() / PI]
}

/// Distances along the plane from the point of it nearest to the origin; one picture covers a
/// square of side 1.
pub(super) fn of_plane(plane: &Plane, point: DVec3) -> Uv {
    let (u, v) = axes(plane.normal);
    [point.dot(u), point.dot(v)]
}

/// Two unit vectors along a plane: seen from the side that its normal points to, v goes up as
/// the y axis does and u to the right. On what is more floor than wall, v goes into the scene (−z).
fn axes(normal: DVec3) -> (DVec3, DVec3) {
    let is_floor = normal.y.abs() > normal.x.abs() && normal.y.abs() > normal.z.abs();
    let upward = if is_floor { -DVec3::Z } else { DVec3::Y };
    let u = upward.cross(normal).normalize();
    (u, normal.cross(u))
}
