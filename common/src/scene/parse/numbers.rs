//! Numbers, counts, vectors, colours and names.
//!
//! ```text
//! 1   1.   .5   -2e-3   +3
//! ```
//!
//! The decimal numbers of C's `scanf`, without its hexadecimal ones, infinities and NaNs. They
//! are read to the nearest `f64` and must fit an `f32`; what is too small for it is zero.

use super::Parser;
use super::block::{found, quoted};
use crate::math::{DVec3, Vec3};
use crate::scene::diagnostic::{Fault, Parsed};
use crate::scene::lexer::{Span, Token, TokenKind};

const ORDINALS: [&str; 16] = [
    "first", "second", "third", "4th", "5th", "6th", "7th", "8th", "9th", "10th", "11th", "12th", "13th",
    "14th", "15th", "16th",
];

/// A count or index with its place, for later complaints.
#[derive(Clone, Copy)]
pub(super) struct Count {
    pub value: u32,
    pub span: Span,
}

impl<'a> Parser<'a> {
    /// One number.
    pub(super) fn number(&mut self, field: Token<'a>) -> Parsed<f64> {
        Ok(self.numbers::<1>(field)?[0])
    }

    /// One number as single precision.
    pub(super) fn single(&mut self, field: Token<'a>) -> Parsed<f32> {
        Ok(self.number(field)? as f32)
    }

    /// N numbers in a row.
    pub(super) fn numbers<const N: usize>(&mut self, field: Token<'a>) -> Parsed<[f64; N]> {
        let mut values = [0.0; N];
        for (index, value) in values.iter_mut().enumerate() {
            let token = self.lexer.next();
            *value = decimal(token, &|| wanted("a number", field, index, N))?;
        }
        Ok(values)
    }

    /// A point or direction.
    pub(super) fn vector(&mut self, field: Token<'a>) -> Parsed<DVec3> {
        Ok(DVec3::from_array(self.numbers(field)?))
    }

    /// A linear RGB colour; any finite numbers, as the course has lights that take light away.
    pub(super) fn color(&mut self, field: Token<'a>) -> Parsed<Vec3> {
        Ok(self.vector(field)?.as_vec3())
    }

    /// A vector that has a direction.
    pub(super) fn direction(&mut self, field: Token<'a>) -> Parsed<DVec3> {
        let vector = self.vector(field)?;
        if vector.as_vec3() == Vec3::ZERO {
            return Fault::new(field.span, format!("`{}` must not be the zero vector", field.text)).fail();
        }
        Ok(vector)
    }

    /// A number above zero (in single precision too).
    pub(super) fn positive(&mut self, field: Token<'a>) -> Parsed<f64> {
        self.bounded(field, "above zero", |value| value as f32 > 0.0)
    }

    /// A number that is not negative.
    pub(super) fn not_negative(&mut self, field: Token<'a>) -> Parsed<f64> {
        self.bounded(field, "zero or more", |value| value >= 0.0)
    }

    /// A number for which `accept` holds; `range` says in words for which it does.
    pub(super) fn bounded(
        &mut self,
        field: Token<'a>,
        range: &str,
        accept: impl Fn(f64) -> bool,
    ) -> Parsed<f64> {
        let token = self.lexer.next();
        let value = decimal(token, &|| wanted("a number", field, 0, 1))?;
        if accept(value) {
            return Ok(value);
        }
        let message = format!("`{}` must be {range}, found {}", field.text, found(token));
        Fault::new(token.span, message).fail()
    }

    /// A whole number from 0 up.
    pub(super) fn count(&mut self, field: Token<'a>) -> Parsed<Count> {
        let token = self.lexer.next();
        let fault = |message| Box::new(Fault::new(token.span, message));
        let wanted = || wanted("a whole number", field, 0, 1);
        if token.kind != TokenKind::Word || !is_integer(token.text) {
            return Err(fault(format!("expected {}, found {}", wanted(), found(token))));
        }
        if token.text.starts_with('-') && token.text.bytes().any(|b| matches!(b, b'1'..=b'9')) {
            let message = format!("`{}` must not be negative, found {}", field.text, found(token));
            return Err(fault(message));
        }
        let digits = token.text.trim_start_matches(['+', '-']);
        let value = digits
            .parse()
            .map_err(|_| fault(format!("{} is too large for `{}`", quoted(token.text), field.text)))?;
        Ok(Count { value, span: token.span })
    }

