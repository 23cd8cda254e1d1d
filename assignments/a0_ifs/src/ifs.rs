//! The iterated function system itself.

use crate::Affine2;

/// A map and how often it is chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WeightedMap {
    /// Probability in [0, 1].
    pub probability: f64,
    /// What is done with the point.
    pub map: Affine2,
}

/// Affine maps with probabilities that sum to 1.
///
/// If the maps shrink distances on average, there is exactly one distribution of points that the
/// system leaves unchanged, and its support is the attractor: the picture (Barnsley, *Fractals
/// Everywhere*, 1988).
#[derive(Clone, Debug, PartialEq)]
pub struct Ifs {
    maps: Vec<WeightedMap>,
}

impl Ifs {
    /// How far the sum of the probabilities may be from 1, since 0.33 stands for a third.
    pub const SUM_TOLERANCE: f64 = 1e-3;

    /// Takes the maps as written and makes the probabilities sum to 1 exactly. Maps that are
    /// never chosen are dropped.
    ///
    /// # Errors
    /// The sum, if it is more than [`Self::SUM_TOLERANCE`] from 1; that includes an empty list.
    pub fn new(mut maps: Vec<WeightedMap>) -> Result<Self, f64> {
        let sum: f64 = maps.iter().map(|entry| entry.probability).sum();
        // A decimal such as 0.999 is not exact, so that the limit itself needs some room.
        let near = (sum - 1.0).abs() <= Self::SUM_TOLERANCE + 1e-9;
        if !near {
            return Err(sum);
        }
        maps.retain(|entry| entry.probability > 0.0);
        for entry in &mut maps {
            entry.probability /= sum;
        }
        Ok(Self { maps })
    }

    /// The maps, at least one, each with a probability above zero.
    pub fn maps(&self) -> &[WeightedMap] {
        &self.maps
    }

    /// The system whose every map does `steps` maps of this one: all combinations, their
    /// probabilities multiplied. One step of it is `steps` steps of the original.
    ///
    /// # Panics
    /// If `steps` is 0.
    pub fn compounded(&self, steps: u32) -> Self {
        assert!(steps > 0, "no steps are no map");
        let mut maps = self.maps.clone();
        for _ in 1..steps {
            maps = self.maps.iter().flat_map(|last| maps.iter().map(|first| first.then(last))).collect();
        }
        Self { maps }
    }
}

impl WeightedMap {
    /// Both maps in order, chosen independently.
    fn then(&self, last: &Self) -> Self {
        Self { probability: self.probability * last.probability, map: last.map.after(&self.map) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry(probability: f64, shift: f64) -> WeightedMap {
        WeightedMap { probability, map: Affine2 { rows: [[0.5, 0.0, shift], [0.0, 0.5, 0.0]] } }
    }

    #[test]
    fn a0t1_probabilities_must_sum_to_one_within_a_thousandth() {
        for sum in [0.999, 1.0, 1.001] {
            let ifs = Ifs::new(vec![entry(0.5, 0.0), entry(sum - 0.5, 0.5)]).unwrap();
            let total: f64 = ifs.maps().iter().map(|entry| entry.probability).sum();
            assert!((total - 1.0).abs() < 1e-15);
        }
        for sum in [0.0, 0.99, 1.0011, f64::NAN] {
            assert!(Ifs::new(vec![entry(sum, 0.0)]).is_err());
        }
        assert!(Ifs::new(vec![]).is_err());
    }

    #[test]
    fn a0t2_compounds_list_every_combination() {
        let ifs = Ifs::new(vec![entry(0.25, 0.0), entry(0.0, 9.0), entry(0.75, 0.5)]).unwrap();
        let compound = ifs.compounded(3);
        assert_eq!(compound.maps().len(), 8);
        let total: f64 = compound.maps().iter().map(|entry| entry.probability).sum();
        assert_eq!(total, 1.0);
        // Images of the corner are the multiples of an eighth: bits of the maps, last one first.
        for entry in compound.maps() {
            let eighths = entry.map.rows[0][2] * 8.0;
            assert_eq!(eighths.fract(), 0.0);
            let ones = (eighths as u32).count_ones() as i32;
            assert_eq!(entry.probability, 0.75_f64.powi(ones) * 0.25_f64.powi(3 - ones));
        }
    }
}
