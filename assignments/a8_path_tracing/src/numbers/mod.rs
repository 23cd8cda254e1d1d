//! A8T2: the numbers that decide a path's ways.
//!
//! A path is a point of a cube of many dimensions: two for the place in the pixel, two for the
//! lens, and at every surface two for the way on, two for the light that is asked, and one for
//! roulette. Only those that are used are worked out.

mod directions;
mod sobol;

pub use sobol::DIMENSIONS;

use a7_sampling::Pattern;
use a7_sampling::sampler::hash::{hash, mix, units};
use a7_sampling::sampler::{Pixel, Sampler};
use std::ops::Range;

/// What a pair of coordinates is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Use {
    /// The place in the pixel.
    Pixel,
    /// The place on the lens.
    Lens,
    /// The way on from the surface of this generation.
    Way(u32),
    /// The light that it asks.
    Light(u32),
    /// The light that it asks over balls.
    Caustic(u32),
    /// Whether the path ends there; only the first coordinate is used.
    Roulette(u32),
}

impl Use {
    /// The number of the pair for patterns that count pairs.
    fn pair(self) -> u32 {
        match self {
            Self::Pixel => 0,
            Self::Lens => 1,
            Self::Way(generation) => 2 + 4 * generation,
            Self::Light(generation) => 3 + 4 * generation,
            Self::Caustic(generation) => 4 + 4 * generation,
            Self::Roulette(generation) => 5 + 4 * generation,
        }
    }
}

/// Where a path's numbers come from.
pub enum Numbers {
    /// Sobol's sequence in many dimensions, scrambled for every pixel.
    Sobol {
        /// Chooses the scrambling.
        seed: u64,
    },
    /// One of the patterns of assignment 7, pair by pair.
    Pairs(Box<dyn Sampler>),
}

/// The points of a range of samples before they are scrambled, which all pixels share.
#[derive(Default)]
pub struct Rows {
    rows: Vec<[u32; DIMENSIONS]>,
}

/// The numbers of one path.
#[derive(Clone, Copy, Debug)]
pub struct Stream {
    pixel: Pixel,
    key: u64,
    sample: u32,
    row: u32,
}

impl Stream {
    /// Two numbers in [0, 1) of the same kind, for one of many things.
    pub fn beside(&self, generation: u32, thing: u32) -> [f64; 2] {
        let which = u64::from(generation) << 32 | u64::from(thing);
        units(hash(
            self.key ^ u64::from(self.sample),
            which,
            u64::from(self.pixel.0) << 32 | u64::from(self.pixel.1),
        ))
    }

    /// A number in [0, 1) for this sample and generation that has nothing to do with others.
    pub fn by_itself(&self, generation: u32) -> f64 {
        let pixel = u64::from(self.pixel.0) << 32 | u64::from(self.pixel.1);
        let which = u64::from(self.sample) << 32 | u64::from(generation);
        units(hash(self.key.wrapping_add(1), pixel, which))[0]
    }
}

impl Numbers {
    /// The numbers of a pattern, for so many samples in each pixel of a picture whose sides have
    /// at most `side` pixels.
    pub fn new(pattern: Pattern, samples: u32, side: u32, seed: u64) -> Self {
        match pattern {
            Pattern::Sobol => Self::Sobol { seed },
            _ => Self::Pairs(pattern.sampler(samples, side, seed)),
        }
    }

    /// Works out the points of a range of samples.
    pub fn prepare(&self, samples: Range<u32>, rows: &mut Rows) {
        rows.rows.clear();
        if let Self::Sobol { .. } = self {
            rows.rows.extend(samples.map(sobol::point));
        }
    }

    /// The numbers of sample `first + row` of a pixel, `first` being the first of those prepared.
    #[inline]
    pub fn stream(&self, pixel: Pixel, first: u32, row: u32) -> Stream {
        let key = match self {
            Self::Sobol { seed } => hash(*seed, u64::from(pixel.0) << 32 | u64::from(pixel.1), 0),
            Self::Pairs(_) => 0,
        };
        Stream { pixel, key, sample: first + row, row }
    }

    /// Two coordinates in [0, 1).
    #[inline]
    pub fn pair(&self, stream: &Stream, rows: &Rows, what: Use) -> [f64; 2] {
        let Self::Sobol { .. } = self else { return self.other(stream, what) };
        let pair = what.pair();
        let key = mix(stream.key.wrapping_add(u64::from(pair + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15)));
        match sobol::dimension(what) {
            Some(dimension) => {
                let row = &rows.rows[stream.row as usize];
                sobol::scrambled([row[dimension], row[dimension + 1]], key)
            }
            // Far beyond the dimensions that matter.
            None => units(mix(key ^ u64::from(stream.sample).wrapping_mul(0xd6e8_feb8_6659_fd93))),
        }
    }

    #[cold]
    fn other(&self, stream: &Stream, what: Use) -> [f64; 2] {
        match self {
            Self::Pairs(sampler) => sampler.pair(stream.pixel, stream.sample, what.pair()),
            Self::Sobol { .. } => unreachable!("asked for other patterns only"),
        }
    }
}
