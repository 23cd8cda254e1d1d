//! A9T6: mesh files: OBJ, PLY and STL, in and out.
//!
//! What kind a file is, its suffix says. Files are read whole (1 GiB at most), every claim of a
//! header is checked against the file's size before anything is set aside for it, and errors
//! name the file, and its line where it has lines. Files are written under another name and
//! renamed, so that a failure leaves the old one, or none.

mod obj;
mod ply;
mod stl;

use common::atomic::{self, Unwritable};
use common::mesh::{Mesh, MeshError, read_bytes};
use std::path::{Path, PathBuf};

/// A kind of mesh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Wavefront: text, with normals and texture coordinates.
    Obj,
    /// Stanford polygons: text or binary in, binary out, with normals and texture coordinates.
    Ply,
    /// Stereolithography: text or binary in, binary out; corners only.
    Stl,
}

/// Why a mesh could not be read or written.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// It could not be read.
    #[error(transparent)]
    Read(#[from] MeshError),
    /// It could not be written.
    #[error(transparent)]
    Write(#[from] Unwritable),
    /// The suffix names no kind of mesh file.
    #[error("'{}' is no kind of mesh file that can be used here; known are .obj .ply .stl", .0.display())]
    Suffix(PathBuf),
    /// The format cannot hold it.
    #[error("a mesh of {triangles} triangles does not fit a .{suffix} file")]
    TooLarge {
        /// Triangles of the mesh.
        triangles: usize,
        /// The format's suffix.
        suffix: &'static str,
    },
}

impl Kind {
    /// Every kind, in the order in which texts list them.
    pub const ALL: [Self; 3] = [Self::Obj, Self::Ply, Self::Stl];

    /// The usual suffix, without the dot.
    pub fn suffix(self) -> &'static str {
        match self {
            Self::Obj => "obj",
            Self::Ply => "ply",
            Self::Stl => "stl",
        }
    }

    /// The kind that a path's suffix names, in upper or lower case.
    pub fn of_path(path: &Path) -> Option<Self> {
        let suffix = path.extension()?;
        Self::ALL.into_iter().find(|kind| suffix.eq_ignore_ascii_case(kind.suffix()))
    }

    /// Reads the bytes of a file of this kind; `name` is used in error messages.
    ///
    /// # Errors
    /// If a number is not finite, an index is out of range, the file ends too soon or is otherwise
    /// not what its kind demands, or has no triangle with an area.
    pub fn parse(self, name: &str, bytes: &[u8]) -> Result<Mesh, MeshError> {
        let mesh = match self {
            Self::Obj => return common::mesh::parse_obj(name, bytes),
            Self::Ply => ply::parse(bytes),
            Self::Stl => stl::parse(bytes),
        };
        mesh.and_then(Mesh::without_degenerate).map_err(|error| error.in_file(name))
    }

    /// The bytes of a file of this kind.
    ///
    /// # Errors
    /// If the format cannot hold so many triangles.
    pub fn bytes(self, mesh: &Mesh) -> Result<Vec<u8>, FileError> {
        let bytes = match self {
            Self::Obj => Some(obj::to_text(mesh).into_bytes()),
            Self::Ply => ply::to_bytes(mesh),
            Self::Stl => stl::to_bytes(mesh),
        };
        let triangles = mesh.triangles.len();
        bytes.ok_or(FileError::TooLarge { triangles, suffix: self.suffix() })
    }
}

/// The kind of a file's name.
///
/// # Errors
/// [`FileError::Suffix`].
fn kind(path: &Path) -> Result<Kind, FileError> {
    Kind::of_path(path).ok_or_else(|| FileError::Suffix(path.to_owned()))
}

/// Reads a mesh file; see [`Kind::parse`].
///
/// # Errors
/// If the suffix is unknown, the file cannot be read or is larger than 1 GiB, and as
/// [`Kind::parse`].
pub fn read(path: &Path) -> Result<Mesh, FileError> {
    let kind = kind(path)?;
    Ok(kind.parse(&path.display().to_string(), &read_bytes(path)?)?)
}

/// Makes sure, before any work is done, that a mesh can be written to `path`.
///
/// # Errors
/// If the suffix is unknown, or the folder is missing or protected, or the file is.
pub fn check_output(path: &Path) -> Result<(), FileError> {
    kind(path)?;
    Ok(atomic::check(path)?)
}

/// Writes a mesh file, whole or not at all.
///
/// # Errors
/// [`FileError`]; an old file is then still there.
pub fn write(path: &Path, mesh: &Mesh) -> Result<(), FileError> {
    let bytes = kind(path)?.bytes(mesh)?;
    Ok(atomic::replace(path, &bytes).map_err(|source| Unwritable::refused(path, source))?)
}
