//! Pictures of the samples and of the filter: `-render_samples` and `-render_filter` (§7.3).

use super::{Filter, pixel_places};
use crate::{Options, OracleError, Raster, Samples};
use common::math::DVec3;

/// Largest side of a picture of samples or of a filter, in pixels.
const LARGEST: u64 = 1 << 16;

const BRIGHT_CELL: DVec3 = DVec3::splat(0.2);
const GROUND: DVec3 = DVec3::new(0.0, 0.0, 0.5);
const LINES: DVec3 = DVec3::Z;

/// Each pixel as a cell of `zoom` × `zoom`, alternately grey and black, with a square dot in its
/// own colour where each sample stands; later samples over earlier ones.
///
/// # Errors
/// A `zoom` of 0, or one that makes the picture too large.
pub fn samples_picture(samples: &Samples, zoom: u32) -> Result<Raster, OracleError> {
    let (width, height) = enlarged(samples.width, samples.height, zoom, 0)?;
    let cell =
        |x: u32, y: u32| if (x / zoom + y / zoom).is_multiple_of(2) { BRIGHT_CELL } else { DVec3::ZERO };
    let mut picture = from_fn(width, height, cell);
    let places = pixel_places(samples.side);
    for (i, j) in (0..samples.height).flat_map(|j| (0..samples.width).map(move |i| (i, j))) {
        for (place, color) in places.iter().zip(samples.pixel(i, j)) {
            dot(&mut picture, (i, j), *place, *color, zoom);
        }
    }
    Ok(picture)
}

/// Paints the sample at `place` of pixel (i, j), inside the pixel's cell only.
fn dot(picture: &mut Raster, (i, j): (u32, u32), place: [f64; 2], color: DVec3, zoom: u32) {
    let reach = zoom / 16;
    let span = |cell: u32, offset: f64| {
        let middle = ((f64::from(cell) + offset) * f64::from(zoom)).floor() as u32;
        let (first, last) = (cell * zoom, cell * zoom + zoom - 1);
        middle.saturating_sub(reach).max(first)..=(middle + reach).min(last)
    };
    for y in span(j, place[1]) {
        for x in span(i, place[0]) {
            picture.pixels[y as usize * picture.width as usize + x as usize] = color;
        }
    }
}

/// The weights around the picture's middle pixel in grey, white at their centre, as far as that
/// pixel's support reaches; dark blue around, and a blue line at every border between pixels.
///
/// # Errors
/// Options without a filter; a `zoom` of 0, or one that makes the picture too large.
pub fn filter_picture(options: &Options, zoom: u32) -> Result<Raster, OracleError> {
    options.check()?;
    let filter = options.filter.ok_or(OracleError::Options("there is no filter to draw"))?;
    let (width, height) = enlarged(options.width, options.height, zoom, 1)?;
    let center = [options.width / 2, options.height / 2];
    let size = [options.width, options.height];
    Ok(from_fn(width, height, |x, y| {
        if x % zoom == 0 || y % zoom == 0 {
            return LINES;
        }
        let at = [x, y];
        let counts =
            |k: usize| at[k] / zoom < size[k] && (at[k] / zoom).abs_diff(center[k]) <= filter.support();
        if counts(0) && counts(1) { grey(filter, center, at, zoom) } else { GROUND }
    }))
}

/// The weight in a pixel of the picture of the filter, in parts of that at its centre.
fn grey(filter: Filter, center: [u32; 2], at: [u32; 2], zoom: u32) -> DVec3 {
    let offset = |k: usize| (f64::from(at[k]) + 0.5) / f64::from(zoom) - (f64::from(center[k]) + 0.5);
    DVec3::splat(filter.weight(offset(0), offset(1)) / filter.weight(0.0, 0.0))
}

fn enlarged(width: u32, height: u32, zoom: u32, more: u64) -> Result<(u32, u32), OracleError> {
    let [width, height] = [width, height].map(|side| u64::from(side) * u64::from(zoom) + more);
    if zoom == 0 || width.max(height) > LARGEST {
        return Err(OracleError::Options("the zoom must be at least 1, and leave the picture drawable"));
    }
    Ok((width as u32, height as u32))
}

fn from_fn(width: u32, height: u32, color: impl Fn(u32, u32) -> DVec3) -> Raster {
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| color(x, y));
    Raster { width, height, pixels: pixels.collect() }
}
