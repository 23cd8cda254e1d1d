//! Rendering films tile by tile.

use super::{Tile, TileOptions, for_each_tile};
use crate::math::Vec3;
use crate::picture::{Film, Size};
use std::ops::AddAssign;
use std::sync::Mutex;

/// The pixels of one tile while it is worked on, in one or several layers (colour, depth,
/// normals, ...). All start black.
#[derive(Debug)]
pub struct TileLayers {
    tile: Tile,
    /// Layer after layer, each row by row from the bottom.
    pixels: Vec<Vec3>,
}

impl TileLayers {
    fn new(tile: Tile) -> Self {
        Self { tile, pixels: Vec::new() }
    }

    fn start(&mut self, tile: Tile, layers: usize) {
        self.tile = tile;
        self.pixels.clear();
        self.pixels.resize(tile.area() * layers, Vec3::ZERO);
    }

    /// Sets pixel (x, y) of the picture in one layer, counted from 0.
    ///
    /// # Panics
    /// If the pixel is outside the tile or there is no such layer.
    pub fn set(&mut self, layer: usize, x: u32, y: u32, color: Vec3) {
        let tile = self.tile;
        debug_assert!((tile.x0..tile.x1).contains(&x) && (tile.y0..tile.y1).contains(&y));
        let offset = (y - tile.y0) as usize * tile.width() as usize + (x - tile.x0) as usize;
        self.layer_mut(layer)[offset] = color;
    }

    /// One layer's pixels, [`Tile::width`] to a row, rows from the bottom.
    ///
    /// # Panics
    /// If there is no such layer.
    pub fn layer_mut(&mut self, layer: usize) -> &mut [Vec3] {
        let area = self.tile.area();
        &mut self.pixels[layer * area..][..area]
    }

    fn copy_into(&self, films: &mut [Film]) {
        let (x0, width) = (self.tile.x0 as usize, self.tile.width() as usize);
        for (film, layer) in films.iter_mut().zip(self.pixels.chunks(self.tile.area())) {
            for (y, row) in (self.tile.y0..).zip(layer.chunks(width)) {
                film.row_mut(y)[x0..x0 + width].copy_from_slice(row);
            }
        }
    }
}

/// What [`render`] made.
#[derive(Debug)]
pub struct Rendered<C> {
    /// One film per layer.
    pub films: Vec<Film>,
    /// The sum of all threads' counters.
    pub counters: C,
    /// Whether every tile was done; the films of a stopped rendering are black elsewhere.
    pub complete: bool,
}

struct Worker<S, C> {
    state: S,
    counters: C,
    out: TileLayers,
}

/// Renders `layers` films in one pass. `work` gets the thread's own state and counters, the tile,
/// and the tile's pixels to set. Counters are added up in no particular order, so `C`'s sum must
/// not depend on it (integers, not floats).
///
/// # Panics
/// If `work` does.
pub fn render<S: Send, C: Default + Send + AddAssign>(
    size: Size,
    layers: usize,
    options: &TileOptions,
    make_state: impl Fn() -> S + Sync,
    work: impl Fn(&mut S, Tile, &mut C, &mut TileLayers) + Sync,
) -> Rendered<C> {
    const NOWHERE: Tile = Tile { x0: 0, y0: 0, x1: 1, y1: 1 };
    let films = Mutex::new(vec![Film::new(size); layers]);
    let make_worker =
        || Worker { state: make_state(), counters: C::default(), out: TileLayers::new(NOWHERE) };
    let finished = for_each_tile(size, options, make_worker, |worker, tile| {
        worker.out.start(tile, layers);
        work(&mut worker.state, tile, &mut worker.counters, &mut worker.out);
        // Held for the copy of one tile only, which is short beside computing it.
        let mut films = films.lock().expect("copying does not panic");
        worker.out.copy_into(&mut films);
    });
    let mut counters = C::default();
    for worker in finished.states {
        counters += worker.counters;
    }
    Rendered {
        films: films.into_inner().expect("copying does not panic"),
        counters,
        complete: finished.complete,
    }
}
