//! Picture files.

use super::family::{Sample, refusal};
use common::math::Vec3;
use common::picture::{Film, Size, Transfer, read as read_picture, write};
use std::path::Path;
use std::sync::OnceLock;
use tempfile::TempDir;

/// A folder for one file at a time.
fn folder() -> &'static Path {
    static FOLDER: OnceLock<TempDir> = OnceLock::new();
    FOLDER.get_or_init(|| tempfile::tempdir().expect("there is room for temporary files")).path()
}

/// A checksum of PNG files (ISO 3309), without which a promise would not be looked at.
fn crc(bytes: &[u8]) -> u32 {
    let step = |crc: u32, _: u32| if crc & 1 == 1 { crc >> 1 ^ 0xEDB8_8320 } else { crc >> 1 };
    !bytes.iter().fold(!0u32, |crc, byte| (0..8).fold(crc ^ u32::from(*byte), step))
}

/// A PNG file of which there is only the header.
fn promised_png(width: u32, height: u32) -> Vec<u8> {
    let mut header = b"IHDR".to_vec();
    header.extend(width.to_be_bytes());
    header.extend(height.to_be_bytes());
    header.extend([16, 6, 0, 0, 0]);
    let mut bytes = b"\x89PNG\r\n\x1a\n\x00\x00\x00\x0d".to_vec();
    bytes.extend(&header);
    bytes.extend(crc(&header).to_be_bytes());
    bytes.extend(b"\x00\x00\x00\x00IDAT");
    bytes
}

/// An EXR file that says it is larger than it is.
fn promised_exr(small: &[u8], width: u32, height: u32) -> Vec<u8> {
    let mut bytes = small.to_vec();
    for window in [&b"dataWindow\0box2i\0"[..], b"displayWindow\0box2i\0"] {
        let found = bytes.windows(window.len()).position(|part| part == window);
        let at = found.expect("the header has windows") + window.len() + 4;
        let corners = [0, 0, width - 1, height - 1].map(u32::to_le_bytes);
        bytes[at..at + 16].copy_from_slice(&corners.concat());
    }
    bytes
}

/// Small pictures of every kind, and headers with nothing behind them.
pub fn samples() -> Vec<Sample> {
    let film =
        Film::from_fn(Size::new(7, 5).expect("a size"), |x, y| Vec3::new(x as f32, y as f32, 0.5) / 7.0);
    let mut all = Vec::new();
    for suffix in ["tga", "png", "ppm", "pfm", "hdr", "exr"] {
        let path = folder().join(format!("sample.{suffix}"));
        write(&path, &film, Transfer::Linear).unwrap_or_else(|error| panic!("{error}"));
        let bytes = std::fs::read(&path).expect("it was written");
        all.push(Sample { name: format!("small.{suffix}"), bytes });
    }
    let exr = all[5].bytes.clone();
    for (width, height) in [(16_384, 16_384), (20_000, 10_000), (65_535, 4_000), (u32::MAX, u32::MAX)] {
        all.push(Sample { name: "promise.png".to_owned(), bytes: promised_png(width, height) });
        let mut word = |suffix: &str, text: String| {
            all.push(Sample { name: format!("promise.{suffix}"), bytes: text.into_bytes() });
        };
        word("pfm", format!("PF\n{width} {height}\n-1.0\n1234"));
        word("ppm", format!("P6\n{width} {height}\n255\nabc"));
        word("ppm", format!("P3\n{width} {height}\n65535\n1 2 3"));
        word("hdr", format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n\x02\x02"));
        if width < 65_536 {
            let sides = [width as u16, height as u16].map(u16::to_le_bytes).concat();
            let tga = [&[0, 0, 10, 0, 0, 0, 0, 0, 0, 0, 0, 0][..], &sides, &[24, 32, 0x80, 1, 2, 3]].concat();
            all.push(Sample { name: "promise.tga".to_owned(), bytes: tga });
            all.push(Sample { name: "promise.exr".to_owned(), bytes: promised_exr(&exr, width, height) });
        }
    }
    all
}

/// A picture, or a refusal.
pub fn read(name: &str, bytes: &[u8]) -> Result<(), String> {
    let path = folder().join(name);
    std::fs::write(&path, bytes).map_err(|error| error.to_string())?;
    match read_picture(&path, Transfer::Linear) {
        Ok(_) => Ok(()),
        Err(error) => refusal(&error.to_string()),
    }
}
