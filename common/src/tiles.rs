//! The tile loop: a picture cut into small rectangles, worked on by all cores.
//!
//! Every thread takes the next free tile until none is left, so that a hard corner of the picture
//! delays nobody. What a tile holds may depend on its position only, never on the thread; then
//! the picture is the same, bit for bit, for any number of threads and any tile size.
//!
//! [`render()`] makes films, [`for_each_tile`] is the loop below it, and [`for_each_job`] the loop
//! below that, for work that is not cut into rectangles.

mod jobs;
mod render;

pub use jobs::{Finished, for_each_job};
pub use render::{Rendered, TileLayers, render};

use crate::picture::Size;
use std::sync::atomic::AtomicBool;

/// A rectangle of pixels; `x1` and `y1` are just outside. Never empty.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tile {
    /// Leftmost column.
    pub x0: u32,
    /// Bottom row.
    pub y0: u32,
    /// One past the rightmost column.
    pub x1: u32,
    /// One past the top row.
    pub y1: u32,
}

impl Tile {
    /// Columns, at least 1.
    pub fn width(&self) -> u32 {
        self.x1 - self.x0
    }

    /// Rows, at least 1.
    pub fn height(&self) -> u32 {
        self.y1 - self.y0
    }

    /// Number of pixels, at least 1.
    pub fn area(&self) -> usize {
        self.width() as usize * self.height() as usize
    }

    /// The pixels (x, y), row by row from the bottom.
    pub fn pixels(&self) -> impl Iterator<Item = (u32, u32)> + use<> {
        let columns = self.x0..self.x1;
        (self.y0..self.y1).flat_map(move |y| columns.clone().map(move |x| (x, y)))
    }
}

/// How the tile loop runs; nothing here changes the picture.
#[derive(Clone, Copy, Debug, Default)]
pub struct TileOptions<'a> {
    /// Side of a tile in pixels; `None` chooses by the size of the picture, 0 counts as 1.
    pub tile: Option<u32>,
    /// Number of threads; `None` takes all cores, 0 counts as 1.
    pub threads: Option<usize>,
    /// What to call the work in the progress bar; `None` shows none.
    pub label: Option<&'a str>,
    /// Looked at between tiles; once true, no further tile is begun.
    pub stop: Option<&'a AtomicBool>,
}

impl TileOptions<'_> {
    /// The side of a tile: 16 pixels, fewer in small pictures so that all cores get some.
    fn side(&self, size: Size) -> u32 {
        const ENOUGH_TILES: usize = 32;
        let chosen =
            [16, 8, 4].into_iter().find(|side| size.pixels() >= (side * side) as usize * ENOUGH_TILES);
        self.tile.unwrap_or(chosen.unwrap_or(4)).max(1)
    }
}

/// Calls `work` once for every tile of a picture, each thread with a state of its own from
/// `make_state`; see [`for_each_job`].
///
/// # Panics
/// If `work` does.
pub fn for_each_tile<S: Send>(
    size: Size,
    options: &TileOptions,
    make_state: impl Fn() -> S + Sync,
    work: impl Fn(&mut S, Tile) + Sync,
) -> Finished<S> {
    let side = options.side(size);
    let columns = size.width().div_ceil(side) as usize;
    let rows = size.height().div_ceil(side) as usize;
    for_each_job(columns * rows, options, make_state, |state, job| {
        let (column, row) = ((job % columns) as u32, (job / columns) as u32);
        work(state, tile_at(column * side, row * side, side, size));
    })
}

/// The tile at a lower left corner, cut off where the picture ends.
fn tile_at(x0: u32, y0: u32, side: u32, size: Size) -> Tile {
    Tile {
        x0,
        y0,
        x1: x0.saturating_add(side).min(size.width()),
        y1: y0.saturating_add(side).min(size.height()),
    }
}

#[cfg(test)]
mod tests;
