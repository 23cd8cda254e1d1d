//! Reading a scene file and the meshes it names.

use super::{Scene, SceneError};
use crate::mesh::{Mesh, MeshError};
use std::path::Path;

/// Where meshes come from while a scene is parsed: the file system, or a test's table.
pub trait MeshSource {
    /// The mesh that `name` (as written in the scene) stands for.
    fn mesh(&mut self, name: &str) -> Result<Mesh, MeshError>;
}

/// Reads a scene file with its meshes; see [`parse_str`].
pub fn load(_path: &Path) -> Result<Scene, SceneError> {
    todo!()
}

/// Parses the text of a scene file; `name` is used in error messages.
pub fn parse_str(
    _name: &str,
    _text: &str,
    _meshes: &mut dyn MeshSource,
) -> Result<Scene, SceneError> {
    todo!()
}
