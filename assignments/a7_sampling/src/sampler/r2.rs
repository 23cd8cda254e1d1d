//! Steps by powers of the plastic number.

use super::hash::{mix, shuffled, units};
use super::{Pixel, Sampler, key, pair};

/// The number ρ with ρ³ = ρ + 1; what the golden ratio is in one dimension it is in two.
const PLASTIC: f64 = 1.324_717_957_244_746;

/// Sample i is at (i/ρ, i/ρ²) modulo 1 (Roberts, "The unreasonable effectiveness of quasirandom
/// sequences", 2018), moved in each pixel by an offset of its own (Cranley & Patterson 1976).
pub struct R2 {
    /// Samples per pixel: in all pairs but the first they are taken in another order.
    pub samples: u32,
    /// Chooses the offsets.
    pub seed: u64,
}

impl Sampler for R2 {
    fn pair(&self, pixel: Pixel, sample: u32, pair: u32) -> [f64; 2] {
        let key = key(self.seed, pixel, pair);
        let order = match pair {
            pair::PIXEL => sample,
            _ if sample < self.samples => shuffled(sample, self.samples, mix(key)),
            _ => sample,
        };
        let [u, v] = units(key);
        let i = f64::from(order);
        [(u + i / PLASTIC).fract(), (v + i / (PLASTIC * PLASTIC)).fract()]
    }
}
