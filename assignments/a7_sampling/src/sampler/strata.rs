//! Grids: one sample in each cell, at its centre or anywhere inside.

use super::hash::{mix, shuffled, units};
use super::{Pixel, Sampler, key, pair};

/// The cells that a unit square is cut into.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Strata {
    /// Cells along the first coordinate.
    pub columns: u32,
    /// Cells along the second.
    pub rows: u32,
}

impl Strata {
    /// As many cells as samples, as nearly square as can be: √n × √n for a square number, a
    /// single row for a prime one.
    pub fn new(samples: u32) -> Self {
        let samples = samples.max(1);
        let rows = (1..=samples.isqrt()).rev().find(|rows| samples.is_multiple_of(*rows)).unwrap_or(1);
        Self { columns: samples / rows, rows }
    }

    /// How many there are.
    pub fn count(self) -> u32 {
        self.columns * self.rows
    }

    /// The point at (u, v) of a cell, counted row by row.
    fn point(self, cell: u32, [u, v]: [f64; 2]) -> [f64; 2] {
        let (column, row) = (cell % self.columns, cell / self.columns);
        [(f64::from(column) + u) / f64::from(self.columns), (f64::from(row) + v) / f64::from(self.rows)]
    }

    /// Which cell a sample takes. In the pixel they are taken row by row; in all other pairs they
    /// are shuffled, or the corner of a pixel would always see the same corner of a light.
    fn cell(self, sample: u32, pair: u32, key: u64) -> u32 {
        let sample = sample % self.count();
        if pair == pair::PIXEL { sample } else { shuffled(sample, self.count(), key) }
    }
}

/// The centres of the cells, the same in every pixel.
pub struct Uniform {
    strata: Strata,
    seed: u64,
}

impl Uniform {
    /// A grid of this many cells.
    pub fn new(samples: u32, seed: u64) -> Self {
        Self { strata: Strata::new(samples), seed }
    }
}

impl Sampler for Uniform {
    fn pair(&self, pixel: Pixel, sample: u32, pair: u32) -> [f64; 2] {
        let cell = self.strata.cell(sample, pair, key(self.seed, pixel, pair));
        self.strata.point(cell, [0.5, 0.5])
    }
}

/// One point anywhere in each cell.
pub struct Jittered {
    strata: Strata,
    seed: u64,
}

impl Jittered {
    /// A grid of this many cells.
    pub fn new(samples: u32, seed: u64) -> Self {
        Self { strata: Strata::new(samples), seed }
    }
}

impl Sampler for Jittered {
    fn pair(&self, pixel: Pixel, sample: u32, pair: u32) -> [f64; 2] {
        let key = key(self.seed, pixel, pair);
        let inside = units(mix(key ^ mix(u64::from(sample) + 1)));
        self.strata.point(self.strata.cell(sample, pair, key), inside)
    }
}
