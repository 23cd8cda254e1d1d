//! Negative numbers as values of flags.

/// If `text` is a negative number as C's `scanf` reads one (`-2`, `-.5`, `-1e-3`), the same number
/// in plain decimals, exactly, which clap does not take for a flag.
pub fn plain_negative(text: &str) -> Option<String> {
    let unsigned = text.strip_prefix('-')?;
    if !unsigned.starts_with(|c: char| c.is_ascii_digit() || c == '.') {
        return None;
    }
    unsigned.parse::<f64>().ok()?;
    let (mantissa, exponent) = unsigned.split_once(['e', 'E']).unwrap_or((unsigned, "0"));
    let exponent: i64 = exponent.parse().ok()?;
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    if exponent == 0 {
        return Some(format!("-{}", joined(whole, fraction)));
    }
    // No number that a flag takes has more decimals; the rest are left for clap to refuse.
    const MOST_DECIMALS: u64 = 400;
    (exponent.unsigned_abs() <= MOST_DECIMALS).then(|| format!("-{}", shifted(whole, fraction, exponent)))
}

fn joined(whole: &str, fraction: &str) -> String {
    let whole = if whole.is_empty() { "0" } else { whole };
    if fraction.is_empty() { whole.to_owned() } else { format!("{whole}.{fraction}") }
}

/// The digits with the point moved right by `exponent` places.
fn shifted(whole: &str, fraction: &str, exponent: i64) -> String {
    let digits = format!("{whole}{fraction}");
    let point = whole.len() as i64 + exponent;
    if point <= 0 {
        let zeros = "0".repeat(point.unsigned_abs() as usize);
        return joined("", &format!("{zeros}{digits}"));
    }
    let point = point as usize;
    let digits = format!("{digits:0<point$}");
    joined(&digits[..point], &digits[point..])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plain_decimals_are_the_same_number() {
        for (text, plain) in [
            ("-2", "-2"),
            ("-0", "-0"),
            ("-14.5", "-14.5"),
            ("-1.", "-1"),
            ("-.5", "-0.5"),
            ("-2e-3", "-0.002"),
            ("-1.25e1", "-12.5"),
            ("-1.25E+3", "-1250"),
            ("-12.5e-1", "-1.25"),
            ("-.5e-1", "-0.05"),
        ] {
            assert_eq!(plain_negative(text).as_deref(), Some(plain), "{text}");
            assert_eq!(plain.parse::<f64>(), text.parse::<f64>());
        }
    }

    #[test]
    fn words_are_not_numbers() {
        for text in ["-", "--", "-size", "-e5", "-inf", "-nan", "-.", "-1e", "-1e999999", "2", "-1x", "-1-1"]
        {
            assert_eq!(plain_negative(text), None, "{text}");
        }
    }
}
