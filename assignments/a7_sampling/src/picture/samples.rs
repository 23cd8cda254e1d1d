//! A7T1: where samples lie, as a picture.

use crate::exposure::Sample;
use common::cli::AppError;
use common::math::Vec3;
use common::picture::{Film, Size};
use std::sync::Mutex;

/// The size of a picture that shows every pixel `zoom` × `zoom` times as large, and `more` rows
/// and columns.
///
/// # Errors
/// If that is too large.
pub fn zoomed(size: Size, zoom: u32, more: u32) -> Result<Size, AppError> {
    let side = |n: u32| i64::from(n) * i64::from(zoom) + i64::from(more);
    Ok(Size::new(side(size.width()), side(size.height()))?)
}

/// Every pixel as a cell, alternately 0.2 grey and black, and in it a square dot for each sample,
/// in its colour; later samples lie over earlier ones.
pub struct SamplesPicture {
    film: Mutex<Film>,
    zoom: u32,
}

impl SamplesPicture {
    /// The bare cells of a picture of `size`.
    ///
    /// # Errors
    /// If the picture would be too large.
    pub fn new(size: Size, zoom: u32) -> Result<Self, AppError> {
        let grey = |x: u32, y: u32| (x / zoom + y / zoom).is_multiple_of(2);
        let ground = |x, y| if grey(x, y) { Vec3::splat(0.2) } else { Vec3::ZERO };
        Ok(Self { film: Mutex::new(Film::from_fn(zoomed(size, zoom, 0)?, ground)), zoom })
    }

    /// Paints the samples of one pixel; dots end at the border of its cell.
    ///
    /// # Panics
    /// Never: nothing panics while the film is held.
    pub fn paint(&self, samples: &[Sample]) {
        let mut film = self.film.lock().expect("painting does not panic");
        let (zoom, half) = (i64::from(self.zoom), i64::from(self.zoom / 16));
        for sample in samples {
            let middle = |at: f64| ((at * f64::from(self.zoom)) as i64).min(zoom - 1);
            let reach = |m: i64| (m - half).max(0)..(m + half + 1).min(zoom);
            for y in reach(middle(sample.at[1])) {
                for x in reach(middle(sample.at[0])) {
                    let place = |cell: u32, inside: i64| cell * self.zoom + inside as u32;
                    film.set(place(sample.pixel.0, x), place(sample.pixel.1, y), sample.color);
                }
            }
        }
    }

    /// The picture.
    ///
    /// # Panics
    /// Never: nothing panics while the film is held.
    pub fn into_film(self) -> Film {
        self.film.into_inner().expect("painting does not panic")
    }
}
