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
}
