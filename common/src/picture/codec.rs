//! Picture formats in memory: the door to the `image` crate.

use super::{Film, Kind, MAX_PIXELS, Size, Transfer, pfm, quantise};
use crate::math::Vec3;
use image::codecs::{hdr, openexr, png, pnm, tga};
use image::{
    ColorType, DynamicImage, ExtendedColorType, ImageDecoder, ImageEncoder, ImageFormat, ImageReader,
};
use std::error::Error;
use std::io::Cursor;

type CodecError = Box<dyn Error + Send + Sync>;

/// The bytes of a picture file. `transfer` matters for 8-bit kinds only.
pub fn encode(kind: Kind, film: &Film, transfer: Transfer) -> Result<Vec<u8>, CodecError> {
    if kind == Kind::Pfm {
        return Ok(pfm::encode(film));
    }
    let mut out = Vec::new();
    let (width, height) = (film.width(), film.height());
    if kind.is_float() {
        let bytes = floats_from_top(film, kind);
        let color = ExtendedColorType::Rgb32F;
        match kind {
            Kind::Exr => openexr::OpenExrEncoder::new(Cursor::new(&mut out))
                .write_image(&bytes, width, height, color)?,
            _ => hdr::HdrEncoder::new(&mut out).write_image(&bytes, width, height, color)?,
        }
    } else {
        let levels = quantise::levels_from_top(film, transfer);
        encode_levels(kind, &levels, film.size(), &mut out)?;
    }
    Ok(out)
}

fn encode_levels(kind: Kind, levels: &[u8], size: Size, out: &mut Vec<u8>) -> Result<(), CodecError> {
    let color = ExtendedColorType::Rgb8;
    let (width, height) = (size.width(), size.height());
    match kind {
        // With run lengths off the header is the course's: 18 bytes, type 2, origin at the top.
        Kind::Tga => tga::TgaEncoder::new(out).disable_rle().encode(levels, width, height, color)?,
        Kind::Ppm => pnm::PnmEncoder::new(out)
            .with_subtype(pnm::PnmSubtype::Pixmap(pnm::SampleEncoding::Binary))
            .write_image(levels, width, height, color)?,
        _ => png::PngEncoder::new(out).write_image(levels, width, height, color)?,
    }
    Ok(())
}

/// Linear floats as bytes, top row first. Radiance files cannot say NaN or a negative value.
fn floats_from_top(film: &Film, kind: Kind) -> Vec<u8> {
    let representable = |c: f32| match kind {
        Kind::Hdr if c > 0.0 => c.min(MAX_RADIANCE),
        Kind::Hdr => 0.0,
        _ => c,
    };
    let mut bytes = Vec::with_capacity(film.size().pixels() * 12);
    for color in film.rows().rev().flatten() {
        let channels = color.to_array().map(representable);
        bytes.extend(channels.into_iter().flat_map(f32::to_ne_bytes));
    }
    bytes
}

/// Largest value that a shared exponent of 127 leaves representable.
const MAX_RADIANCE: f32 = 1.690_000_1e38;

/// Reads a picture file of the given kind. `transfer` says what 8- and 16-bit values stand for.
pub fn decode(kind: Kind, bytes: &[u8], transfer: Transfer) -> Result<Film, CodecError> {
    if kind == Kind::Pfm {
        return Ok(pfm::decode(bytes)?);
    }
    let reader = ImageReader::with_format(Cursor::new(bytes), format(kind));
    let decoder = reader.into_decoder()?;
    let (width, height) = decoder.dimensions();
    let size = Size::new(width.into(), height.into())?;
    check_promise(size, decoder.total_bytes(), bytes.len())?;
    // Bounds what a small file can make us allocate: the pixels as stored, and a working copy.
    let mut decoder = decoder;
    let mut limits = image::Limits::no_limits();
    limits.max_alloc = Some(2 * MAX_PIXELS * u64::from(decoder.color_type().bytes_per_pixel()));
    decoder.set_limits(limits)?;
    let color = decoder.color_type();
    Ok(film_of(size, color, DynamicImage::from_decoder(decoder)?, transfer))
}

/// A header may promise what is not there, and room for it would be set aside before that turns out.
/// No kind of file packs more than about a thousand bytes into one (deflate: 1032); small pictures
/// are believed without that.
fn check_promise(size: Size, needed: u64, given: usize) -> Result<(), CodecError> {
    const BELIEVED: u64 = 16 << 20;
    const PACKED: u64 = 4096;
    if needed <= BELIEVED.max(given as u64 * PACKED) {
        return Ok(());
    }
    Err(format!("a picture of {size} pixels cannot be in a file of {given} bytes").into())
}

fn format(kind: Kind) -> ImageFormat {
    match kind {
        Kind::Tga => ImageFormat::Tga,
        Kind::Png => ImageFormat::Png,
        Kind::Ppm | Kind::Pfm => ImageFormat::Pnm,
        Kind::Exr => ImageFormat::OpenExr,
        Kind::Hdr => ImageFormat::Hdr,
    }
}

/// Transparency is dropped; grey becomes three equal channels.
fn film_of(size: Size, color: ColorType, picture: DynamicImage, transfer: Transfer) -> Film {
    let top = size.height() - 1;
    if color.bytes_per_pixel() == color.channel_count() {
        let levels = picture.into_rgb8();
        return Film::from_fn(size, |x, y| {
            let pixel = levels.get_pixel(x, top - y);
            Vec3::from_array(pixel.0.map(|level| transfer.light(level)))
        });
    }
    let linear = matches!(color, ColorType::Rgb32F | ColorType::Rgba32F);
    let curve = if linear { Transfer::Linear } else { transfer };
    let floats = picture.into_rgb32f();
    Film::from_fn(size, |x, y| {
        let pixel = floats.get_pixel(x, top - y);
        Vec3::from_array(pixel.0.map(|coded| curve.decode(coded)))
    })
}
