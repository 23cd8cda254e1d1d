//! OBJ files.
//!
//! ```text
//! v 0 0 0          # a vertex
//! v 1 0 0
//! v 0 1 0
//! f 1 2 3          # a face: indices from 1, or from -1 backwards; more than three: a fan
//! f 1/1/1 2/2/1 3/3/1      # vertex/texture coordinate/normal
//! ```
//!
//! One pass of our own (`reader.rs`) reads vertices and faces and checks every statement, which
//! gives errors their line and is several times faster than tobj. Texture coordinates and
//! normals are left to tobj (`attributes.rs`), which then sees only statements known to be good.
//!
//! Decisions: objects, groups, materials, lines, points and keywords that nobody knows are
//! skipped; a face of one or two vertices, or of no area, is dropped and counted; a file without
//! a single triangle is an error.

mod attributes;
mod decimal;
mod reader;
mod tokens;

use super::error::read_bytes;
use super::{Mesh, MeshError};
use std::path::Path;

/// Reads an OBJ file; see [`parse_obj`].
///
/// # Errors
/// If the file cannot be read or is larger than 1 GiB, and as [`parse_obj`].
pub fn read_obj(path: &Path) -> Result<Mesh, MeshError> {
    let name = path.display().to_string();
    parse_obj(&name, &read_bytes(path)?)
}

/// Reads the text of an OBJ file; `name` is used in error messages.
///
/// Vertices keep the file's order. Only where faces refer to texture coordinates or normals, of
/// which one vertex can have several, vertices are split as needed and stand in the order of
/// their first use; normals (or texture coordinates) that not all corners have are dropped.
///
/// # Errors
/// If a vertex is not finite, an index is out of range, a statement cannot be read (each with
/// its line), or if the file has no triangle with an area.
pub fn parse_obj(name: &str, bytes: &[u8]) -> Result<Mesh, MeshError> {
    read(bytes).map_err(|error| error.in_file(name))
}

fn read(bytes: &[u8]) -> Result<Mesh, MeshError> {
    let plain = reader::read(bytes)?;
    let mesh = match plain.uses_attributes {
        true => attributes::read(bytes, plain.mesh.degenerate)?,
        false => plain.mesh,
    };
    mesh.without_degenerate()
}
