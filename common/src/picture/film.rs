//! The film: linear light, one colour per pixel.

use super::Size;
use crate::math::Vec3;

/// A picture in linear RGB, 32-bit floats. Pixel (0, 0) is at the lower left, x goes right and y
/// up, as the course counts; rows are stored from the bottom to the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    size: Size,
    pixels: Vec<Vec3>,
}

impl Film {
    /// A black film.
    pub fn new(size: Size) -> Self {
        Self::filled(size, Vec3::ZERO)
    }

    /// A film of one colour.
    pub fn filled(size: Size, color: Vec3) -> Self {
        Self { size, pixels: vec![color; size.pixels()] }
    }

    /// A film whose pixel (x, y) is `color(x, y)`.
    pub fn from_fn(size: Size, mut color: impl FnMut(u32, u32) -> Vec3) -> Self {
        let mut film = Self::new(size);
        for y in 0..size.height() {
            for (x, pixel) in (0..).zip(film.row_mut(y)) {
                *pixel = color(x, y);
            }
        }
        film
    }

    /// Width and height.
    pub fn size(&self) -> Size {
        self.size
    }

    /// Width in pixels, at least 1.
    pub fn width(&self) -> u32 {
        self.size.width()
    }

    /// Height in pixels, at least 1.
    pub fn height(&self) -> u32 {
        self.size.height()
    }

    /// The colour of pixel (x, y).
    ///
    /// # Panics
    /// If the pixel is outside the film.
    pub fn get(&self, x: u32, y: u32) -> Vec3 {
        self.row(y)[x as usize]
    }

    /// Sets the colour of pixel (x, y).
    ///
    /// # Panics
    /// If the pixel is outside the film.
    pub fn set(&mut self, x: u32, y: u32, color: Vec3) {
        self.row_mut(y)[x as usize] = color;
    }

    /// Row y, from left to right.
    ///
    /// # Panics
    /// If there is no such row.
    pub fn row(&self, y: u32) -> &[Vec3] {
        let width = self.width() as usize;
        &self.pixels[y as usize * width..][..width]
    }

    /// Row y, from left to right.
    ///
    /// # Panics
    /// If there is no such row.
    pub fn row_mut(&mut self, y: u32) -> &mut [Vec3] {
        let width = self.width() as usize;
        &mut self.pixels[y as usize * width..][..width]
    }

    /// The rows from the bottom to the top; reverse it for the order of most picture files.
    pub fn rows(&self) -> impl DoubleEndedIterator<Item = &[Vec3]> + ExactSizeIterator {
        self.pixels.chunks_exact(self.width() as usize)
    }

    /// All pixels, row by row from the bottom.
    pub fn pixels(&self) -> &[Vec3] {
        &self.pixels
    }

    /// All pixels, row by row from the bottom.
    pub fn pixels_mut(&mut self) -> &mut [Vec3] {
        &mut self.pixels
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_count_from_the_bottom() {
        let mut film = Film::new(Size::new(3, 2).unwrap());
        film.set(2, 0, Vec3::X);
        film.set(0, 1, Vec3::Y);
        assert_eq!(film.pixels()[2], Vec3::X);
        assert_eq!(film.pixels()[3], Vec3::Y);
        assert_eq!(film.rows().next_back(), Some(film.row(1)));
        assert_eq!(film.get(0, 1), Vec3::Y);
    }

    #[test]
    fn from_fn_visits_every_pixel_with_its_own_position() {
        let film = Film::from_fn(Size::new(4, 3).unwrap(), |x, y| Vec3::new(x as f32, y as f32, 0.0));
        assert_eq!(film.get(3, 2), Vec3::new(3.0, 2.0, 0.0));
        assert_eq!(film.get(0, 1), Vec3::new(0.0, 1.0, 0.0));
    }

    #[test]
    #[should_panic(expected = "out of bounds")]
    fn a_column_outside_is_not_the_next_row() {
        Film::new(Size::new(3, 2).unwrap()).get(3, 0);
    }
}
