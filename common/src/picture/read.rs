//! Reading pictures.

use super::{Film, Kind, PictureError, Transfer, codec};
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Longest picture file that is read, in bytes; `/dev/zero` has no end.
const LONGEST_FILE: u64 = 4 << 30;

/// Reads a picture of any kind that can be written. The kind is told by the content, or by the
/// suffix where the content has no mark (TGA). `transfer` says what 8- and 16-bit values stand
/// for; [`Transfer::Linear`] gives back what was written with it.
///
/// # Errors
/// [`PictureError`] naming the file and what is wrong.
pub fn read(path: &Path, transfer: Transfer) -> Result<Film, PictureError> {
    let bytes = read_bytes(path).map_err(|source| PictureError::Read { path: path.to_owned(), source })?;
    let kind = match Kind::of_content(&bytes) {
        Some(kind) => kind,
        None => Kind::of_path(path)?,
    };
    codec::decode(kind, &bytes, transfer).map_err(|source| PictureError::Decode {
        path: path.to_owned(),
        suffix: kind.suffix(),
        source,
    })
}

fn read_bytes(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let read = File::open(path)?.take(LONGEST_FILE + 1).read_to_end(&mut bytes)?;
    if read as u64 > LONGEST_FILE {
        return Err(io::Error::other("the file is longer than 4 GiB"));
    }
    Ok(bytes)
}
