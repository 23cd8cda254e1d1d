//! The exponential function of numbers that are not above 0, for bells.
//!
//! Made of additions and products only, so that it is the same on every machine, and that several
//! of them side by side become vector code; the library's is neither.

use std::f64::consts::LOG2_E;

/// Adding this rounds to an integer, which then stands in the lowest bits.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// ln 2 in two parts: the first short, so that its product with a small integer is exact.
const LN2: [f64; 2] = [f64::from_bits(0x3fe6_2e42_fee0_0000), f64::from_bits(0x3dea_39ef_3579_3c76)];

/// Below this nothing is left of the bell, beside what is near its middle.
const LEAST: f64 = -700.0;

/// 1/k! from k = 13 down to 0.
const TERMS: [f64; 14] = {
    let mut terms = [1.0; 14];
    let (mut k, mut factorial) = (1, 1.0);
    while k < 14 {
        factorial *= k as f64;
        terms[13 - k] = 1.0 / factorial;
        k += 1;
    }
    terms
};

/// eˣ for x ≤ 0, within two units in the last place; 0 below −700, and for NaN.
#[inline(always)]
pub fn bell(x: f64) -> f64 {
    let clamped = if x > LEAST { x } else { LEAST };
    let shifted = clamped * LOG2_E + ROUNDER;
    let whole = shifted - ROUNDER;
    let rest = clamped - whole * LN2[0] - whole * LN2[1];
    let mut sum = TERMS[0];
    for term in &TERMS[1..] {
        sum = sum * rest + term;
    }
    // The integer, moved to where the exponent stands, on top of the exponent of 1.
    let power = f64::from_bits((shifted.to_bits() << 52).wrapping_add(1f64.to_bits()));
    if x > LEAST { sum * power } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a7t2_it_is_the_exponential() {
        for i in 0..=700_000 {
            let x = -f64::from(i) * 0.000_997;
            let (found, expected) = (bell(x), x.exp());
            assert!((found - expected).abs() <= expected * 2.0 * f64::EPSILON, "{x}: {found:e} {expected:e}");
        }
        assert_eq!((bell(0.0), bell(-0.0), bell(-1e300), bell(f64::NEG_INFINITY)), (1.0, 1.0, 0.0, 0.0));
    }
}
