//! A sine whose bits are the same on every machine, which those of `f64::sin` are not.

/// Added and taken away again, it rounds to the nearest integer: beyond 2⁵² there is nothing
/// between integers. Not every processor can do that in one step, and this way all do the same.
const TO_INTEGER: f64 = 1.5 * (1u64 << 52) as f64;

/// sin(2πx): the angle is counted in turns. Absolute error below 10⁻⁹ for |x| < 10⁶.
///
/// The angle is reduced to a quarter turn either side of zero, exactly, then the sine's Taylor
/// series is summed up to the eleventh power.
#[inline]
pub fn sine(x: f64) -> f64 {
    let turn = x - ((x + TO_INTEGER) - TO_INTEGER);
    // Sines of a and of half a turn minus a are the same.
    let past = turn.abs();
    let quarter = past.min(0.5 - past).copysign(turn);
    let a = quarter * (2.0 * std::f64::consts::PI);
    let s = a * a;
    let tail = 1.0 / 362_880.0 - s * (1.0 / 39_916_800.0 - s * (1.0 / 6_227_020_800.0));
    a * (1.0 - s * (1.0 / 6.0 - s * (1.0 / 120.0 - s * (1.0 / 5040.0 - s * tail))))
}

/// cos(2πx); see [`sine`].
#[inline]
pub fn cosine(x: f64) -> f64 {
    sine(x + 0.25)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn agrees_with_the_library_over_many_turns() {
        for i in -5000..5000 {
            let x = f64::from(i) * 0.00173 + 0.00001;
            assert!((sine(x) - (2.0 * PI * x).sin()).abs() < 1e-9, "{x}");
            assert!((cosine(x) - (2.0 * PI * x).cos()).abs() < 1e-9, "{x}");
        }
        assert_eq!((sine(0.0), sine(3.0), cosine(0.25)), (0.0, 0.0, 0.0));
    }
}
