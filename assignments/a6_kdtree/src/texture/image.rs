//! A6T4: pictures as textures.

use common::math::Vec3;
use common::picture::{Film, PictureError, Transfer, read};
use std::path::Path;

/// A picture that covers the plane like tiles: one tile is the unit square, its lower left
/// corner at (0, 0), its top at v = 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    film: Film,
}

impl Image {
    /// Reads a picture file. Its values count as they are, 8-bit ones as parts of 255: the
    /// course's pictures are written without a curve, so none is undone. What is not finite or
    /// below zero, as a float file may have it, counts as black.
    ///
    /// # Errors
    /// If the file cannot be read as a picture.
    pub fn read(path: &Path) -> Result<Self, PictureError> {
        Ok(Self::new(read(path, Transfer::Linear)?))
    }

    /// A picture that is in memory already.
    pub fn new(mut film: Film) -> Self {
        let usable = |c: f32| if c.is_finite() { c.max(0.0) } else { 0.0 };
        for pixel in film.pixels_mut() {
            *pixel = Vec3::from_array(pixel.to_array().map(usable));
        }
        Self { film }
    }

    /// The colour at (u, v), between the middles of the four nearest pixels in proportion
    /// (bilinear), across the border those of the next tile. Coordinates that are no finite
    /// numbers count as 0.
    pub fn at(&self, u: f64, v: f64) -> Vec3 {
        let ([left, right], x) = neighbours(u, self.film.width());
        let ([below, above], y) = neighbours(v, self.film.height());
        let row = |y: u32| self.film.get(left, y).lerp(self.film.get(right, y), x);
        row(below).lerp(row(above), y)
    }

    /// How much memory it takes, in bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(self.film.pixels())
    }
}

/// The pixels whose middles lie on both sides of a coordinate, in a row of `count`, and the
/// part of the way from the first to the second, in [0, 1).
fn neighbours(coordinate: f64, count: u32) -> ([u32; 2], f32) {
    let within = if coordinate.is_finite() { coordinate - coordinate.floor() } else { 0.0 };
    let place = within * f64::from(count) - 0.5;
    let before = place.floor();
    let first = before.rem_euclid(f64::from(count)) as u32;
    ([first, (first + 1) % count], (place - before) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use common::picture::Size;

    /// Red tells the column, green the row; blue is a half.
    fn picture() -> Image {
        let size = Size::new(4, 2).unwrap();
        Image::new(Film::from_fn(size, |x, y| Vec3::new(x as f32, y as f32, 0.5)))
    }

    #[test]
    fn a6t4_a_pixel_has_its_own_color_in_its_middle() {
        for (x, y) in (0..2).flat_map(|y| (0..4).map(move |x| (x, y))) {
            let (u, v) = ((f64::from(x) + 0.5) / 4.0, (f64::from(y) + 0.5) / 2.0);
            assert_eq!(picture().at(u, v), Vec3::new(x as f32, y as f32, 0.5), "v goes up");
        }
    }

    #[test]
    fn a6t4_between_pixels_and_across_borders() {
        assert_eq!(picture().at(0.25, 0.25), Vec3::new(0.5, 0.0, 0.5));
        assert_eq!(picture().at(0.5, 0.5), Vec3::new(1.5, 0.5, 0.5));
        assert_eq!(picture().at(0.0, 0.25), Vec3::new(1.5, 0.0, 0.5), "between the last and the first");
        assert_eq!(picture().at(0.125, 1.0), Vec3::new(0.0, 0.5, 0.5));
    }

    #[test]
    fn a6t4_tiles_repeat() {
        let image = picture();
        for (u, v) in [(0.1, 0.2), (0.6, 0.9), (0.999, 0.001)] {
            let there = image.at(u - 3.0, v + 7.0);
            assert!((image.at(u, v) - there).abs().max_element() < 1e-5, "{u} {v}");
        }
    }

    #[test]
    fn a6t4_any_coordinate_gives_a_color() {
        for c in [1e30, -1e300, -1e-300, -f64::EPSILON / 4.0, f64::INFINITY, f64::NAN, f64::MIN] {
            assert!(picture().at(c, -c).is_finite(), "{c}");
        }
    }

    #[test]
    fn a6t4_one_pixel_is_one_color() {
        let image = Image::new(Film::filled(Size::new(1, 1).unwrap(), Vec3::X));
        assert_eq!([image.at(0.0, 0.0), image.at(0.7, -3.2)], [Vec3::X; 2]);
    }

    #[test]
    fn a6t4_what_is_no_color_is_black() {
        let odd = Film::filled(Size::new(1, 1).unwrap(), Vec3::new(f32::NAN, f32::INFINITY, -1.0));
        assert_eq!(Image::new(odd).at(0.3, 0.3), Vec3::ZERO);
    }
}
