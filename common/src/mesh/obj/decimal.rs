//! Reading decimal numbers as `f32`, to the nearest, fast.
//!
//! Numbers of a mesh file have few digits. Up to 2⁵³ and 10²² both the digits and the power of
//! ten are exact in `f64`, so that one multiplication or division gives the nearest `f64`
//! (Clinger, "How to Read Floating Point Numbers Accurately", 1990). Rounding that again to
//! `f32` could go wrong only if it lies just half way between two `f32`s. Such numbers, and all
//! unusual ones, are left to the standard library.

/// The powers of ten that `f64` holds exactly.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18,
    1e19, 1e20, 1e21, 1e22,
];

/// Reads a decimal number from the front of `bytes` and gives it with the number of bytes used;
/// `None` if there is no number or it needs the slow way. What follows is the caller's business.
#[inline]
pub(super) fn fast_f32(bytes: &[u8]) -> Option<(f32, usize)> {
    let negative = bytes.first() == Some(&b'-');
    let mut at = usize::from(negative || bytes.first() == Some(&b'+'));
    let first_digit = at;
    let mut mantissa = 0;
    at = digits(bytes, at, &mut mantissa);
    let mut used = at - first_digit;
    let mut exponent = 0;
    if bytes.get(at) == Some(&b'.') {
        let point = at + 1;
        at = digits(bytes, point, &mut mantissa);
        used += at - point;
        exponent -= (at - point) as i32;
    }
    // 19 digits cannot have overflowed the 64 bits of the mantissa.
    if used == 0 || used > 19 {
        return None;
    }
    if matches!(bytes.get(at), Some(b'e' | b'E')) {
        let (value, end) = small_exponent(bytes, at + 1)?;
        exponent += value;
        at = end;
    }
    let magnitude = nearest_f32(mantissa, exponent)?;
    Some((if negative { -magnitude } else { magnitude }, at))
}

/// Appends the digits from `at` on to `value` (wrapping) and gives the offset behind them.
#[inline]
fn digits(bytes: &[u8], mut at: usize, value: &mut u64) -> usize {
    while let Some(digit) = bytes.get(at).map(|b| b.wrapping_sub(b'0')).filter(|d| *d < 10) {
        *value = value.wrapping_mul(10).wrapping_add(u64::from(digit));
        at += 1;
    }
    at
}

/// A signed exponent of at most three digits.
fn small_exponent(bytes: &[u8], start: usize) -> Option<(i32, usize)> {
    let signed = matches!(bytes.get(start), Some(b'+' | b'-'));
    let first_digit = start + usize::from(signed);
    let mut value = 0;
    let end = digits(bytes, first_digit, &mut value);
    let in_range = (1..=3).contains(&(end - first_digit));
    let sign = if bytes.get(start) == Some(&b'-') { -1 } else { 1 };
    in_range.then_some((sign * value as i32, end))
}

/// The `f32` nearest to mantissa · 10^exponent, if that is certain.
#[inline]
fn nearest_f32(mantissa: u64, exponent: i32) -> Option<f32> {
    let power = POWERS.get(exponent.unsigned_abs() as usize)?;
    if mantissa > 1 << 53 {
        return None;
    }
    let value = match exponent < 0 {
        true => mantissa as f64 / power,
        false => mantissa as f64 * power,
    };
    let in_normal_range = value == 0.0 || (f64::from(f32::MIN_POSITIVE)..=1e38).contains(&value);
    (in_normal_range && !is_half_way(value)).then_some(value as f32)
}

/// Is the value just between two neighbouring `f32`s? Its low 29 bits are those `f32` lacks.
#[inline]
fn is_half_way(value: f64) -> bool {
    value.to_bits() & 0x1fff_ffff == 0x1000_0000
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Where the fast way gives an answer, it is the standard library's to the last bit.
    fn agrees(text: &str) -> bool {
        match fast_f32(text.as_bytes()) {
            None => true,
            Some((value, used)) => {
                used == text.len() && value.to_bits() == text.parse::<f32>().unwrap().to_bits()
            }
        }
    }

    #[test]
    fn takes_the_usual_numbers() {
        for text in ["0", "-0", "1.", ".5", "+3", "-2e-3", "0.123456", "12345678", "1E+2", "-0.0"] {
            assert!(fast_f32(text.as_bytes()).is_some(), "{text}");
            assert!(agrees(text), "{text}");
        }
    }

    #[test]
    fn leaves_the_doubtful_to_the_standard_library() {
        // 2²⁴ + 1 is half way between two f32s; so is the second, up to its 18th digit.
        for text in ["16777217", "1.000000059604644775", "1e-40", "1e39", "123456789012345678901"] {
            assert_eq!(fast_f32(text.as_bytes()), None, "{text}");
        }
        for text in ["", "-", ".", "e5", "1e", "1e+", "nan", "inf", "1e1000"] {
            assert_eq!(fast_f32(text.as_bytes()), None, "{text}");
        }
    }

    #[test]
    fn stops_behind_the_number() {
        assert_eq!(fast_f32(b"1.5 2.5"), Some((1.5, 3)));
        assert_eq!(fast_f32(b"1.5x"), Some((1.5, 3)));
    }

    proptest! {
        #[test]
        fn agrees_on_decimals(text in r"[+-]?[0-9]{1,10}(\.[0-9]{0,10})?([eE][+-]?[0-9]{1,2})?") {
            prop_assert!(agrees(&text), "{}", text);
        }

        #[test]
        fn agrees_on_printed_floats(bits: u32) {
            let value = f32::from_bits(bits);
            prop_assume!(value.is_finite());
            for text in [format!("{value}"), format!("{value:e}"), format!("{:.9}", value % 1e3)] {
                prop_assert!(agrees(&text), "{}", text);
            }
        }

        /// The hardest decimals: half way between two f32s, and a last digit beside it.
        #[test]
        fn agrees_beside_half_way(low in 0x80_0000_u32..0x100_0000, nudge in -2_i64..=2, digits in 0_u32..5) {
            let twice = 2 * u64::from(low) + 1;
            let scaled = twice * 5 * 10_u64.pow(digits);
            let near = scaled.wrapping_add_signed(nudge).to_string();
            let (whole, fraction) = near.split_at(near.len() - digits as usize - 1);
            let text = format!("{whole}.{fraction}");
            prop_assert!(agrees(&text), "{}", text);
        }
    }
}
