//! Order statistics of repeated measurements.

/// Measurements of one thing, all in the same unit.
#[derive(Clone, Debug, Default)]
pub struct Sample {
    values: Vec<f64>,
}

impl FromIterator<f64> for Sample {
    fn from_iter<I: IntoIterator<Item = f64>>(values: I) -> Self {
        Self { values: values.into_iter().collect() }
    }
}

impl Sample {
    /// What follows from each measurement.
    pub fn map(&self, of: impl Fn(f64) -> f64) -> Self {
        self.values.iter().map(|v| of(*v)).collect()
    }

    /// Adds a measurement.
    pub fn add(&mut self, value: f64) {
        self.values.push(value);
    }

    /// Puts the measurements in order, which makes quantiles of millions of them cheap.
    pub fn sort(&mut self) {
        self.values.sort_by(f64::total_cmp);
    }

    /// The value below which a share of the measurements lies, on the straight line between the two
    /// next to it; NaN if there are none.
    pub fn quantile(&self, share: f64) -> f64 {
        let mut sorted = self.values.clone();
        sorted.sort_by(f64::total_cmp);
        let place = share * sorted.len().saturating_sub(1) as f64;
        let at = |place: f64| sorted.get(place as usize).copied().unwrap_or(f64::NAN);
        let (below, above) = (at(place.floor()), at(place.ceil()));
        // Two infinities have no line between them.
        if below == above { below } else { below + (above - below) * place.fract() }
    }

    /// The middle measurement.
    pub fn median(&self) -> f64 {
        self.quantile(0.5)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_of_a_few() {
        let mut s = Sample::default();
        assert!(s.median().is_nan());
        [5.0, 1.0, 3.0].into_iter().for_each(|v| s.add(v));
        assert_eq!((s.quantile(0.0), s.median(), s.quantile(1.0)), (1.0, 3.0, 5.0));
        assert_eq!((s.quantile(0.25), s.quantile(0.875)), (2.0, 4.5));
        let rates = s.map(|v| 15.0 / v);
        assert_eq!((rates.quantile(0.0), rates.median(), rates.quantile(1.0)), (3.0, 5.0, 15.0));
    }
}
