//! OBJ files: the door to tobj.

use super::Mesh;
use std::path::Path;

/// Why a mesh could not be read.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct MeshError(pub String);

/// Reads an OBJ file.
pub fn read_obj(_path: &Path) -> Result<Mesh, MeshError> {
    todo!()
}
