//! Correlated multi-jittered samples (Kensler, "Correlated multi-jittered sampling", 2013).

use super::hash::{mix, shuffled, unit};
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
    /// A cell has as many columns of its own as there are rows of cells. Which of them a sample
    /// takes depends on its row only: that is what makes samples of one row alike, and evenly
    /// spaced.
    fn pair(&self, pixel: Pixel, sample: u32, pair: u32) -> [f64; 2] {
        let Strata { columns, rows } = self.strata;
        let key = key(self.seed, pixel, pair);
        let cell = shuffled(sample % self.strata.count(), self.strata.count(), key);
        let (column, row) = (cell % columns, cell / columns);
        let narrow_column = shuffled(row, rows, mix(key ^ 1));
        let narrow_row = shuffled(column, columns, mix(key ^ 2));
        let jitter = mix(key ^ mix(u64::from(cell) + 3));
        let within = |wide: u32, narrow: u32, of: u32, jitter: u32| {
            f64::from(wide) + (f64::from(narrow) + unit(jitter)) / f64::from(of)
        };
        let x = within(column, narrow_column, rows, (jitter >> 32) as u32) / f64::from(columns);
        let y = within(row, narrow_row, columns, jitter as u32) / f64::from(rows);
        [x, y]
    }
}
