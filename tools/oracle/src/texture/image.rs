//! Pictures on surfaces (our extension `ImageTexture`).

use crate::shape::Uv;
use common::math::DVec3;
use common::picture::{Film, PictureError, Transfer, read};
use common::scene::ImageTexture;
use std::sync::Arc;

/// A picture that repeats in both directions. 8-bit values stand for level/255, without gamma,
/// as in the pictures that the course writes.
#[derive(Clone, Debug)]
pub(super) struct Image {
    film: Arc<Film>,
    /// Repetitions along u and v.
    scale: Uv,
}

impl Image {
    /// Reads the picture.
    pub fn new(texture: &ImageTexture) -> Result<Self, PictureError> {
        let film = Arc::new(read(&texture.file, Transfer::Linear)?);
        Ok(Self { film, scale: texture.scale.map(f64::from) })
    }

    /// The colour at (u, v): the picture fills the unit square, v upwards, before it is scaled.
    /// Between the centres of four pixels colours are blended.
    pub fn at(&self, uv: Uv) -> DVec3 {
        let size = [self.film.width(), self.film.height()].map(f64::from);
        let place: Uv = std::array::from_fn(|k| self.scale[k] * uv[k] * size[k] - 0.5);
        let corner = place.map(f64::floor);
        let pixel = |right: f64, up: f64| {
            let x = (corner[0] + right).rem_euclid(size[0]) as u32;
            let y = (corner[1] + up).rem_euclid(size[1]) as u32;
            self.film.get(x, y).as_dvec3()
        };
        let row = |up: f64| pixel(0.0, up).lerp(pixel(1.0, up), place[0] - corner[0]);
        row(0.0).lerp(row(1.0), place[1] - corner[1])
    }
}
