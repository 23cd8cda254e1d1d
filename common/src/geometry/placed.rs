//! Which triangles are copies of a mesh, and how it was placed.

use super::Geometry;
use crate::math::Affine;
use crate::mesh::Mesh;
use std::ops::Range;
use std::sync::Arc;

/// One use of a mesh in a scene.
#[derive(Clone, Debug)]
pub struct PlacedMesh {
    /// The mesh in its own space; copies of one file share it.
    pub mesh: Arc<Mesh>,
    /// Where it was taken.
    pub to_world: Affine,
    /// Position of its first triangle in [`Geometry::triangles`]; the others follow in the order
    /// of the mesh. Under a mirroring map their second and third corners are swapped.
    pub start: usize,
    /// Number of the first triangle; the others follow.
    pub first: u32,
}

impl PlacedMesh {
    /// Positions of its triangles in [`Geometry::triangles`].
    pub fn triangles(&self) -> Range<usize> {
        self.start..self.start + self.mesh.triangles.len()
    }

    /// Where corner `k` of the mesh's triangles stands in those of the scene.
    pub fn order(&self) -> [usize; 3] {
        super::build::winding(&self.to_world)
    }
}

impl Geometry {
    /// Every use of a mesh, in file order.
    pub fn placed_meshes(&self) -> impl Iterator<Item = &PlacedMesh> {
        self.runs.iter().filter_map(|run| run.placed.as_deref())
    }
}
