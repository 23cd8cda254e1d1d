//! Triangle meshes in their own space, and reading them.

mod area;
mod normals;
mod obj;

pub use area::has_area;
pub use obj::{MeshError, parse_obj, read_obj};

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
    /// Drops the triangles without area (see [`has_area`]) and counts them in `degenerate`.
    fn drop_degenerate(&mut self) {
        let before = self.triangles.len();
        let positions = &self.positions;
        self.triangles.retain(|corners| has_area(corners.map(|i| positions[i as usize])));
        self.degenerate += before - self.triangles.len();
    }
}
