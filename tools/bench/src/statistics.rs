//! Means and slopes with what they may be wrong by.

use crate::fit::power;
use crate::report::{Cell, Measured};

/// A mean and half the width of its 95 % confidence interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mean {
    /// The mean.
    pub value: f64,
    /// The true mean is this near with a probability of 95 %; NaN for a single value.
    pub within: f64,
}

/// Quantiles of Student's distribution for 95 %, by degrees of freedom from 1.
const STUDENT: [f64; 10] = [12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228];

impl Mean {
    /// Of independent values.
    pub fn of(values: &[f64]) -> Self {
        let n = values.len() as f64;
        let value = values.iter().sum::<f64>() / n;
        let squares: f64 = values.iter().map(|v| (v - value) * (v - value)).sum();
        let freedom = values.len().saturating_sub(1);
        let student = STUDENT.get(freedom.wrapping_sub(1)).copied();
        let student = student.unwrap_or(if freedom == 0 { f64::NAN } else { 2.1 });
        Self { value, within: student * (squares / freedom as f64 / n).sqrt() }
    }
}

impl Mean {
    /// As a figure that is the same in every run, in a unit of which there are `scale` in one.
    pub fn cell(self, scale: f64) -> Cell {
        Cell::estimate(self.value * scale, self.within * scale)
    }

    /// As a figure that was made of times.
    pub fn derived(self) -> Cell {
        match self.within.is_nan() {
            true => Cell::derived(self.value),
            false => Cell::Derived(Measured {
                median: self.value,
                low: self.value - self.within,
                high: self.value + self.within,
            }),
        }
    }
}

/// The slope b of error ≈ a·samplesᵇ: the mean over the seeds, each of which is a curve of
/// (samples, error).
pub fn slope(seeds: &[Vec<(f64, f64)>]) -> Mean {
    let slopes: Vec<f64> = seeds.iter().map(|curve| power(curve).b).collect();
    Mean::of(&slopes)
}

/// What a curve of (error, price) asks for an error between two of its points, along the straight
/// line between their logarithms; `None` outside. Errors fall along the curve.
pub fn price_at(curve: &[(f64, f64)], error: f64) -> Option<f64> {
    let (before, after) = curve
        .windows(2)
        .map(|pair| (pair[0], pair[1]))
        .find(|(before, after)| before.0 >= error && error >= after.0)?;
    let part = (before.0 / error).ln() / (before.0 / after.0).ln();
    Some((before.1.ln() * (1.0 - part) + after.1.ln() * part).exp())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_and_their_intervals() {
        let mean = Mean::of(&[1.0, 2.0, 3.0]);
        assert_eq!(mean.value, 2.0);
        assert!((mean.within - 4.303 / 3f64.sqrt()).abs() < 1e-12);
        assert!(Mean::of(&[1.0]).within.is_nan());
    }

    #[test]
    fn slopes_of_powers() {
        let curve = |a: f64, b: f64| (1..6).map(|n| (f64::from(n), a * f64::from(n).powf(b))).collect();
        let mean = slope(&[curve(1.0, -0.5), curve(7.0, -0.7)]);
        assert!((mean.value + 0.6).abs() < 1e-12 && mean.within > 0.1);
    }

    #[test]
    fn prices_between_points() {
        let curve = [(1.0, 1.0), (0.1, 100.0), (0.01, 1000.0)];
        assert!((price_at(&curve, 0.1f64.sqrt()).unwrap() - 10.0).abs() < 1e-9);
        assert_eq!((price_at(&curve, 2.0), price_at(&curve, 0.001)), (None, None));
    }
}
