//! Multi-jittered samples (Chiu, Shirley & Wang, "Multi-jittered sampling", Graphics Gems IV, 1994).

use super::hash::{hash, mix, shuffled, unit};
use super::strata::Strata;
use super::{Pixel, Sampler, key};

/// One sample in each of m × n cells, and one in each of m·n columns and of m·n rows.
pub struct MultiJittered {
    strata: Strata,
    seed: u64,
}

impl MultiJittered {
    /// As many cells as samples.
    pub fn new(samples: u32, seed: u64) -> Self {
        Self { strata: Strata::new(samples), seed }
    }
}

impl Sampler for MultiJittered {
    /// A cell has as many narrow columns as there are rows of cells; the cells above each other
    /// take one each, in an order of their own. Shuffling all columns alike would make neighbours
    /// err alike: it looks more even, and the error of smooth pictures falls more slowly.
    fn pair(&self, pixel: Pixel, sample: u32, pair: u32) -> [f64; 2] {
        let Strata { columns, rows } = self.strata;
        let key = key(self.seed, pixel, pair);
        let cell = shuffled(sample % self.strata.count(), self.strata.count(), key);
        let (column, row) = (cell % columns, cell / columns);
        let narrow_column = shuffled(row, rows, hash(key, 1, u64::from(column)));
        let narrow_row = shuffled(column, columns, hash(key, 2, u64::from(row)));
        let jitter = mix(key ^ mix(u64::from(cell) + 3));
        let within = |wide: u32, narrow: u32, of: u32, jitter: u32| {
            f64::from(wide) + (f64::from(narrow) + unit(jitter)) / f64::from(of)
        };
        let x = within(column, narrow_column, rows, (jitter >> 32) as u32) / f64::from(columns);
        let y = within(row, narrow_row, columns, jitter as u32) / f64::from(rows);
        [x, y]
    }
}
