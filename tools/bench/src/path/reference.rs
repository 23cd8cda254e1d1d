//! Converged pictures to compare with.

use common::cli::AppError;
use common::math::Vec3;
use common::picture::{Film, Size, Transfer, read};
use std::fs;
use std::path::Path;

/// Reads a picture: any kind that we write, or an array of NumPy of shape (height, width, 3), in
/// `f32`, rows from the top.
///
/// # Errors
/// If the file cannot be read or is neither.
pub fn load(path: &Path) -> Result<Film, AppError> {
    if path.extension().is_none_or(|suffix| suffix != "npy") {
        return Ok(read(path, Transfer::Linear)?);
    }
    let bytes = fs::read(path)?;
    array(&bytes).ok_or_else(|| {
        let what = "an array of shape (height, width, 3) of little-endian f32 in row order";
        AppError::Usage(format!("{}: this is not {what}", path.display()))
    })
}

/// An array in NumPy's format, version 1.
fn array(bytes: &[u8]) -> Option<Film> {
    let rest = bytes.strip_prefix(b"\x93NUMPY\x01\x00")?;
    let (length, rest) = rest.split_first_chunk::<2>()?;
    let (header, data) = rest.split_at_checked(usize::from(u16::from_le_bytes(*length)))?;
    let header: String = std::str::from_utf8(header).ok()?.split_whitespace().collect();
    if !header.contains("'descr':'<f4'") || !header.contains("'fortran_order':False") {
        return None;
    }
    let shape = header.split_once("'shape':(")?.1.split_once(')')?.0;
    let sides: Vec<i64> = shape.split(',').map(|n| n.parse().ok()).collect::<Option<_>>()?;
    let [height, width, 3] = sides[..] else { return None };
    let size = Size::new(width, height).ok()?;
    let (pixels, []) = data.as_chunks::<12>() else { return None };
    if pixels.len() != size.pixels() {
        return None;
    }
    let channel = |pixel: &[u8; 12], c: usize| f32::from_le_bytes([0, 1, 2, 3].map(|i| pixel[4 * c + i]));
    Some(Film::from_fn(size, |x, y| {
        let row = size.height() - 1 - y;
        let pixel = &pixels[row as usize * size.width() as usize + x as usize];
        Vec3::new(channel(pixel, 0), channel(pixel, 1), channel(pixel, 2))
    }))
}
