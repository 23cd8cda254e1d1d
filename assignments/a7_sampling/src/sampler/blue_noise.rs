//! Samples whose errors neighbouring pixels do not share.

use super::hash::{hash, shuffled, unit};
use super::sobol::{owen, sobol};
use super::{Pixel, Sampler};

/// One sequence for the whole picture, dealt out along a curve that keeps neighbours together, so
/// that a block of pixels has evenly spread samples as a pixel has; where one pixel is too bright
/// its neighbours are too dark, and the eye averages the rest away. The order in which the four
/// quarters of each block are visited is random (Ahmed & Wonka, "Screen-space blue-noise diffusion
/// of Monte Carlo sampling error via hierarchical ordering of pixels", 2020).
pub struct BlueNoise {
    /// Bits of a sample's number within its pixel.
    sample_bits: u32,
    /// Bits of a column's or row's number.
    side_bits: u32,
    seed: u64,
}

impl BlueNoise {
    /// For so many samples per pixel, and pictures whose sides have at most `side` pixels.
    pub fn new(samples: u32, side: u32, seed: u64) -> Self {
        let bits = |n: u32| n.max(1).next_power_of_two().trailing_zeros();
        Self { sample_bits: bits(samples), side_bits: bits(side), seed }
    }

    /// The place of a sample in the sequence: digits in base 4, the picture's largest quarters
    /// first, each permuted depending on those before it. An odd bit of the samples comes last.
    fn index(&self, (x, y): Pixel, sample: u32, key: u64) -> u64 {
        let curve = interleave(x) | interleave(y) << 1;
        let within = u64::from(sample) & ((1 << self.sample_bits) - 1);
        let plain = curve << self.sample_bits | within;
        let bits = 2 * self.side_bits + self.sample_bits;
        let (mut index, mut left) = (0, bits);
        while left >= 2 {
            left -= 2;
            let digit = (plain >> left & 3) as u32;
            let before = plain >> left >> 2;
            index = index << 2 | u64::from(shuffled(digit, 4, hash(key, before, u64::from(left))));
        }
        if left == 1 {
            index = index << 1 | (plain & 1) ^ (hash(key, plain >> 1, 0) & 1);
        }
        index
    }
}

impl Sampler for BlueNoise {
    fn pair(&self, pixel: Pixel, sample: u32, pair: u32) -> [f64; 2] {
        let key = hash(self.seed, u64::from(pair), 0x6e6f_6973);
        let [a, b] = sobol(self.index(pixel, sample, key));
        [unit(owen(a, key as u32)), unit(owen(b, (key >> 32) as u32))]
    }
}

/// Bit i of a number goes to bit 2i.
fn interleave(x: u32) -> u64 {
    let mut spread = u64::from(x);
    for (by, mask) in [
        (16, 0x0000_ffff_0000_ffff),
        (8, 0x00ff_00ff_00ff_00ff),
        (4, 0x0f0f_0f0f_0f0f_0f0f),
        (2, 0x3333_3333_3333_3333),
        (1, 0x5555_5555_5555_5555),
    ] {
        spread = (spread | spread << by) & mask;
    }
    spread
}
