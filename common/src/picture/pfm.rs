//! Portable float maps: a line of text, then 32-bit floats, bottom row first.
//!
//! Format: <https://www.pauldebevec.com/Research/HDR/PFM/>. A negative scale in the header says
//! little endian.

use super::{Film, Size};
use crate::math::Vec3;

/// The file's bytes, little endian.
pub fn encode(film: &Film) -> Vec<u8> {
    let mut bytes = format!("PF\n{} {}\n-1.0\n", film.width(), film.height()).into_bytes();
    bytes.reserve(film.size().pixels() * 12);
    for pixel in film.pixels() {
        bytes.extend(pixel.to_array().into_iter().flat_map(f32::to_le_bytes));
    }
    bytes
}

/// Reads a colour (`PF`) or grey (`Pf`) map.
///
/// # Errors
/// A text that says what is wrong with the content.
pub fn decode(bytes: &[u8]) -> Result<Film, String> {
    let (header, data) = Header::parse(bytes)?;
    let needed = header.size.pixels() * header.channels * 4;
    if data.len() < needed {
        let found = data.len();
        return Err(format!("{needed} bytes of pixels expected, {found} found"));
    }
    let mut film = Film::new(header.size);
    let texels = data[..needed].chunks_exact(header.channels * 4);
    for (pixel, texel) in film.pixels_mut().iter_mut().zip(texels) {
        *pixel = header.color(texel);
    }
    Ok(film)
}

struct Header {
    size: Size,
    channels: usize,
    little_endian: bool,
}

impl Header {
    /// The header, and what follows the single white space that ends it.
    fn parse(bytes: &[u8]) -> Result<(Self, &[u8]), String> {
        let (magic, rest) = word(bytes)?;
        let channels = match magic {
            "PF" => 3,
            "Pf" => 1,
            _ => return Err("a portable float map starts with PF or Pf".to_owned()),
        };
        let (width, rest) = number::<i64>(rest, "width")?;
        let (height, rest) = number::<i64>(rest, "height")?;
        let (scale, rest) = number::<f32>(rest, "scale")?;
        let header = Self {
            size: Size::new(width, height).map_err(|error| error.to_string())?,
            channels,
            little_endian: scale.is_sign_negative(),
        };
        Ok((header, rest))
    }

    fn color(&self, texel: &[u8]) -> Vec3 {
        match *texel.as_chunks::<4>().0 {
            [r, g, b] => Vec3::new(self.float(r), self.float(g), self.float(b)),
            [grey] => Vec3::splat(self.float(grey)),
            _ => unreachable!("texels have one or three channels"),
        }
    }

    fn float(&self, bytes: [u8; 4]) -> f32 {
        if self.little_endian { f32::from_le_bytes(bytes) } else { f32::from_be_bytes(bytes) }
    }
}

/// The next word, and what follows the one white space after it.
fn word(bytes: &[u8]) -> Result<(&str, &[u8]), String> {
    let start = bytes.iter().position(|b| !b.is_ascii_whitespace()).unwrap_or(bytes.len());
    let bytes = &bytes[start..];
    let end = bytes.iter().position(u8::is_ascii_whitespace).ok_or("the header ends too early")?;
    let word = std::str::from_utf8(&bytes[..end]).map_err(|_| "the header is not text")?;
    Ok((word, &bytes[end + 1..]))
}

fn number<'a, T: std::str::FromStr>(bytes: &'a [u8], what: &str) -> Result<(T, &'a [u8]), String> {
    let (text, rest) = word(bytes)?;
    let value = text.parse().map_err(|_| format!("the {what} in the header is not a number: '{text}'"))?;
    Ok((value, rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_big_endian_and_grey() {
        let mut bytes = b"Pf\n2 1\n1.0\n".to_vec();
        bytes.extend(1.5_f32.to_be_bytes());
        bytes.extend((-2.0_f32).to_be_bytes());
        let film = decode(&bytes).unwrap();
        assert_eq!(film.pixels(), [Vec3::splat(1.5), Vec3::splat(-2.0)]);
    }

    #[test]
    fn every_prefix_is_an_error() {
        let film = Film::filled(Size::new(3, 2).unwrap(), Vec3::ONE);
        let bytes = encode(&film);
        for end in 0..bytes.len() {
            assert!(decode(&bytes[..end]).is_err(), "{end}");
        }
        assert_eq!(decode(&bytes), Ok(film));
    }

    #[test]
    fn a_declared_size_allocates_nothing_before_the_pixels_are_there() {
        let error = decode(b"PF\n16384 16384\n-1.0\n").unwrap_err();
        assert!(error.contains("expected, 0 found"), "{error}");
    }
}
