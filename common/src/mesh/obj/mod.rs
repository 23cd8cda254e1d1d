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

use super::Mesh;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// Largest OBJ file that is read, in bytes.
const MOST_BYTES: u64 = 1 << 30;

/// Why a mesh could not be read: the file, the line if there is one, and the reason.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub struct MeshError {
    file: Option<String>,
    line: Option<usize>,
    message: String,
}

impl std::fmt::Display for MeshError {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        if let Some(file) = &self.file {
            write!(f, "{file}:")?;
        }
        if let Some(line) = self.line {
            write!(f, "{line}:")?;
        }
        let space = if self.file.is_some() || self.line.is_some() { " " } else { "" };
        write!(f, "{space}{}", self.message)
    }
}

impl MeshError {
    /// An error of no particular file.
    pub fn new(message: impl Into<String>) -> Self {
        Self { file: None, line: None, message: message.into() }
    }

    /// Line of the OBJ file, from 1, if the error has one.
    pub fn line(&self) -> Option<usize> {
        self.line
    }

    fn at_line(line: usize, message: impl Into<String>) -> Self {
        Self { line: Some(line), ..Self::new(message) }
    }

    fn in_file(self, name: &str) -> Self {
        Self { file: Some(name.to_owned()), ..self }
    }
}

/// Reads an OBJ file; see [`parse_obj`].
///
/// # Errors
/// If the file cannot be read or is larger than 1 GiB, and as [`parse_obj`].
pub fn read_obj(path: &Path) -> Result<Mesh, MeshError> {
    let name = path.display().to_string();
    let fail = |error: std::io::Error| MeshError::new(error.to_string()).in_file(&name);
    let file = File::open(path).map_err(fail)?;
    let mut bytes = Vec::new();
    file.take(MOST_BYTES + 1).read_to_end(&mut bytes).map_err(fail)?;
    if bytes.len() as u64 > MOST_BYTES {
        let message = format!("the file is larger than {} MiB", MOST_BYTES >> 20);
        return Err(MeshError::new(message).in_file(&name));
    }
    parse_obj(&name, &bytes)
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
    let mut mesh = match plain.uses_attributes {
        true => attributes::read(bytes, plain.mesh.degenerate)?,
        false => plain.mesh,
    };
    mesh.drop_degenerate();
    match (mesh.triangles.len(), mesh.degenerate) {
        (0, 0) => Err(MeshError::new("this file has no triangles")),
        (0, n) => Err(MeshError::new(format!("this file has no triangles: all {n} faces have no area"))),
        _ => Ok(mesh),
    }
}
