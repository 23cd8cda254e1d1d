//! Normals of smooth meshes: interpolated, for shading only.
//!
//! Phong ("Illumination for Computer Generated Pictures", 1975) shades a flat triangle with the
//! normal of the round surface that it stands for. The triangle stays where it is, so the two
//! can disagree about sides. Three rules keep light from going astray:
//!
//! * which side a ray comes from, where it starts and whether it gets through, the triangle's own
//!   normal decides, never the smooth one;
//! * the smooth normal is bent until it faces the viewer that the triangle faces ([`facing`]),
//!   else outlines would turn black;
//! * light that the triangle turns its back to does not count, and a mirrored or refracted ray
//!   that would end up on the wrong side is worked out with the triangle's own normal. Both
//!   stand where light is shaded (assignments 2 and 4).

use crate::math::{Affine, DVec3, Vec3};
use crate::mesh::Mesh;
use std::sync::Arc;

/// The sine of the angle by which a smooth normal must face the same way as its polygon does.
/// Far above what rounding could undo, far below what anyone could see.
const FACING: f64 = 1e-4;

/// The smooth unit normal nearest to `normal` that a viewer sees from the side it should:
/// `sight` is the unit direction of sight, `from_behind` whether the polygon itself turns its
/// back to the viewer.
pub fn facing(normal: DVec3, sight: DVec3, from_behind: bool) -> DVec3 {
    let side = if from_behind { 1.0 } else { -1.0 };
    let towards = normal.dot(sight) * side;
    let missing = (FACING - towards).max(0.0);
    (normal + sight * (missing * side)).normalize_or_zero()
}

/// The vertex normals of a mesh, placed in the world.
#[derive(Clone, Debug)]
pub(crate) struct Smooth {
    /// Its triangles.
    pub mesh: Arc<Mesh>,
    /// A normal for each vertex in the mesh's own space; zero where there is none.
    pub normals: Arc<[Vec3]>,
    /// From there to the world.
    pub to_world: Affine,
    /// Which corner of a triangle in the file is the first, second and third in the world.
    pub order: [usize; 3],
}

impl Smooth {
    /// The interpolated unit normal at a point of a triangle, given by the weights of its second
    /// and third corner; `geometric` where the corners' normals cancel. A file whose normals
    /// all point away from the front of a triangle is taken to mean the opposite ones.
    pub fn normal(&self, triangle: usize, [u, v]: [f32; 2], geometric: DVec3) -> DVec3 {
        let corners = self.mesh.triangles[triangle];
        let normals = self.order.map(|k| self.in_world(corners[k]));
        let (u, v) = (f64::from(u), f64::from(v));
        let sum = normals[0] * (1.0 - u - v) + normals[1] * u + normals[2] * v;
        let turned = normals.iter().all(|n| n.dot(geometric) < 0.0);
        (if turned { -sum } else { sum }).normalize_or(geometric)
    }

    /// A vertex's normal goes with M⁻ᵀ.
    fn in_world(&self, vertex: u32) -> DVec3 {
        let normal = self.normals[vertex as usize].as_dvec3();
        self.to_world.normal(normal).normalize_or_zero()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One triangle in z = 0, front towards +z, with these normals at its corners.
    fn smooth(normals: [Vec3; 3]) -> Smooth {
        let mesh = Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            triangles: vec![[0, 1, 2]],
            ..Mesh::default()
        };
        let to_world = Affine::IDENTITY;
        Smooth { mesh: Arc::new(mesh), normals: Arc::new(normals), to_world, order: [0, 1, 2] }
    }

    #[test]
    fn corners_and_middle() {
        let (a, b) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.6, 0.0, 0.8));
        let smooth = smooth([a, b, b]);
        let close = |p: DVec3, q: DVec3| (p - q).length() < 1e-7;
        assert!(close(smooth.normal(0, [0.0, 0.0], DVec3::Z), a.as_dvec3()));
        assert!(close(smooth.normal(0, [0.0, 1.0], DVec3::Z), b.as_dvec3()));
        assert!(close(smooth.normal(0, [0.25, 0.25], DVec3::Z), DVec3::Z));
    }

    #[test]
    fn what_cancels_or_is_missing_gives_the_geometric_normal() {
        assert_eq!(smooth([Vec3::X, -Vec3::X, Vec3::Z]).normal(0, [0.5, 0.0], DVec3::Z), DVec3::Z);
        assert_eq!(smooth([Vec3::ZERO; 3]).normal(0, [0.2, 0.3], DVec3::Z), DVec3::Z);
    }

    #[test]
    fn normals_of_a_mesh_wound_the_other_way_are_turned() {
        assert_eq!(smooth([-Vec3::Z; 3]).normal(0, [0.2, 0.3], DVec3::Z), DVec3::Z);
    }

    #[test]
    fn facing_bends_only_what_looks_away() {
        let sight = DVec3::new(1.0, 0.0, 0.0);
        let towards = DVec3::new(-0.8, 0.6, 0.0);
        assert_eq!(facing(towards, sight, false), towards);
        for away in [DVec3::X, DVec3::Y, DVec3::new(0.6, 0.8, 0.0)] {
            assert!(facing(away, sight, false).dot(sight) < -0.9 * FACING, "{away}");
            assert!(facing(-away, sight, true).dot(sight) > 0.9 * FACING, "{away}");
        }
    }
}
