//! Triangle meshes in their own space, and reading them.

mod area;
mod error;
mod normals;
mod obj;

pub use area::has_area;
pub use error::{MeshError, read_bytes};
pub use obj::{parse_obj, read_obj};

use crate::math::{Vec2, Vec3};

/// An indexed triangle mesh; triangles see their vertices counter-clockwise from the front.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Vertex positions, all finite.
    pub positions: Vec<Vec3>,
    /// Three indices into `positions` per triangle, all in range, degenerate ones dropped.
    pub triangles: Vec<[u32; 3]>,
    /// Per-vertex normals given by the file, aligned with `positions`; empty if none.
    pub normals: Vec<Vec3>,
    /// Per-vertex texture coordinates, aligned with `positions`; empty if none.
    pub uvs: Vec<Vec2>,
    /// How many triangles of the file had no area and were dropped.
    pub degenerate: usize,
}

impl Mesh {
    /// The mesh without its triangles of no area (see [`has_area`]), counted in `degenerate`.
    ///
    /// # Errors
    /// If no triangle is left.
    pub fn without_degenerate(mut self) -> Result<Self, MeshError> {
        let before = self.triangles.len();
        let positions = &self.positions;
        self.triangles.retain(|corners| has_area(corners.map(|i| positions[i as usize])));
        self.degenerate += before - self.triangles.len();
        match (self.triangles.len(), self.degenerate) {
            (0, 0) => Err(MeshError::new("this file has no triangles")),
            (0, n) => Err(MeshError::new(format!("this file has no triangles: all {n} faces have no area"))),
            _ => Ok(self),
        }
    }
}
