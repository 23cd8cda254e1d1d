//! Numbers of 106 bits as unevaluated sums of two doubles, to judge double precision by.
//!
//! Error-free sums and products after Knuth and Dekker; the operations on pairs are the sloppy
//! ones of Hida, Li & Bailey, "Library for Double-Double and Quad-Double Arithmetic" (2000),
//! whose relative error is a few 2⁻¹⁰⁴ where summands do not cancel.

use std::ops::{Add, Div, Mul, Sub};

/// high + low, where |low| ≤ half an ulp of high.
#[derive(Clone, Copy, Debug)]
pub struct DoubleDouble {
    high: f64,
    low: f64,
}

impl DoubleDouble {
    /// The sum of two doubles, exactly.
    fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let part = high - a;
        Self { high, low: (a - (high - part)) + (b - part) }
    }

    /// The product of two doubles, exactly.
    fn product(a: f64, b: f64) -> Self {
        let high = a * b;
        Self { high, low: a.mul_add(b, -high) }
    }

    /// The square root; NaN of a negative number.
    pub fn sqrt(self) -> Self {
        if self.high == 0.0 {
            return self;
        }
        // One step of Newton from the rounded root.
        let root = self.high.sqrt();
        let rest = self - Self::product(root, root);
        Self::sum(root, rest.high / (2.0 * root))
    }

    /// Rounded to double precision.
    pub fn value(self) -> f64 {
        self.high
    }

    /// |x − self| / |self| for a double x.
    pub fn relative_error(self, x: f64) -> f64 {
        ((Self::from(x) - self).high / self.high).abs()
    }
}

impl From<f64> for DoubleDouble {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

impl Add for DoubleDouble {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let s = Self::sum(self.high, other.high);
        let t = Self::sum(self.low, other.low);
        let middle = Self::sum(s.high, s.low + t.high);
        Self::sum(middle.high, middle.low + t.low)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + Self { high: -other.high, low: -other.low }
    }
}

impl Mul for DoubleDouble {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let p = Self::product(self.high, other.high);
        Self::sum(p.high, p.low + (self.high * other.low + self.low * other.high))
    }
}

impl Div for DoubleDouble {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let quotient = self.high / other.high;
        let rest = self - other * Self::from(quotient);
        Self::sum(quotient, rest.high / other.high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_knows_what_doubles_lose() {
        let n = DoubleDouble::from;
        let tiny = 2f64.powi(-80);
        assert_eq!(((n(1.0) + n(tiny)) - n(1.0)).value(), tiny);
        let third = n(1.0) / n(3.0);
        assert!(((third * n(3.0)) - n(1.0)).value().abs() < 2f64.powi(-100));
        let root = n(2.0).sqrt();
        assert!((root * root - n(2.0)).value().abs() < 2f64.powi(-100));
        assert!((n(2.0).sqrt().relative_error(std::f64::consts::SQRT_2)) < 2f64.powi(-53));
        assert!(n(2.0).sqrt().relative_error(std::f64::consts::SQRT_2) > 0.0);
    }
}
