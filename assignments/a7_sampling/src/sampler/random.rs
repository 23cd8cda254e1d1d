//! Independent samples: what every other pattern has to beat.

use super::hash::{mix, units};
use super::{Pixel, Sampler, key};

/// Every coordinate is uniform in [0, 1) and independent of all others.
pub struct Random {
    /// Chooses among equally good sets of samples.
    pub seed: u64,
}

impl Sampler for Random {
    fn pair(&self, pixel: Pixel, sample: u32, pair: u32) -> [f64; 2] {
        units(mix(key(self.seed, pixel, pair).wrapping_add(mix(u64::from(sample) + 1))))
    }
}
