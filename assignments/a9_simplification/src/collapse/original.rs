//! The mesh as it came, in the units that the run works in.

use crate::collapse::surface::{NONE, Surface};
use crate::collapse::weld::Welded;
use common::math::DVec3;
use common::mesh::Mesh;

/// The original mesh and its points.
pub(super) struct Original<'a> {
    mesh: &'a Mesh,
    welded: &'a Welded,
    /// Its surface before anything was done to it.
    pub surface: &'a Surface,
}

impl<'a> Original<'a> {
    /// Of a mesh, welded, and its surface.
    pub(super) fn new(mesh: &'a Mesh, welded: &'a Welded, surface: &'a Surface) -> Self {
        Self { mesh, welded, surface }
    }

    /// Where a point is.
    #[inline(always)]
    pub(super) fn at(&self, point: u32) -> DVec3 {
        self.welded.places[point as usize].as_dvec3() * self.surface.scale
    }

    /// The points of the triangles.
    pub(super) fn triangles(&self) -> impl ExactSizeIterator<Item = [u32; 3]> {
        self.mesh.triangles.iter().map(|corners| corners.map(|v| self.welded.point_of[v as usize]))
    }

    /// Middle and normal, as long as twice the area, of a triangle.
    #[inline(always)]
    pub(super) fn middle(&self, corners: [u32; 3]) -> (DVec3, DVec3) {
        let [a, b, c] = [self.at(corners[0]), self.at(corners[1]), self.at(corners[2])];
        ((a + b + c) * (1.0 / 3.0), (b - a).cross(c - a))
    }

    /// Whether a triangle has three different corners.
    pub(super) fn is_proper([a, b, c]: [u32; 3]) -> bool {
        a != b && b != c && c != a && a != NONE
    }
}
