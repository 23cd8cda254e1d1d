//! The mesh as it came, in the units that the run works in.

use crate::collapse::surface::NONE;
use crate::collapse::weld::Welded;
use common::math::DVec3;
use common::mesh::Mesh;

/// The original mesh and its points.
pub(super) struct Original<'a> {
    mesh: &'a Mesh,
    welded: &'a Welded,
    scale: f64,
}

impl<'a> Original<'a> {
    /// `scale` as in [`Surface`](crate::collapse::surface::Surface).
    pub(super) fn new(mesh: &'a Mesh, welded: &'a Welded, scale: f64) -> Self {
        Self { mesh, welded, scale }
    }

    /// Where a point is.
    #[inline(always)]
    pub(super) fn at(&self, point: u32) -> DVec3 {
        self.welded.places[point as usize].as_dvec3() * self.scale
    }

    /// The points of the triangles.
    pub(super) fn triangles(&self) -> impl ExactSizeIterator<Item = [u32; 3]> {
        self.mesh.triangles.iter().map(|corners| corners.map(|v| self.welded.point_of[v as usize]))
    }

    /// Middle and normal, as long as twice the area, of a triangle.
    #[inline(always)]
    pub(super) fn middle(&self, corners: [u32; 3]) -> (DVec3, DVec3) {
        let [a, b, c] = corners.map(|point| self.at(point));
        ((a + b + c) * (1.0 / 3.0), (b - a).cross(c - a))
    }

    /// Whether a triangle has three different corners.
    pub(super) fn is_proper([a, b, c]: [u32; 3]) -> bool {
        a != b && b != c && c != a && a != NONE
    }
}
