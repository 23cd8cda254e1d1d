//! Handing out tiles.

use super::{Finished, Tile, TileOptions};
use crate::cli::Progress;
use crate::picture::Size;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// The tiles of one picture, row by row from the bottom, each handed out once.
pub struct Queue<'a> {
    size: Size,
    side: u32,
    columns: usize,
    count: usize,
    next: AtomicUsize,
    stop: Option<&'a AtomicBool>,
    progress: Progress<'a>,
}

impl<'a> Queue<'a> {
    pub fn new(size: Size, side: u32, options: &TileOptions<'a>) -> Self {
        let columns = size.width().div_ceil(side) as usize;
        let count = columns * size.height().div_ceil(side) as usize;
        Self {
            size,
            side,
            columns,
            count,
            next: AtomicUsize::new(0),
            stop: options.stop,
            progress: Progress::new(options.label, count),
        }
    }

    /// The next tile, or `None` when there is none left or the work has been stopped.
    pub fn next(&self) -> Option<Tile> {
        if self.stop.is_some_and(|stop| stop.load(Ordering::Relaxed)) {
            return None;
        }
        let index = self.next.fetch_add(1, Ordering::Relaxed);
        (index < self.count).then(|| self.tile(index))
    }

    fn tile(&self, index: usize) -> Tile {
        let side = self.side;
        let x0 = (index % self.columns) as u32 * side;
        let y0 = (index / self.columns) as u32 * side;
        Tile {
            x0,
            y0,
            x1: x0.saturating_add(side).min(self.size.width()),
            y1: y0.saturating_add(side).min(self.size.height()),
        }
    }

    /// Tiles not handed out yet.
    pub fn remaining(&self) -> usize {
        self.count.saturating_sub(self.next.load(Ordering::Relaxed))
    }

    /// Reports one tile as done.
    pub fn done(&self) {
        self.progress.step();
    }

    /// Clears the progress bar and passes on the states.
    pub fn finish<S>(self, states: Vec<S>) -> Finished<S> {
        Finished {
            states,
            complete: self.progress.count() == self.count,
        }
    }
}
