//! OBJ files: the door to tobj.

use super::Mesh;
use crate::math::Vec3;
use std::path::Path;

/// Why a mesh could not be read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct MeshError(String);

impl MeshError {
    /// An error with this message.
    pub fn new(message: impl Into<String>) -> Self {
        Self(message.into())
    }
}

/// Reads an OBJ file.
pub fn read_obj(path: &Path) -> Result<Mesh, MeshError> {
    let options = tobj::LoadOptions {
        triangulate: true,
        single_index: true,
        ignore_points: true,
        ignore_lines: true,
    };
    let fail = |error| MeshError(format!("{}: {error}", path.display()));
    let (models, _) = tobj::load_obj(path, &options).map_err(fail)?;
    let mut mesh = Mesh::default();
    for model in models {
        let base = mesh.positions.len() as u32;
        let points = model.mesh.positions.chunks_exact(3);
        mesh.positions.extend(points.map(Vec3::from_slice));
        let triangles = model.mesh.indices.chunks_exact(3);
        mesh.triangles
            .extend(triangles.map(|t| [t[0] + base, t[1] + base, t[2] + base]));
    }
    Ok(mesh)
}
