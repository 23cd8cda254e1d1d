//! Signs of small polynomials in `f32` inputs, without rounding.
//!
//! A product of two `f32` is exact in `f64`, a product of three splits into two `f64`, and a
//! sum of `f64` terms has an exact value as an expansion (Shewchuk, "Adaptive Precision
//! Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997). No `f32` input can
//! overflow or underflow on the way: three factors stay between 2⁻⁴⁴⁷ and 2³⁸⁴.

use std::cmp::Ordering;

/// a + b as (rounded sum, error), exactly (Knuth).
#[inline]
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let b_virtual = sum - a;
    let a_virtual = sum - b_virtual;
    (sum, (a - a_virtual) + (b - b_virtual))
}

/// a·b as (rounded product, error), exactly. The fused operation is a slow library call where
/// the processor lacks it, which the rare exact path can afford.
#[inline]
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    (product, a.mul_add(b, -product))
}

/// An exact sum of up to `N` doubles: components in increasing magnitude, not overlapping.
pub struct Expansion<const N: usize> {
    components: [f64; N],
    len: usize,
}

impl<const N: usize> Default for Expansion<N> {
    fn default() -> Self {
        Self { components: [0.0; N], len: 0 }
    }
}

impl<const N: usize> Expansion<N> {
    /// Adds one term. At most `N` terms can be added.
    pub fn add(&mut self, term: f64) {
        let mut carry = term;
        let mut kept = 0;
        for i in 0..self.len {
            let (sum, error) = two_sum(carry, self.components[i]);
            carry = sum;
            if error != 0.0 {
                self.components[kept] = error;
                kept += 1;
            }
        }
        if carry != 0.0 {
            self.components[kept] = carry;
            kept += 1;
        }
        self.len = kept;
    }

    /// Adds a·b, where the product needs at most 106 bits.
    pub fn add_product(&mut self, a: f64, b: f64) {
        let (product, error) = two_product(a, b);
        self.add(product);
        self.add(error);
    }

    /// The sum rounded to `f64`; its sign is the exact sign, and it is 0 only if the sum is.
    pub fn value(&self) -> f64 {
        self.components[..self.len].iter().sum()
    }
}

/// d · ((a − o) × (b − o)), correct to the last bits of `f64`, with the exact sign.
/// All inputs are `f32` values held in `f64`.
#[cold]
pub fn edge(o: [f64; 3], d: [f64; 3], a: [f64; 3], b: [f64; 3]) -> f64 {
    // The determinant is linear in each column, so it splits into three of input columns only.
    let mut sum = Expansion::<36>::default();
    for (p, q) in [(a, b), (b, o), (o, a)] {
        for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
            sum.add_product(p[j] * q[k], d[i]);
            sum.add_product(-(p[k] * q[j]), d[i]);
        }
    }
    sum.value()
}

/// The sign of [`edge`] after moving the ray sideways by an infinitesimal (ε, ε², ε³): decides
/// rays that meet the edge exactly, the same way for both triangles that share it (simulation
/// of simplicity, Edelsbrunner & Mücke 1990). 0 only if the edge is parallel to the ray.
#[cold]
pub fn edge_tie(d: [f64; 3], a: [f64; 3], b: [f64; 3]) -> f64 {
    // Moving the origin by δ changes the edge function by δ · ((a − b) × d).
    for (j, k) in [(1, 2), (2, 0), (0, 1)] {
        let mut sum = Expansion::<4>::default();
        sum.add(a[j] * d[k]);
        sum.add(-(b[j] * d[k]));
        sum.add(-(a[k] * d[j]));
        sum.add(b[k] * d[j]);
        let value = sum.value();
        if value != 0.0 {
            return value;
        }
    }
    0.0
}

/// One coordinate of a ray and a plane across its axis: met at t = (plane − origin) / direction.
#[derive(Clone, Copy, Debug)]
pub struct Crossing {
    /// Where the plane stands on the axis.
    pub plane: f64,
    /// The ray's origin on that axis, an `f32` value.
    pub origin: f64,
    /// The ray's direction along that axis, an `f32` value, not zero.
    pub direction: f64,
    /// t, with a relative error of at most three roundings of `f64`.
    pub t: f64,
}

impl Crossing {
    /// Whether the ray meets this plane before, with, or after the other one: the order of the
    /// exact quotients, not of their roundings.
    #[inline]
    pub fn order(&self, other: &Self) -> Ordering {
        let difference = self.t - other.t;
        // Six roundings of 2⁻⁵³ on the larger quotient, generously.
        if difference.abs() > self.t.abs().max(other.t.abs()) * 2f64.powi(-49) {
            return if difference < 0.0 { Ordering::Less } else { Ordering::Greater };
        }
        self.exact_order(other)
    }

    #[cold]
    fn exact_order(&self, other: &Self) -> Ordering {
        let mut sum = Expansion::<8>::default();
        sum.add_product(self.plane, other.direction);
        sum.add_product(-self.origin, other.direction);
        sum.add_product(-other.plane, self.direction);
        sum.add_product(other.origin, self.direction);
        let sign = sum.value() * self.direction.signum() * other.direction.signum();
        sign.partial_cmp(&0.0).unwrap_or(Ordering::Equal)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_that_rounding_loses() {
        let mut e = Expansion::<4>::default();
        for term in [1e300, 1.0, -1e300, 2f64.powi(-400)] {
            e.add(term);
        }
        assert_eq!(e.value(), 1.0);
        e.add(-1.0);
        assert_eq!(e.value(), 2f64.powi(-400));
    }

    /// Integer lattices give the exact answer in i128.
    #[test]
    fn edge_has_the_sign_of_integers() {
        let mut state = 12345u64;
        let mut draw = |bits: u32| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 33) as i128 % (1 << bits) - (1 << (bits - 1))
        };
        let mut zeros = 0;
        for round in 0..20_000 {
            let bits = if round % 2 == 0 { 3 } else { 24 };
            let [o, d, a, b]: [[i128; 3]; 4] = std::array::from_fn(|_| std::array::from_fn(|_| draw(bits)));
            let p: [i128; 3] = std::array::from_fn(|i| a[i] - o[i]);
            let q: [i128; 3] = std::array::from_fn(|i| b[i] - o[i]);
            let truth = d[0] * (p[1] * q[2] - p[2] * q[1])
                + d[1] * (p[2] * q[0] - p[0] * q[2])
                + d[2] * (p[0] * q[1] - p[1] * q[0]);
            let float = |v: [i128; 3]| v.map(|x| x as f64);
            let value = edge(float(o), float(d), float(a), float(b));
            assert_eq!(value.partial_cmp(&0.0), truth.partial_cmp(&0), "{o:?} {d:?} {a:?} {b:?}");
            assert!((value - truth as f64).abs() <= 2f64.powi(-52) * value.abs());
            zeros += u32::from(truth == 0);
        }
        assert!(zeros > 100, "the small lattice should hold exact ties, got {zeros}");
    }

    #[test]
    fn tie_is_antisymmetric() {
        let d = [1.0, 2.0, 3.0];
        let (a, b) = ([1.0, 0.0, 0.0], [0.0, 1.0, 5.0]);
        assert_eq!(edge_tie(d, a, b), -edge_tie(d, b, a));
        assert_eq!(edge_tie(d, [0.0; 3], d), 0.0);
    }
}
