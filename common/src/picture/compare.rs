//! How two pictures differ.

use super::{Film, PictureError, Size, Transfer};
use crate::math::Vec3;

/// The pixel with the largest difference in one channel; the first one, counted row by row from
/// the bottom, if several are equal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WorstPixel {
    /// Column from the left.
    pub x: u32,
    /// Row from the bottom.
    pub y: u32,
    /// Levels of the reference.
    pub expected: [u8; 3],
    /// Levels of the other picture.
    pub actual: [u8; 3],
}

impl WorstPixel {
    /// Largest difference of a channel, in levels.
    pub fn difference(&self) -> u8 {
        largest_difference(self.expected, self.actual)
    }
}

/// The difference of two pictures of one size, measured in 8-bit levels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// Number of pixels in each picture.
    pub pixels: usize,
    /// Pixels that differ by more than the tolerance in any channel.
    pub differing: usize,
    /// The worst pixel, or `None` if all levels are equal.
    pub worst: Option<WorstPixel>,
    /// Root of the mean squared difference over all channels, in levels (0 to 255).
    pub rmse: f64,
}

impl Comparison {
    /// Part of the pixels that differ by more than the tolerance, in [0, 1].
    pub fn share(&self) -> f64 {
        self.differing as f64 / self.pixels as f64
    }
}

/// Compares the levels of two pictures; a pixel counts as differing if a channel is more than
/// `tolerance` levels off.
///
/// # Errors
/// [`PictureError::SizesDiffer`].
pub fn compare(
    expected: &Film,
    actual: &Film,
    transfer: Transfer,
    tolerance: u8,
) -> Result<Comparison, PictureError> {
    let size = common_size(expected, actual)?;
    let mut differing = 0;
    let mut squares = 0_u64;
    let mut worst: Option<WorstPixel> = None;
    for y in 0..size.height() {
        for (x, (&e, &a)) in (0..).zip(expected.row(y).iter().zip(actual.row(y))) {
            let (expected, actual) = (transfer.levels(e), transfer.levels(a));
            let difference = largest_difference(expected, actual);
            differing += usize::from(difference > tolerance);
            squares += squared_difference(expected, actual);
            if difference > worst.map_or(0, |pixel| pixel.difference()) {
                worst = Some(WorstPixel { x, y, expected, actual });
            }
        }
    }
    Ok(Comparison {
        pixels: size.pixels(),
        differing,
        worst,
        rmse: (squares as f64 / (3 * size.pixels()) as f64).sqrt(),
    })
}

/// How much brighter differences are shown in [`triptych`].
const AMPLIFICATION: f32 = 16.0;

/// The reference, the difference of each channel made 16 times brighter, and the other picture,
/// side by side. The outer parts are shown as their levels are; the whole is to be written with
/// the same `transfer`.
///
/// # Errors
/// [`PictureError::SizesDiffer`], or [`PictureError::Size`] if three pictures are too many.
pub fn triptych(expected: &Film, actual: &Film, transfer: Transfer) -> Result<Film, PictureError> {
    let size = common_size(expected, actual)?;
    let wide = Size::new(3 * i64::from(size.width()), size.height().into())?;
    let mut film = Film::new(wide);
    let width = size.width() as usize;
    for y in 0..size.height() {
        let (left, rest) = film.row_mut(y).split_at_mut(width);
        let (middle, right) = rest.split_at_mut(width);
        left.copy_from_slice(expected.row(y));
        right.copy_from_slice(actual.row(y));
        for ((middle, &e), &a) in middle.iter_mut().zip(&*left).zip(&*right) {
            *middle = shown_difference(transfer, e, a);
        }
    }
    Ok(film)
}

/// Light whose levels are the amplified differences of two colours' levels.
fn shown_difference(transfer: Transfer, expected: Vec3, actual: Vec3) -> Vec3 {
    let (e, a) = (transfer.levels(expected), transfer.levels(actual));
    Vec3::from_array(std::array::from_fn(|c| {
        let shown = f32::from(e[c].abs_diff(a[c])) * AMPLIFICATION;
        transfer.light(shown as u8)
    }))
}

fn common_size(expected: &Film, actual: &Film) -> Result<Size, PictureError> {
    if expected.size() == actual.size() {
        return Ok(expected.size());
    }
    Err(PictureError::SizesDiffer { expected: expected.size(), actual: actual.size() })
}

fn largest_difference(a: [u8; 3], b: [u8; 3]) -> u8 {
    (0..3).map(|c| a[c].abs_diff(b[c])).max().unwrap_or(0)
}

fn squared_difference(a: [u8; 3], b: [u8; 3]) -> u64 {
    (0..3).map(|c| u64::from(a[c].abs_diff(b[c])).pow(2)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(level: u8) -> Vec3 {
        Vec3::splat(Transfer::Linear.light(level))
    }

    fn pair() -> (Film, Film) {
        let expected = Film::filled(Size::new(4, 3).unwrap(), grey(100));
        let mut actual = expected.clone();
        actual.set(1, 2, grey(103));
        actual.set(3, 0, grey(90));
        actual.set(0, 0, grey(101));
        (expected, actual)
    }

    #[test]
    fn counts_pixels_beyond_the_tolerance_and_finds_the_worst() {
        let (expected, actual) = pair();
        for (tolerance, differing) in [(0, 3), (1, 2), (3, 1), (10, 0)] {
            let result = compare(&expected, &actual, Transfer::Linear, tolerance).unwrap();
            assert_eq!(result.differing, differing, "{tolerance}");
            let worst = result.worst.unwrap();
            assert_eq!((worst.x, worst.y), (3, 0));
            assert_eq!((worst.expected, worst.actual), ([100; 3], [90; 3]));
        }
        let result = compare(&expected, &actual, Transfer::Linear, 0).unwrap();
        assert_eq!(result.share(), 0.25);
        // (9 + 100 + 1) · 3 channels over 36 values.
        assert!((result.rmse - (110.0_f64 / 12.0).sqrt()).abs() < 1e-12);
    }

    #[test]
    fn equal_levels_are_equal_even_when_the_light_differs() {
        let size = Size::new(2, 2).unwrap();
        let (dim, also_dim) = (Film::filled(size, grey(7)), Film::filled(size, grey(7) * 1.0001));
        let result = compare(&dim, &also_dim, Transfer::Linear, 0).unwrap();
        assert_eq!((result.worst, result.rmse, result.differing), (None, 0.0, 0));
    }

    #[test]
    fn sizes_must_agree() {
        let wide = Film::new(Size::new(3, 2).unwrap());
        let tall = Film::new(Size::new(2, 3).unwrap());
        assert!(compare(&wide, &tall, Transfer::Linear, 0).is_err());
        assert!(triptych(&wide, &tall, Transfer::Linear).is_err());
    }

    #[test]
    fn the_triptych_shows_both_and_the_amplified_difference() {
        let (expected, actual) = pair();
        let film = triptych(&expected, &actual, Transfer::Linear).unwrap();
        let level = |x, y| Transfer::Linear.levels(film.get(x, y))[0];
        assert_eq!((film.width(), film.height()), (12, 3));
        assert_eq!((level(1, 2), level(5, 2), level(9, 2)), (100, 48, 103));
        assert_eq!(level(6, 2), 0);
    }
}
