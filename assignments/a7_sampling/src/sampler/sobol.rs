//! Sobol's sequence, scrambled after Owen.

use super::hash::{mix, unit};
use super::{Pixel, Sampler, key};

/// The first two dimensions of Sobol's sequence: any 2ᵏ consecutive samples have exactly one in
/// each cell of every grid of 2ⁱ × 2ᵏ⁻ⁱ cells. Owen's scrambling keeps that and makes every set
/// of samples as good as random on average, and better where the picture is smooth. Each pair of
/// coordinates takes the samples in an order of its own (Burley, "Practical hash-based Owen
/// scrambling", 2020).
pub struct Sobol {
    /// Chooses the scrambling.
    pub seed: u64,
}

impl Sampler for Sobol {
    #[inline]
    fn pair(&self, pixel: Pixel, sample: u32, pair: u32) -> [f64; 2] {
        scrambled(sample, key(self.seed, pixel, pair))
    }
}

/// The point with the number `sample` in one scrambled and shuffled copy of the sequence.
#[inline]
fn scrambled(sample: u32, key: u64) -> [f64; 2] {
    let other = mix(key);
    let index = u64::from(owen(sample, key as u32));
    let [x, y] = sobol(index);
    [unit(owen(x, (key >> 32) as u32)), unit(owen(y, other as u32))]
}

/// Point `index` of the sequence, each coordinate as 32 bits behind the point.
#[inline]
pub fn sobol(index: u64) -> [u32; 2] {
    [(index.reverse_bits() >> 32) as u32, pascal(index)]
}

/// The second dimension: the generating matrix is Pascal's triangle modulo 2.
#[inline]
fn pascal(mut index: u64) -> u32 {
    let (mut column, mut value) = (1u64 << 63, 0u64);
    while index != 0 {
        if index & 1 == 1 {
            value ^= column;
        }
        column ^= column >> 1;
        index >>= 1;
    }
    (value >> 32) as u32
}

/// Flips each bit depending on those above it and on the key: a random element of Owen's
/// scramblings in base 2.
#[inline]
pub fn owen(bits: u32, key: u32) -> u32 {
    owen_reversed(bits.reverse_bits(), key).reverse_bits()
}

/// The same for bits in the opposite order, where each is flipped depending on those below. The
/// steps let information flow from low to high bits only (Laine & Karras, "Stratified sampling for
/// stochastic transparency", 2011, with the constants that Vegdahl found to mix well, 2021).
#[inline]
pub fn owen_reversed(mut x: u32, key: u32) -> u32 {
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(key);
    x = x.wrapping_mul((key >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^ x.wrapping_mul(0x53a2_2864)
}
