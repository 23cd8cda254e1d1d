//! Fixed-point numbers: their sums are exact, so the order of adding cannot matter.

use common::math::Vec3A;

/// Bits behind the point. What is cut off a sample, less than 2⁻⁶⁴, is the same wherever the
/// sample is added.
pub const FRACTION_BITS: u32 = 64;

/// Largest magnitude of a sample; what is beyond is taken for it. 2³¹ samples of this size, which
/// are the most there can be, add up to less than an `i128` holds.
pub const LIMIT: f32 = 2_147_483_648.0;

/// 1 as a fixed-point number.
const ONE: f64 = (1u128 << FRACTION_BITS) as f64;

/// A sample as a fixed-point number; `None` for NaN and infinities.
#[inline]
pub fn from_f32(sample: f32) -> Option<i128> {
    sample.is_finite().then(|| from_finite(sample))
}

/// A finite sample as a fixed-point number; what comes of others means nothing.
#[inline]
pub fn from_finite(sample: f32) -> i128 {
    // Done with bits, without a branch: three of these stand behind every path. LIMIT has the
    // exponent 158 and would be shifted by nothing; smaller numbers are by what they are smaller.
    let bits = sample.clamp(-LIMIT, LIMIT).to_bits();
    let exponent = (bits >> 23) & 0xff;
    // Numbers below the normal ones get a leading bit too many; it is shifted out all the same.
    let digits = u128::from(bits & 0x7f_ffff | 0x80_0000) << (FRACTION_BITS + 31 - 23);
    let magnitude = (digits >> (158 - exponent).min(127)) as i128;
    let sign = -i128::from(bits >> 31);
    (magnitude ^ sign) - sign
}

/// Magnitudes that [`Batch`] takes, beside 0: their bits lie above the last of [`FRACTION_BITS`].
const SMALLEST: Vec3A = Vec3A::splat(1.0 / (1u64 << 40) as f32);
const LARGEST: Vec3A = Vec3A::splat(512.0);

/// Most samples of a batch.
pub const MOST: usize = 1024;

/// What 2⁻³² is the last bit of.
const SHIFT: f64 = 1.5 * (1 << 20) as f64;

/// The sums of three channels over at most [`MOST`] samples that are neither very large nor very
/// small, as exact as those of fixed-point numbers: of each sample the bits up to 2⁻³² go into one
/// sum and the others into another, and 53 bits are enough for either.
#[derive(Default)]
pub struct Batch {
    high: [f64; 3],
    low: [f64; 3],
}

impl Batch {
    /// Adds a sample; false, and nothing is done, if it is no sample for a batch.
    #[inline]
    pub fn add(&mut self, sample: [f32; 3]) -> bool {
        let size = Vec3A::from(sample).abs();
        let fits = size.cmplt(LARGEST) & (size.cmpge(SMALLEST) | size.cmpeq(Vec3A::ZERO));
        if !fits.all() {
            return false;
        }
        for (channel, x) in sample.iter().enumerate() {
            let x = f64::from(*x);
            let high = (x + SHIFT) - SHIFT;
            self.high[channel] += high;
            self.low[channel] += x - high;
        }
        true
    }

    /// The sums as fixed-point numbers.
    pub fn sums(&self) -> [i128; 3] {
        let whole = |x: f64, bits: i32| i128::from((x * 2f64.powi(bits)) as i64);
        std::array::from_fn(|channel| {
            (whole(self.high[channel], 32) << (FRACTION_BITS - 32)) + whole(self.low[channel], 64)
        })
    }
}

/// The mean of `count` samples with this sum; 0 if there are none.
#[inline]
pub fn mean(sum: i128, count: u32) -> f64 {
    if count == 0 { 0.0 } else { sum as f64 / (f64::from(count) * ONE) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finite_samples_survive_and_the_rest_is_told_apart() {
        for x in [0.0, 1.0, -1.0, 0.1, 1e-6, 3.4567e5, LIMIT, -LIMIT, 2.0f32.powi(-40)] {
            assert_eq!(mean(from_f32(x).unwrap(), 1) as f32, x);
        }
        assert_eq!(from_f32(f32::MAX), from_f32(LIMIT));
        assert_eq!(from_f32(f32::MIN), from_f32(-LIMIT));
        assert_eq!(from_f32(f32::MIN_POSITIVE), Some(0));
        for x in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            assert_eq!(from_f32(x), None);
        }
        assert_eq!(mean(7, 0), 0.0);
    }

    #[test]
    fn bits_are_those_of_the_product() {
        let words = (0..200_000u32).map(|i| f32::from_bits(i.wrapping_mul(2_654_435_761)));
        for x in words.chain([0.0, -0.0, LIMIT, 1.9999999, f32::MIN_POSITIVE]).filter(|x| x.is_finite()) {
            // The product only changes the exponent: what rounds is the conversion, towards zero.
            let expected = (f64::from(x.clamp(-LIMIT, LIMIT)) * ONE) as i128;
            assert_eq!(from_f32(x), Some(expected), "{x}");
        }
    }

    #[test]
    fn batches_are_as_exact_as_sums_of_fixed_point_numbers() {
        let mut word = 1u32;
        for round in 0..200 {
            let (mut batch, mut expected, mut taken) = (Batch::default(), [0; 3], 0);
            for _ in 0..MOST {
                let sample: [f32; 3] = std::array::from_fn(|_| {
                    word = word.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                    // From far too small to a little too large, and the largest in some rounds.
                    let x = f32::from_bits((word >> 1) % (12 << 23) + ((125 - round % 3 * 40) << 23));
                    if round % 5 == 0 { LARGEST.x.next_down() } else { x * [1.0, -1.0][word as usize >> 31] }
                });
                let exact = sample.map(from_finite);
                if batch.add(sample) {
                    taken += 1;
                    (0..3).for_each(|i| expected[i] += exact[i]);
                }
            }
            assert_eq!(batch.sums(), expected);
            assert!(taken > 0 || round % 3 == 2, "{round}");
        }
        for x in [f32::NAN, f32::INFINITY, LARGEST.x, SMALLEST.x.next_down()] {
            assert!(!Batch::default().add([0.0, x, 0.0]), "{x}");
        }
    }

    #[test]
    fn the_most_and_largest_samples_do_not_overflow() {
        let largest = from_f32(LIMIT).unwrap();
        assert!(largest.checked_mul(i128::from(super::super::MAX_SAMPLES)).is_some());
    }
}
