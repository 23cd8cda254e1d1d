//! Vertex normals for meshes that are to look smooth.

use super::Mesh;
use crate::math::{DVec3, Vec3};
use std::collections::HashMap;

impl Mesh {
    /// A unit normal for each vertex: those of the file, if it gives any; else the average over
    /// the triangles around the vertex, weighted by their angles there (Thürmer & Wüthrich,
    /// "Computing Vertex Normals from Polygonal Facets", 1998), so that it does not matter how a
    /// flat region is cut into triangles. Zero where triangles cancel, or no triangle is.
    ///
    /// Vertices at the same place count as one, since a file may name a place several times for
    /// the sake of its texture coordinates. Whoever wants a sharp edge gives normals.
    pub fn smooth_normals(&self) -> Vec<Vec3> {
        if !self.normals.is_empty() {
            return self.normals.iter().map(|n| n.as_dvec3().normalize_or_zero().as_vec3()).collect();
        }
        let mut sums: HashMap<[u32; 3], DVec3> = HashMap::new();
        for triangle in &self.triangles {
            let points = triangle.map(|k| self.positions[k as usize]);
            let [a, b, c] = points.map(|p| p.as_dvec3());
            let normal = (b - a).cross(c - a).normalize_or_zero();
            let angles =
                [(b - a).angle_between(c - a), (c - b).angle_between(a - b), (a - c).angle_between(b - c)];
            for (point, angle) in points.into_iter().zip(angles) {
                *sums.entry(place(point)).or_default() += normal * angle;
            }
        }
        let sum = |p: &Vec3| sums.get(&place(*p)).copied().unwrap_or_default();
        self.positions.iter().map(|p| sum(p).normalize_or_zero().as_vec3()).collect()
    }
}

/// The bits of a point; adding zero makes −0 and 0 the same place.
fn place(point: Vec3) -> [u32; 3] {
    (point + Vec3::ZERO).to_array().map(f32::to_bits)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh(positions: &[Vec3], triangles: &[[u32; 3]]) -> Mesh {
        Mesh { positions: positions.to_vec(), triangles: triangles.to_vec(), ..Mesh::default() }
    }

    /// The corner of a cube, one face of which is cut in two there: each face still counts once.
    #[test]
    fn angles_not_triangles_count() {
        let (o, x, y, z) = (Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z);
        let corner = mesh(&[o, x, y, z, x + y], &[[0, 1, 4], [0, 4, 2], [0, 2, 3], [0, 3, 1]]);
        let normal = corner.smooth_normals()[0];
        assert!((normal - Vec3::ONE.normalize()).length() < 1e-6, "{normal}");
    }

    #[test]
    fn vertices_at_one_place_share_a_normal() {
        let roof = [
            Vec3::ZERO,
            Vec3::Y,
            Vec3::new(-1.0, 0.0, -1.0),
            Vec3::new(-0.0, 0.0, 0.0),
            Vec3::Y,
            Vec3::new(1.0, 0.0, -1.0),
        ];
        let normals = mesh(&roof, &[[0, 1, 2], [3, 5, 4]]).smooth_normals();
        assert_eq!(normals[0], normals[3]);
        assert!((normals[0] - Vec3::Z).length() < 1e-6, "{}", normals[0]);
    }

    #[test]
    fn given_normals_are_made_unit_and_missing_ones_are_zero() {
        let triangle = mesh(&[Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::ONE], &[[0, 1, 2]]);
        assert_eq!(triangle.smooth_normals()[2..], [Vec3::Z, Vec3::ZERO]);
        let given = Mesh { normals: vec![Vec3::X * 2.0, Vec3::ZERO, Vec3::Y, Vec3::Z], ..triangle };
        assert_eq!(given.smooth_normals(), [Vec3::X, Vec3::ZERO, Vec3::Y, Vec3::Z]);
    }
}
