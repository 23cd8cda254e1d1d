//! Halton's sequence with scrambled digits.

use super::hash::{hash, mix, shuffled, unit};
use super::{Pixel, Sampler, key};

/// Pairs that have bases of their own; later ones use them again, scrambled otherwise.
const PAIRS: usize = 16;

/// Each coordinate writes the sample's number in a prime base of its own and reads the digits
/// backwards behind the point (Halton 1960). Digits are permuted depending on those before them
/// (Owen, "Randomly permuted (t,m,s)-nets and (t,s)-sequences", 1995), which takes away the
/// stripes that large bases have, and makes every pixel's samples different.
pub struct Halton {
    bases: [[u32; 2]; PAIRS],
    seed: u64,
}

impl Halton {
    /// The sequence; seeds choose the scrambling.
    pub fn new(seed: u64) -> Self {
        let is_prime = |n: &u32| (2..=n.isqrt()).all(|d| !n.is_multiple_of(d));
        let mut primes = (2..).filter(is_prime);
        let mut next = || primes.next().unwrap_or(2);
        Self { bases: std::array::from_fn(|_| [next(), next()]), seed }
    }
}

impl Sampler for Halton {
    fn pair(&self, pixel: Pixel, sample: u32, pair: u32) -> [f64; 2] {
        let key = key(self.seed, pixel, pair);
        let [a, b] = self.bases[pair as usize % PAIRS];
        [radical_inverse(sample, a, mix(key ^ 1)), radical_inverse(sample, b, mix(key ^ 2))]
    }
}

/// The digits of `index` backwards behind the point, scrambled. Behind its last digit there are
/// only zeros, whose scrambling is a random number.
fn radical_inverse(mut index: u32, base: u32, key: u64) -> f64 {
    let (mut value, mut place, mut before) = (0.0, 1.0, 0u64);
    while index > 0 {
        let digit = shuffled(index % base, base, hash(key, before, u64::from(base)));
        place /= f64::from(base);
        value += f64::from(digit) * place;
        before = before.wrapping_mul(u64::from(base)).wrapping_add(u64::from(index % base) + 1);
        index /= base;
    }
    // The digits before end at the last one that is not zero, so zeros behind differ in length
    // only: they are scrambled one by one until a sequence of 2³² samples would reach them.
    while place > 1.0 / 4_294_967_296.0 {
        let digit = shuffled(0, base, hash(key, before, u64::from(base)));
        place /= f64::from(base);
        value += f64::from(digit) * place;
        before = before.wrapping_mul(u64::from(base)).wrapping_add(1);
    }
    (value + place * unit(hash(key, before, 0) as u32)).min(1.0 - f64::EPSILON)
}
