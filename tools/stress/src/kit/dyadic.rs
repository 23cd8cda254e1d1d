//! Exact numbers: an integer of any length times a power of two.

use num_bigint::{BigInt, Sign};
use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

/// integer · 2^exponent. Every finite float is one, and so is every sum and product of them.
#[derive(Clone, Debug)]
pub struct Dyadic {
    integer: BigInt,
    exponent: i64,
}

impl Dyadic {
    /// The exact value of a finite float.
    ///
    /// # Panics
    /// If it is not finite.
    pub fn new(x: f64) -> Self {
        assert!(x.is_finite(), "{x} has no exact value");
        let bits = x.to_bits();
        let biased = (bits >> 52 & 0x7ff) as i64;
        let fraction = (bits & ((1 << 52) - 1)) as i64;
        let magnitude = if biased == 0 { fraction } else { fraction | 1 << 52 };
        let integer = BigInt::from(if x < 0.0 { -magnitude } else { magnitude });
        Self { integer, exponent: biased.max(1) - 1075 }
    }

    /// −1, 0 or 1.
    pub fn sign(&self) -> i32 {
        match self.integer.sign() {
            Sign::Minus => -1,
            Sign::NoSign => 0,
            Sign::Plus => 1,
        }
    }

    /// The quotient as `f64`, within two roundings; 0 and infinity beyond its range. NaN if
    /// `divisor` is 0.
    pub fn over(&self, divisor: &Self) -> f64 {
        if divisor.sign() == 0 {
            return f64::NAN;
        }
        let shift = 110 + divisor.integer.bits() as i64 - self.integer.bits() as i64;
        let (mut above, mut below) = (self.integer.clone(), divisor.integer.clone());
        if shift >= 0 {
            above <<= shift
        } else {
            below <<= -shift
        }
        let quotient = i128::try_from(above / below).expect("111 bits at most") as f64;
        let exponent = self.exponent - divisor.exponent - shift;
        // In two steps, each within range.
        let half = exponent.clamp(-2000, 2000) / 2;
        quotient * 2f64.powi(half as i32) * 2f64.powi((exponent.clamp(-2000, 2000) - half) as i32)
    }

    /// The value as `f64`, within two roundings.
    pub fn to_f64(&self) -> f64 {
        self.over(&Self::new(1.0))
    }

    /// Both integers at the smaller of the two exponents.
    fn aligned(&self, other: &Self) -> (BigInt, BigInt, i64) {
        let exponent = self.exponent.min(other.exponent);
        let lift = |d: &Self| &d.integer << (d.exponent - exponent);
        (lift(self), lift(other), exponent)
    }

    /// a · (b × c) of three vectors.
    pub fn determinant(a: &[Self; 3], b: &[Self; 3], c: &[Self; 3]) -> Self {
        let minor = |i: usize, j: usize| &(&b[i] * &c[j]) - &(&b[j] * &c[i]);
        &(&(&a[0] * &minor(1, 2)) + &(&a[1] * &minor(2, 0))) + &(&a[2] * &minor(0, 1))
    }

    /// The dot product of two vectors.
    pub fn dot(a: &[Self; 3], b: &[Self; 3]) -> Self {
        &(&(&a[0] * &b[0]) + &(&a[1] * &b[1])) + &(&a[2] * &b[2])
    }
}

impl Add for &Dyadic {
    type Output = Dyadic;
    fn add(self, other: Self) -> Dyadic {
        let (a, b, exponent) = self.aligned(other);
        Dyadic { integer: a + b, exponent }
    }
}

impl Sub for &Dyadic {
    type Output = Dyadic;
    fn sub(self, other: Self) -> Dyadic {
        let (a, b, exponent) = self.aligned(other);
        Dyadic { integer: a - b, exponent }
    }
}

impl Mul for &Dyadic {
    type Output = Dyadic;
    fn mul(self, other: Self) -> Dyadic {
        Dyadic { integer: &self.integer * &other.integer, exponent: self.exponent + other.exponent }
    }
}

impl Neg for &Dyadic {
    type Output = Dyadic;
    fn neg(self) -> Dyadic {
        Dyadic { integer: -&self.integer, exponent: self.exponent }
    }
}

impl PartialEq for Dyadic {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Dyadic {}

impl PartialOrd for Dyadic {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Dyadic {
    fn cmp(&self, other: &Self) -> Ordering {
        (self - other).sign().cmp(&0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floats_come_back() {
        for x in [0.0, -1.5, 1e300, -1e-300, 5e-324, f64::MAX, 0.1] {
            assert_eq!(Dyadic::new(x).to_f64(), x);
        }
        assert_eq!(Dyadic::new(1.0).over(&Dyadic::new(-3.0)), -1.0 / 3.0);
        assert!(Dyadic::new(1.0).over(&Dyadic::new(0.0)).is_nan());
    }

    #[test]
    fn sums_and_products_do_not_round() {
        let (big, one) = (Dyadic::new(1e200), Dyadic::new(1.0));
        assert_eq!(&(&big + &one) - &big, one);
        let square = &(&big + &one) * &(&big - &one);
        assert_eq!(&(&big * &big) - &square, one);
        assert!(-&big < one && one.sign() == 1);
    }
}
