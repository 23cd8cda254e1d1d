//! Where a function takes a value.

use std::f64::consts::FRAC_PI_2;

/// Where a growing function, given with its derivative, takes a value between two places; `None`
/// if it does not. Newton's steps, halving where they lead outside.
pub fn root(f: impl Fn(f64) -> (f64, f64), value: f64, mut low: f64, mut high: f64) -> Option<f64> {
    let (first, last) = (f(low).0, f(high).0);
    if !(first <= value && last > value) {
        return None;
    }
    let mut x = low + (high - low) * ((value - first) / (last - first));
    for _ in 0..60 {
        let (y, slope) = f(x);
        if y <= value {
            low = x;
        } else {
            high = x;
        }
        let step = x - (y - value) / slope;
        let next = if step > low && step < high { step } else { (low + high) / 2.0 };
        // The next step would be about the square of this one.
        if (next - x).abs() <= 1e-6 {
            return Some(next);
        }
        x = next;
    }
    Some(x)
}

/// Where a growing function changes its sign between 0 and a right angle.
pub fn turn(f: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, FRAC_PI_2);
    for _ in 0..30 {
        let middle = (low + high) / 2.0;
        if f(middle) < 0.0 { low = middle } else { high = middle }
    }
    (low + high) / 2.0
}
