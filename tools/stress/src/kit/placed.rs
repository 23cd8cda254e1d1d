//! Closed meshes put somewhere, and rays aimed at their weak spots.

use super::{Draw, inside_points};
use common::math::{DVec3, Vec3};
use common::mesh::Mesh;
use common::ray::Ray;
use common::simd::{self, Level};

/// Corners in world space with points inside.
pub struct Placement {
    /// The triangles.
    pub triangles: Vec<[Vec3; 3]>,
    /// Points that the mesh surrounds.
    pub inside: Vec<Vec3>,
}

/// The mesh scaled, then moved, corners rounded to `f32`, with up to `points` points inside.
pub fn placed(mesh: &Mesh, scale: f64, offset: DVec3, points: usize) -> Placement {
    let place = |p: Vec3| (p.as_dvec3() * scale + offset).as_vec3();
    let corners = |t: &[u32; 3]| t.map(|i| place(mesh.positions[i as usize]));
    let triangles: Vec<_> = mesh.triangles.iter().map(corners).collect();
    let inside = inside_points(&triangles, points, 11);
    Placement { triangles, inside }
}

/// A ray from `origin` to a corner, a point of an edge, or the centroid of a random triangle;
/// half of them of unit length, the others as long as the way.
pub fn aim(draw: &mut Draw, triangles: &[[Vec3; 3]], origin: Vec3) -> Ray {
    let [a, b, c] = triangles[draw.below(triangles.len())].map(|v| v.as_dvec3());
    let target = match draw.below(4) {
        0 => a,
        1 => a + (b - a) * draw.dyadic_share(),
        2 => a + (b - a) * draw.unit(),
        _ => (a + b + c) / 3.0,
    };
    let way = target - origin.as_dvec3();
    let direction = if draw.chance(0.5) { way.normalize_or_zero() } else { way }.as_vec3();
    Ray::new(origin, if direction == Vec3::ZERO { Vec3::X } else { direction })
}

/// Every instruction set that this processor has, with its name.
pub fn simd_levels() -> Vec<(&'static str, Level)> {
    let names = ["baseline", "sse4", "avx2", "avx512"];
    names.into_iter().filter_map(|name| Some((name, simd::by_name(name)?))).collect()
}
