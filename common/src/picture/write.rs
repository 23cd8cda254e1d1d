//! Writing pictures.

use super::{Film, Kind, PictureError, Size, Transfer, codec};
use crate::atomic::{self, Target, Unwritable};
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
    Ok(atomic::check(path)?)
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
    Ok(atomic::replace(path, &bytes).map_err(|source| Unwritable::refused(path, source))?)
}

fn target(path: &Path) -> Result<Target, PictureError> {
    Ok(atomic::target(path).map_err(|source| Unwritable::refused(path, source))?)
}

fn output_kind(path: &Path, target: &Target) -> Result<Kind, PictureError> {
    match Kind::of_path(path) {
        Err(_) if *target == Target::Stream => Ok(Kind::Tga),
        Err(_) if *target == Target::Folder => Err(Unwritable::IsFolder(path.to_owned()).into()),
        kind => kind,
    }
}
