//! The kinds of picture files, told by suffix or by content.

use super::{PictureError, Size};
use std::path::Path;

/// A kind of picture file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Truevision: 24 bits, uncompressed; what the course writes.
    Tga,
    /// Portable network graphics, 8 bits.
    Png,
    /// Portable pixmap, written as binary, 8 bits.
    Ppm,
    /// Portable float map: 32-bit floats, uncompressed.
    Pfm,
    /// OpenEXR: 32-bit floats.
    Exr,
    /// Radiance: 8 bits a channel with a shared exponent.
    Hdr,
}

impl Kind {
    /// Every kind, in the order in which error texts list them.
    pub const ALL: [Self; 6] = [Self::Tga, Self::Png, Self::Ppm, Self::Pfm, Self::Exr, Self::Hdr];

    /// The usual suffix, without the dot.
    pub fn suffix(self) -> &'static str {
        match self {
            Self::Tga => "tga",
            Self::Png => "png",
            Self::Ppm => "ppm",
            Self::Pfm => "pfm",
            Self::Exr => "exr",
            Self::Hdr => "hdr",
        }
    }

    /// The kind that a path's suffix names, in upper or lower case.
    ///
    /// # Errors
    /// [`PictureError::UnknownSuffix`], which lists the known ones.
    pub fn of_path(path: &Path) -> Result<Self, PictureError> {
        let suffix = path.extension().unwrap_or_default().to_string_lossy();
        Self::ALL
            .into_iter()
            .find(|kind| suffix.eq_ignore_ascii_case(kind.suffix()))
            .ok_or_else(|| PictureError::unknown_suffix(path, &suffix))
    }

    /// The kind that a file's first bytes give away. TGA has no mark to know it by; the grey and
    /// black-and-white relatives of PPM are taken for it.
    pub fn of_content(bytes: &[u8]) -> Option<Self> {
        const MARKS: [(&[u8], Kind); 11] = [
            (b"\x89PNG\r\n\x1a\n", Kind::Png),
            (b"P1", Kind::Ppm),
            (b"P2", Kind::Ppm),
            (b"P3", Kind::Ppm),
            (b"P4", Kind::Ppm),
            (b"P5", Kind::Ppm),
            (b"P6", Kind::Ppm),
            (b"PF", Kind::Pfm),
            (b"Pf", Kind::Pfm),
            (b"\x76\x2f\x31\x01", Kind::Exr),
            (b"#?", Kind::Hdr),
        ];
        MARKS.into_iter().find(|(mark, _)| bytes.starts_with(mark)).map(|(_, kind)| kind)
    }

    /// Whether files of this kind hold linear light rather than 8-bit levels.
    pub fn is_float(self) -> bool {
        matches!(self, Self::Pfm | Self::Exr | Self::Hdr)
    }

    /// Longest side that the file format can say, in pixels.
    fn longest_side(self) -> u32 {
        match self {
            Self::Tga => u32::from(u16::MAX),
            _ => u32::MAX,
        }
    }

    /// Refuses sizes that files of this kind cannot hold.
    pub(super) fn check_size(self, size: Size) -> Result<(), PictureError> {
        if size.width().max(size.height()) <= self.longest_side() {
            return Ok(());
        }
        Err(PictureError::SideTooLong { size, suffix: self.suffix(), longest: self.longest_side() })
    }
}
