//! Sine and cosine of small angles, with the same bits alone and in lanes, on every processor.
//!
//! Mathematical libraries give other last bits on other processors, and one angle at a time. An
//! eighth of a circle needs no reduction: Taylor's series is exact to the last bits there.

use std::ops::{Add, Mul};

/// (−1)ᵏ/(2k + 1)!
const SINE: [f64; 9] = [
    1.0,
    -1.0 / 6.0,
    1.0 / 120.0,
    -1.0 / 5040.0,
    1.0 / 362_880.0,
    -1.0 / 39_916_800.0,
    1.0 / 6_227_020_800.0,
    -1.0 / 1_307_674_368_000.0,
    1.0 / 355_687_428_096_000.0,
];

/// (−1)ᵏ/(2k)!
const COSINE: [f64; 9] = [
    1.0,
    -1.0 / 2.0,
    1.0 / 24.0,
    -1.0 / 720.0,
    1.0 / 40_320.0,
    -1.0 / 3_628_800.0,
    1.0 / 479_001_600.0,
    -1.0 / 87_178_291_200.0,
    1.0 / 20_922_789_888_000.0,
];

/// Terms that double precision wants: the next is below 10⁻¹⁸.
pub const DOUBLE: usize = 9;

/// Terms that single precision wants: the next is below 3·10⁻⁸.
pub const SINGLE: usize = 5;

/// Sine and cosine of an angle of at most π/4, by so many terms. `of` makes a number of the kind
/// that is worked with: one, or as many as stand side by side.
#[inline(always)]
pub fn sine_and_cosine<V>(angle: V, terms: usize, of: impl Fn(f64) -> V) -> (V, V)
where
    V: Copy + Add<Output = V> + Mul<Output = V>,
{
    let squared = angle * angle;
    let (mut sine, mut cosine) = (of(SINE[terms - 1]), of(COSINE[terms - 1]));
    for k in (0..terms - 1).rev() {
        sine = sine * squared + of(SINE[k]);
        cosine = cosine * squared + of(COSINE[k]);
    }
    (sine * angle, cosine)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_4;

    #[test]
    fn series_are_as_good_as_the_library() {
        for i in -1000..=1000 {
            let angle = f64::from(i) / 1000.0 * FRAC_PI_4;
            let (sine, cosine) = sine_and_cosine(angle, DOUBLE, |c| c);
            assert!((sine - angle.sin()).abs() < 3e-16 && (cosine - angle.cos()).abs() < 3e-16, "{angle}");
            let (sine, cosine) = sine_and_cosine(angle as f32, SINGLE, |c| c as f32);
            let off = (f64::from(sine) - angle.sin()).abs().max((f64::from(cosine) - angle.cos()).abs());
            assert!(off < 1.5e-7, "{angle}: {off}");
        }
    }
}
