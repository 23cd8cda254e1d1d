//! The tile loop: a picture cut into small rectangles, worked on by all cores.
//!
//! Every thread takes the next free tile until none is left, so that a hard corner of the picture
//! delays nobody. What a tile holds may depend on its position only, never on the thread; then
//! the picture is the same, bit for bit, for any number of threads and any tile size.
//!
//! The calling thread starts alone and calls for help when a tenth of a millisecond has not been
//! enough: waking other threads costs about as much, and many pictures are done by then.

mod queue;
mod render;

pub use render::{Rendered, TileLayers, render};

use crate::picture::Size;
use queue::Queue;
use std::sync::Mutex;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

/// How long the calling thread works alone: about the price of waking the others.
const ALONE: Duration = Duration::from_micros(100);

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
        let chosen = [16, 8, 4]
            .into_iter()
            .find(|side| size.pixels() >= (side * side) as usize * ENOUGH_TILES);
        self.tile.unwrap_or(chosen.unwrap_or(4)).max(1)
    }
}

/// What [`for_each_tile`] leaves behind.
#[derive(Debug)]
pub struct Finished<S> {
    /// The state of every thread that took part, in no particular order; at least one.
    pub states: Vec<S>,
    /// Whether every tile was done; false only after [`TileOptions::stop`].
    pub complete: bool,
}

/// Calls `work` once for every tile of a picture, each thread with a state of its own from
/// `make_state`.
///
/// # Panics
/// If `work` does.
pub fn for_each_tile<S: Send>(
    size: Size,
    options: &TileOptions,
    make_state: impl Fn() -> S + Sync,
    work: impl Fn(&mut S, Tile) + Sync,
) -> Finished<S> {
    let queue = Queue::new(size, options.side(size), options);
    let mut state = make_state();
    let started = Instant::now();
    while started.elapsed() < ALONE {
        let Some(tile) = queue.next() else {
            return queue.finish(vec![state]);
        };
        work(&mut state, tile);
        queue.done();
    }
    let states = Mutex::new(Vec::new());
    let drain = |mut state: S| {
        while let Some(tile) = queue.next() {
            work(&mut state, tile);
            queue.done();
        }
        states.lock().expect("no panic while pushing").push(state);
    };
    with_helpers(options.threads, queue.remaining(), state, &drain, &|| {
        drain(make_state());
    });
    queue.finish(states.into_inner().expect("no panic while pushing"))
}

/// Runs `own(state)` here and `help` on the other threads: of the current pool, or of one made
/// for the occasion if another number of threads is asked for.
fn with_helpers<S: Send>(
    threads: Option<usize>,
    tiles: usize,
    state: S,
    own: &(impl Fn(S) + Sync),
    help: &(impl Fn() + Sync),
) {
    let most = tiles.max(1);
    match threads.map(|n| n.clamp(1, most)) {
        Some(1) => own(state),
        Some(n) if n != rayon::current_num_threads() => {
            // Without a pool of its own (no more threads to be had) the work is done all the same.
            match rayon::ThreadPoolBuilder::new().num_threads(n - 1).build() {
                Ok(pool) => pool.in_place_scope(|scope| {
                    (1..n).for_each(|_| scope.spawn(|_| help()));
                    own(state);
                }),
                Err(_) => own(state),
            }
        }
        _ => rayon::in_place_scope(|scope| {
            let helpers = rayon::current_num_threads().min(most) - 1;
            (0..helpers).for_each(|_| scope.spawn(|_| help()));
            own(state);
        }),
    }
}

#[cfg(test)]
mod tests;
