//! A7T1: where the samples of a pixel lie.
//!
//! A sample needs a place in its pixel, and perhaps one on the lens and one on each light it is
//! shown: a point of a cube of many dimensions. A [`Sampler`] hands these out two at a time.
//! What it hands out depends on pixel, sample and pair only.

mod blue_noise;
mod halton;
pub mod hash;
mod multi_jittered;
mod r2;
mod random;
pub mod sobol;
mod strata;

pub use blue_noise::BlueNoise;
pub use halton::Halton;
pub use multi_jittered::MultiJittered;
pub use r2::R2;
pub use random::Random;
pub use sobol::Sobol;
pub use strata::{Jittered, Uniform};

use std::ops::Range;

/// Pairs of coordinates by what they are for.
pub mod pair {
    /// The place in the pixel, from its lower left corner.
    pub const PIXEL: u32 = 0;
    /// The place on the lens.
    pub const LENS: u32 = 1;
    /// The first of the places on lights.
    pub const LIGHT: u32 = 2;
}

/// Column and row of a pixel, from the lower left corner.
pub type Pixel = (u32, u32);

/// A way to choose samples.
pub trait Sampler: Send + Sync {
    /// The coordinates, both in [0, 1), of one sample of a pixel. Every `pair` is a pattern of
    /// its own, with no likeness to that of another.
    fn pair(&self, pixel: Pixel, sample: u32, pair: u32) -> [f64; 2];

    /// Appends the coordinates of several samples of a pixel, in order.
    fn pairs(&self, pixel: Pixel, samples: Range<u32>, pair: u32, all: &mut Vec<[f64; 2]>) {
        all.extend(samples.map(|sample| self.pair(pixel, sample, pair)));
    }
}

/// The ways to choose samples.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
#[value(rename_all = "snake_case")]
pub enum Pattern {
    /// Each sample for itself
    Random,
    /// The centres of a grid's cells; N should be a square
    Uniform,
    /// A random point in each cell of a grid; N should be a square
    Jittered,
    /// Jittered so that every row and column of a finer grid has one sample too
    MultiJittered,
    /// Halton's sequence, its digits scrambled
    Halton,
    /// Steps by the plastic number
    R2,
    /// Sobol's sequence, scrambled after Owen
    #[default]
    Sobol,
    /// Sobol's sequence dealt out so that neighbouring pixels err in opposite ways
    BlueNoise,
}

impl Pattern {
    /// The pattern for so many samples in each pixel of a picture whose sides have at most `side`
    /// pixels. Different seeds choose different samples, where there is a choice.
    pub fn sampler(self, samples: u32, side: u32, seed: u64) -> Box<dyn Sampler> {
        match self {
            Self::Random => Box::new(Random { seed }),
            Self::Uniform => Box::new(Uniform::new(samples, seed)),
            Self::Jittered => Box::new(Jittered::new(samples, seed)),
            Self::MultiJittered => Box::new(MultiJittered::new(samples, seed)),
            Self::Halton => Box::new(Halton::new(seed)),
            Self::R2 => Box::new(R2 { samples, seed }),
            Self::Sobol => Box::new(Sobol { seed }),
            Self::BlueNoise => Box::new(BlueNoise::new(samples, side, seed)),
        }
    }

    /// Whether its first samples are good ones however many follow.
    pub fn is_sequence(self) -> bool {
        matches!(self, Self::Random | Self::Halton | Self::R2 | Self::Sobol)
    }
}

/// What a pattern of one pixel and pair is shuffled by.
#[inline]
fn key(seed: u64, (x, y): Pixel, pair: u32) -> u64 {
    hash::hash(seed, u64::from(x) << 32 | u64::from(y), u64::from(pair))
}

#[cfg(test)]
mod tests;
