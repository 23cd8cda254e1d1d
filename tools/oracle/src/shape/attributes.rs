//! What a mesh knows about the corners of its triangles besides where they are: texture
//! coordinates and normals.

use super::{Triangle, Uv};
use common::math::DVec3;
use common::mesh::Mesh;
use std::collections::HashMap;

/// Attributes of all corners of a mesh, triangle by triangle; empty lists where there are none.
#[derive(Clone, Debug, Default)]
pub(crate) struct Attributes {
    /// Normals to interpolate, of unit length or zero.
    pub normals: Vec<[DVec3; 3]>,
    /// Texture coordinates.
    pub uvs: Vec<[Uv; 3]>,
}

impl Attributes {
    /// The attributes of `mesh`, whose corners are `triangles`. Normals are taken over only if
    /// the scene asks for a `smooth` mesh, and made if the file gives none.
    pub fn new(mesh: &Mesh, triangles: &[Triangle], smooth: bool) -> Self {
        let uv = |i: u32| mesh.uvs[i as usize].to_array().map(f64::from);
        let given = |i: u32| mesh.normals[i as usize].as_dvec3().normalize_or_zero();
        let uvs = match mesh.uvs.is_empty() {
            true => Vec::new(),
            false => mesh.triangles.iter().map(|t| t.map(uv)).collect(),
        };
        let normals = match (smooth, mesh.normals.is_empty()) {
            (false, _) => Vec::new(),
            (true, false) => mesh.triangles.iter().map(|t| t.map(given)).collect(),
            (true, true) => averages(triangles),
        };
        Self { normals, uvs }
    }
}

/// For each corner the mean of the unit normals of all triangles that meet at its point, each
/// weighted with its angle there (Thürmer and Wüthrich, "Computing Vertex Normals from Polygonal
/// Facets", 1998): so that it does not matter how the faces were cut into triangles. Corners
/// meet where their coordinates are equal, also where texture coordinates have a seam.
fn averages(triangles: &[Triangle]) -> Vec<[DVec3; 3]> {
    let mut sums: HashMap<[u64; 3], DVec3> = HashMap::new();
    for &[a, b, c] in triangles {
        let normal = (b - a).cross(c - a).normalize_or_zero();
        for (p, q, r) in [(a, b, c), (b, c, a), (c, a, b)] {
            *sums.entry(key(p)).or_default() += (q - p).angle_between(r - p) * normal;
        }
    }
    triangles.iter().map(|t| t.map(|p| sums[&key(p)].normalize_or_zero())).collect()
}

/// A point as a key; both zeros are one.
fn key(p: DVec3) -> [u64; 3] {
    p.to_array().map(|c| (c + 0.0).to_bits())
}

/// The weights with which the corners of a triangle make up a point of its plane.
pub(crate) fn barycentric(&[a, b, c]: &Triangle, point: DVec3) -> DVec3 {
    let normal = (b - a).cross(c - a);
    let part = |from: DVec3, to: DVec3| normal.dot((to - from).cross(point - from));
    DVec3::new(part(b, c), part(c, a), part(a, b)) / normal.length_squared()
}
