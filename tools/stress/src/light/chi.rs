//! Pearson's χ² test: whether counts are what densities say.

/// Chance that any test of a family fails although all is well.
const ALPHA: f64 = 0.01;

/// Least expected count of a bin; smaller ones are taken together.
const LEAST: f64 = 5.0;

/// The tests of one kind.
#[derive(Default)]
pub(crate) struct Family {
    tests: Vec<(String, f64)>,
}

impl Family {
    /// Compares counts with what is expected of them; both sum to the number of samples.
    pub fn test(&mut self, what: String, counts: &[u64], expected: &[f64]) {
        let total: u64 = counts.iter().sum();
        let sum: f64 = expected.iter().sum();
        assert!((sum / total as f64 - 1.0).abs() < 1e-3, "{what}: densities sum to {}", sum / total as f64);
        let (mut chi, mut bins, mut rest) = (0.0, 0u32, (0.0, 0.0));
        for (&count, &wanted) in counts.iter().zip(expected) {
            if wanted < LEAST {
                rest = (rest.0 + count as f64, rest.1 + wanted);
                continue;
            }
            chi += (count as f64 - wanted).powi(2) / wanted;
            bins += 1;
        }
        if rest.1 >= LEAST {
            chi += (rest.0 - rest.1).powi(2) / rest.1;
            bins += 1;
        } else {
            // What hardly ever happens must not happen often.
            assert!(
                rest.0 <= rest.1 + 8.0 * LEAST.sqrt(),
                "{what}: {} samples where {} were due",
                rest.0,
                rest.1
            );
        }
        assert!(bins > 1 || expected.iter().any(|wanted| *wanted > 0.999 * sum), "{what}: nothing is tested");
        let p = if bins > 1 { exceeded(chi, f64::from(bins - 1)) } else { 1.0 };
        self.tests.push((what, p));
    }

    /// The least probability of all tests, as a share of the level that leaves all of them
    /// [`ALPHA`] together (Šidák): 1 and more is well. Its inverse is returned, so that less is
    /// better.
    ///
    /// # Errors
    /// The worst test, if it is below the level.
    pub fn judge(self) -> Result<f64, String> {
        let level = 1.0 - (1.0 - ALPHA).powf(1.0 / self.tests.len() as f64);
        let worst = self.tests.iter().min_by(|a, b| a.1.total_cmp(&b.1)).expect("there are tests");
        if worst.1 >= level { Ok(level / worst.1) } else { Err(format!("{}: p = {}", worst.0, worst.1)) }
    }
}

/// Probability that χ² of so many degrees of freedom is larger: the upper incomplete gamma
/// function, by its series below the mean and by its continued fraction above (Abramowitz &
/// Stegun 6.5.29, 6.5.31).
fn exceeded(chi: f64, freedom: f64) -> f64 {
    let (a, x) = (freedom / 2.0, chi / 2.0);
    let scale = (a * x.ln() - x - log_gamma(a)).exp();
    if x < a + 1.0 {
        let (mut term, mut sum, mut n) = (1.0 / a, 1.0 / a, a);
        while term > sum * 1e-15 {
            n += 1.0;
            term *= x / n;
            sum += term;
        }
        return 1.0 - scale * sum;
    }
    // From the far end: the fraction is 1/(x + (1−a)/(1 + 1/(x + (2−a)/(1 + 2/(x + …))))).
    let mut tail = x;
    for k in (1..20_000).rev() {
        let k = f64::from(k);
        tail = x + (k - a) / (1.0 + k / tail);
    }
    scale / tail
}

/// By Stirling's series, where it is good.
fn log_gamma(x: f64) -> f64 {
    let (mut x, mut product) = (x, 1.0);
    while x < 12.0 {
        product *= x;
        x += 1.0;
    }
    let series = 1.0 / (12.0 * x) - 1.0 / (360.0 * x.powi(3)) + 1.0 / (1260.0 * x.powi(5));
    (x - 0.5) * x.ln() - x + (std::f64::consts::TAU).ln() / 2.0 + series - f64::ln(product)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tails_are_those_of_the_tables() {
        // Two degrees: e^(−χ²/2). The others stand in every table of the distribution.
        assert!((exceeded(3.0, 2.0) - (-1.5f64).exp()).abs() < 1e-9);
        for (chi, freedom, p) in [
            (3.841, 1.0, 0.05),
            (18.307, 10.0, 0.05),
            (23.209, 10.0, 0.01),
            (67.505, 50.0, 0.05),
            (149.449, 100.0, 0.001),
        ] {
            assert!(
                (exceeded(chi, freedom) / p - 1.0).abs() < 1e-3,
                "{chi} {freedom}: {}",
                exceeded(chi, freedom)
            );
        }
        // Many degrees are nearly normal: half beyond the median, which is (1 − 2/9k)³ of k.
        let median = 12_000.0 * (1.0 - 2.0 / (9.0 * 12_000.0f64)).powi(3);
        assert!((exceeded(median, 12_000.0) - 0.5).abs() < 1e-4);
    }

    #[test]
    fn a_slight_slope_is_found() {
        let mut family = Family::default();
        let counts: Vec<u64> = (0..100).map(|i| 1000 + i * 3 - 148).collect();
        let total: u64 = counts.iter().sum();
        family.test("slope".into(), &counts, &[total as f64 / 100.0; 100]);
        assert!(family.judge().unwrap_err().contains("p = "));
    }
}