    /// A file name, as written.
    pub(super) fn name(&mut self, field: Token<'a>) -> Parsed<Token<'a>> {
        let token = self
            .lexer
            .name()
            .map_err(|open| Fault::new(open.span, "this quoted file name is not closed on its line"))?;
        if token.kind == TokenKind::Word && !token.text.is_empty() {
            return Ok(token);
        }
        let message = format!("expected a file name for `{}`, found {}", field.text, found(token));
        Fault::new(token.span, message).fail()
    }
}

/// "a number for `radius`", "a number for `center` (second of 3)".
fn wanted(what: &str, field: Token, index: usize, of: usize) -> String {
    let which = match of {
        1 => String::new(),
        _ => format!(" ({} of {of})", ORDINALS[index]),
    };
    format!("{what} for `{}`{which}", field.text)
}

fn decimal(token: Token, wanted: &dyn Fn() -> String) -> Parsed<f64> {
    if token.kind != TokenKind::Word || !is_decimal(token.text) {
        let message = format!("expected {}, found {}", wanted(), found(token));
        let fault = Fault::new(token.span, message);
        return fault.help_if_any(number_hint(token.text)).fail();
    }
    let value: f64 = token.text.parse().unwrap_or(f64::INFINITY);
    if (value as f32).is_finite() {
        return Ok(value);
    }
    let message = format!("{} is too large for a 32-bit float", quoted(token.text));
    Fault::new(token.span, message).fail()
}

fn number_hint(text: &str) -> Option<String> {
    let lower = text.trim_start_matches(['+', '-']).to_ascii_lowercase();
    if lower.starts_with("nan") || lower.starts_with("inf") {
        return Some("numbers must be finite".to_owned());
    }
    if lower.starts_with("0x") {
        return Some("numbers are decimal".to_owned());
    }
    let (head, _) = text.split_once(',')?;
    is_decimal(head).then(|| "numbers are separated by blanks, not by commas".to_owned())
}

/// `[+-] (digits [. digits*] | . digits) [(e|E) [+-] digits]`
fn is_decimal(text: &str) -> bool {
    let (mantissa, exponent) = match text.find(['e', 'E']) {
        Some(index) => (&text[..index], Some(&text[index + 1..])),
        None => (text, None),
    };
    let unsigned = mantissa.strip_prefix(['+', '-']).unwrap_or(mantissa);
    let (whole, fraction) = unsigned.split_once('.').unwrap_or((unsigned, ""));
    let has_digits = !(whole.is_empty() && fraction.is_empty());
    has_digits && all_digits(whole) && all_digits(fraction) && exponent.is_none_or(is_integer)
}

fn is_integer(text: &str) -> bool {
    let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
    !digits.is_empty() && all_digits(digits)
}

fn all_digits(text: &str) -> bool {
    text.bytes().all(|byte| byte.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::{is_decimal, is_integer};

    #[test]
    fn decimals_are_those_of_scanf() {
        for good in ["1", "1.", ".5", "-2e-3", "+3", "0", "-.5E+10", "00.10"] {
            assert!(is_decimal(good), "{good}");
            assert!(good.parse::<f64>().is_ok(), "{good}");
        }
        for bad in [
            "", ".", "+", "-", "e5", "1e", "1e+", "1.2.3", "--1", "nan", "inf", "0x10", "1f", "1,0", "1e1.5",
            "infinity", "1_000", "+-1", ".e1",
        ] {
            assert!(!is_decimal(bad), "{bad}");
        }
    }

    #[test]
    fn integers_have_a_sign_and_digits() {
        assert!(is_integer("+12") && is_integer("-0") && is_integer("007"));
        assert!(!is_integer("") && !is_integer("1.0") && !is_integer("1e3") && !is_integer("-"));
    }
}
