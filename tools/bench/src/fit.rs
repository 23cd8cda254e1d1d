//! A straight line through points.

/// y ≈ a + b·x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// Value at x = 0.
    pub a: f64,
    /// Growth per unit of x.
    pub b: f64,
    /// Share of the variance of y that the line explains, at most 1; 1 if there is none.
    pub explained: f64,
}

/// The line of least squares; needs points at two different x, else it is NaN.
pub fn fit(points: &[(f64, f64)]) -> Fit {
    let n = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / n;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let sum = |of: &dyn Fn(f64, f64) -> f64| points.iter().map(|p| of(p.0 - x, p.1 - y)).sum::<f64>();
    let (xx, xy, yy) = (sum(&|dx, _| dx * dx), sum(&|dx, dy| dx * dy), sum(&|_, dy| dy * dy));
    let b = xy / xx;
    let left = sum(&|dx, dy| (dy - b * dx) * (dy - b * dx));
    Fit { a: y - b * x, b, explained: if yy > 0.0 { 1.0 - left / yy } else { 1.0 } }
}

/// Fits y ≈ a·xᵇ, by the line of least squares through the logarithms; [`Fit::a`] is that of the
/// line. All numbers must be above zero.
pub fn power(points: &[(f64, f64)]) -> Fit {
    fit(&points.iter().map(|(x, y)| (x.ln(), y.ln())).collect::<Vec<_>>())
}

impl Fit {
    /// The two ends, at the least and the largest x of a curve, of what [`power`] has fitted to it.
    pub fn ends(&self, points: &[(f64, f64)]) -> [(f64, f64); 2] {
        let x = |pick: fn(f64, f64) -> f64| points.iter().map(|p| p.0).reduce(pick).unwrap_or(f64::NAN);
        [x(f64::min), x(f64::max)].map(|x| (x, (self.a + self.b * x.ln()).exp()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_a_line_and_says_how_good_it_is() {
        let exact = fit(&[(1.0, 5.0), (2.0, 7.0), (4.0, 11.0)]);
        assert!((exact.a - 3.0).abs() < 1e-12 && (exact.b - 2.0).abs() < 1e-12);
        assert!((exact.explained - 1.0).abs() < 1e-12);
        let none = fit(&[(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)]);
        assert!(none.b.abs() < 1e-12 && none.explained.abs() < 1e-12);
        assert_eq!(fit(&[(0.0, 2.0), (1.0, 2.0)]), Fit { a: 2.0, b: 0.0, explained: 1.0 });
    }

    #[test]
    fn powers_are_lines_of_logarithms() {
        let points = [1.0, 10.0, 1000.0].map(|x: f64| (x, 3.0 * x.powf(1.5)));
        let fit = power(&points);
        assert!((fit.b - 1.5).abs() < 1e-12 && (fit.a.exp() - 3.0).abs() < 1e-12);
        let ends = fit.ends(&points);
        assert!((ends[0].1 - 3.0).abs() < 1e-9 && (ends[1].1 / points[2].1 - 1.0).abs() < 1e-9);
    }
}
