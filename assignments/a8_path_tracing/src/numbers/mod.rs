//! A8T2: the numbers that decide a path's ways.
//!
//! A path is a point of a cube of many dimensions: two for the place in the pixel, two for the
//! lens, and at every surface two for the way on, two for the light that is asked, two for the one
//! that is asked over balls, and one for roulette. Only those that are used are worked out.

mod directions;
mod sobol;

pub use sobol::DIMENSIONS;

use a7_sampling::Pattern;
use a7_sampling::sampler::hash::{hash, mix, units};
use a7_sampling::sampler::{Pixel, Sampler};
use common::math::lanes::LANES;
use common::picture::Size;
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
pub struct Numbers {
    /// Chooses among equally good ones.
    seed: u64,
    /// One of the patterns of assignment 7, pair by pair; without one Sobol's sequence in many
    /// dimensions, scrambled for every pixel.
    pairs: Option<Box<dyn Sampler>>,
}

/// What is decided by numbers that are no part of a pattern.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choice {
    /// Which material of a blend.
    Material,
    /// Whether a way over a ball is followed.
    Followed,
    /// Whether lights are asked over a ball, and which of the ways over it.
    Ball(u32),
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
    /// The pixel that they are for.
    #[inline]
    pub fn pixel(&self) -> Pixel {
        self.pixel
    }

    /// Those of a sample so many later in the same pixel.
    #[inline(always)]
    pub fn after(&self, rows: u32) -> Self {
        Self { sample: self.sample + rows, row: self.row + rows, ..*self }
    }

    /// What scrambles a pair of coordinates.
    #[inline(always)]
    fn key_of(&self, pair: u32) -> u64 {
        mix(self.key.wrapping_add(u64::from(pair + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15)))
    }

    /// Two numbers in [0, 1) for a choice at the surface of this generation, which have nothing to
    /// do with any others.
    pub fn beside(&self, generation: u32, choice: Choice) -> [f64; 2] {
        let choice = match choice {
            Choice::Material => 0,
            Choice::Followed => 1,
            Choice::Ball(ball) => 2 + u64::from(ball),
        };
        units(hash(self.key, u64::from(self.sample), u64::from(generation) << 32 | choice))
    }
}

impl Numbers {
    /// The numbers of a pattern, for so many samples in each pixel of a picture of this size.
    pub fn new(pattern: Pattern, samples: u32, size: Size, seed: u64) -> Self {
        let side = size.width().max(size.height());
        let by_pairs = pattern != Pattern::Sobol;
        Self { seed, pairs: by_pairs.then(|| pattern.sampler(samples, side, seed)) }
    }

    /// Works out the points of a range of samples.
    pub fn prepare(&self, samples: Range<u32>, rows: &mut Rows) {
        rows.rows.clear();
        if self.pairs.is_none() {
            rows.rows.extend(samples.map(sobol::point));
        }
    }

    /// The numbers of sample `first` of a pixel, the first of those prepared.
    #[inline]
    pub fn stream(&self, pixel: Pixel, first: u32) -> Stream {
        let key = hash(self.seed, u64::from(pixel.0) << 32 | u64::from(pixel.1), 0);
        Stream { pixel, key, sample: first, row: 0 }
    }

    /// Two coordinates in [0, 1).
    #[inline]
    pub fn pair(&self, stream: &Stream, rows: &Rows, what: Use) -> [f64; 2] {
        let pair = what.pair();
        if let Some(pairs) = &self.pairs {
            return pairs.pair(stream.pixel, stream.sample, pair);
        }
        let key = stream.key_of(pair);
        match sobol::dimension(what) {
            Some(dimension) => {
                let row = &rows.rows[stream.row as usize];
                sobol::scrambled([row[dimension], row[dimension + 1]], key)
            }
            // Far beyond the dimensions that matter.
            None => units(mix(key ^ u64::from(stream.sample).wrapping_mul(0xd6e8_feb8_6659_fd93))),
        }
    }

    /// [`Numbers::pair`] of eight paths, all first coordinates and all second ones.
    #[inline(always)]
    pub fn pairs(&self, streams: &[Stream; LANES], rows: &Rows, what: Use) -> [[f64; LANES]; 2] {
        let Some(dimension) = sobol::dimension(what).filter(|_| self.pairs.is_none()) else {
            let pairs = streams.map(|stream| self.pair(&stream, rows, what));
            return [pairs.map(|[u, _]| u), pairs.map(|[_, v]| v)];
        };
        let (mut keys, mut points) = ([0; LANES], [[0; LANES]; 2]);
        for lane in 0..LANES {
            keys[lane] = streams[lane].key_of(what.pair());
            let row = &rows.rows[streams[lane].row as usize];
            (points[0][lane], points[1][lane]) = (row[dimension], row[dimension + 1]);
        }
        sobol::all_scrambled(points, keys)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a8t2_every_choice_follows_the_seed_whatever_the_pattern() {
        let size = Size::new(8, 8).unwrap();
        for pattern in [Pattern::Sobol, Pattern::Random, Pattern::Halton] {
            let choices = |seed: u64| {
                let stream = Numbers::new(pattern, 4, size, seed).stream((3, 5), 0).after(1);
                [Choice::Material, Choice::Followed, Choice::Ball(0), Choice::Ball(1)]
                    .map(|choice| stream.beside(2, choice)[0])
            };
            let (one, other) = (choices(1), choices(2));
            assert_eq!(one, choices(1));
            let all: Vec<f64> = one.into_iter().chain(other).collect();
            assert!(all.iter().enumerate().all(|(i, x)| !all[..i].contains(x)), "{pattern:?} {all:?}");
        }
    }
}
