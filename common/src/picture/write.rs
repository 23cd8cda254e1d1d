//! Writing pictures.

use super::atomic::{self, Target};
use super::{Film, Kind, PictureError, Size, Transfer, codec};
use std::fs;
use std::path::Path;

/// Makes sure, before anything is rendered, that a picture of this size can be written to `path`:
/// the suffix is known, the format can hold the size, the folder is there and can be written to.
/// The file itself is not touched.
///
/// A device or pipe without a known suffix (`/dev/null`, `/dev/stdout`) takes a TGA.
///
/// # Errors
/// [`PictureError`] naming the file and what is wrong.
pub fn check_output(path: &Path, size: Size) -> Result<(), PictureError> {
    let target = target(path)?;
    output_kind(path, &target)?.check_size(size)?;
    match target {
        Target::Folder => Err(PictureError::IsFolder(path.to_owned())),
        Target::Stream => Ok(()),
        Target::File(real) => check_file(path, &real),
    }
}

/// Writes a picture whose kind is told by the suffix of `path`; see [`check_output`]. An existing
/// file is replaced only by a complete new one. `transfer` matters for 8-bit kinds only.
///
/// # Errors
/// [`PictureError`] naming the file and what is wrong; an old file is then still there.
pub fn write(path: &Path, film: &Film, transfer: Transfer) -> Result<(), PictureError> {
    let kind = output_kind(path, &target(path)?)?;
    kind.check_size(film.size())?;
    let bytes = codec::encode(kind, film, transfer)
        .map_err(|source| PictureError::Encode { path: path.to_owned(), source })?;
    atomic::replace(path, &bytes).map_err(|source| cannot_write(path, source))
}

fn target(path: &Path) -> Result<Target, PictureError> {
    atomic::target(path).map_err(|source| cannot_write(path, source))
}

fn output_kind(path: &Path, target: &Target) -> Result<Kind, PictureError> {
    match Kind::of_path(path) {
        Err(_) if *target == Target::Stream => Ok(Kind::Tga),
        Err(_) if *target == Target::Folder => Err(PictureError::IsFolder(path.to_owned())),
        kind => kind,
    }
}

/// `path` is as the user wrote it, `real` with symbolic links resolved.
fn check_file(path: &Path, real: &Path) -> Result<(), PictureError> {
    let folder = atomic::folder_of(real);
    if !folder.is_dir() {
        return Err(PictureError::NoFolder { path: path.to_owned(), folder: folder.to_owned() });
    }
    if fs::metadata(real).is_ok_and(|meta| meta.permissions().readonly()) {
        return Err(PictureError::ReadOnly(path.to_owned()));
    }
    // Trying is the only test that knows about owners, quotas and read-only media.
    atomic::temporary_in(folder).map(drop).map_err(|source| cannot_write(path, source))
}

fn cannot_write(path: &Path, source: std::io::Error) -> PictureError {
    PictureError::Write { path: path.to_owned(), source }
}
