//! Choosing one of several things with given probabilities, in constant time.

use std::hint::select_unpredictable;

/// The alias method: every one of n equally likely cells holds its own index and one other, and
/// where in the cell the random number falls decides between the two.
///
/// A. J. Walker, 1977; built as in M. D. Vose, "A linear algorithm for generating random numbers
/// with a given distribution", IEEE Transactions on Software Engineering 17(9), 1991.
#[derive(Clone, Debug)]
pub struct AliasTable {
    cells: Vec<Cell>,
}

#[derive(Clone, Copy, Debug)]
struct Cell {
    /// The cell's own index is chosen below this, in units of 2⁻³² of the cell's width.
    threshold: u64,
    alias: u32,
}

/// 1 in the units of [`Cell::threshold`].
const WHOLE: f64 = 4_294_967_296.0;

impl AliasTable {
    /// A table for probabilities that sum to 1. Each is met to about 2⁻³².
    ///
    /// # Panics
    /// If there are no probabilities, or more than 2³².
    pub fn new(probabilities: impl IntoIterator<Item = f64>) -> Self {
        let mut parts: Vec<f64> = probabilities.into_iter().collect();
        let count = u32::try_from(parts.len()).expect("at most 2^32 things to choose from");
        assert!(count > 0, "nothing to choose from");
        parts.iter_mut().for_each(|part| *part *= f64::from(count));
        let own = |alias| Cell { threshold: WHOLE as u64, alias };
        let mut cells: Vec<Cell> = (0..count).map(own).collect();
        let (mut small, mut large): (Vec<u32>, Vec<u32>) = (0..count).partition(|&i| parts[i as usize] < 1.0);
        // Each round fills one cell for good with the rest of a larger one.
        while let (Some(poor), Some(&rich)) = (small.pop(), large.last()) {
            let part = parts[poor as usize];
            cells[poor as usize] = Cell { threshold: (part * WHOLE) as u64, alias: rich };
            parts[rich as usize] -= 1.0 - part;
            if parts[rich as usize] < 1.0 {
                small.extend(large.pop());
            }
        }
        Self { cells }
    }

    /// The index that 64 random bits choose.
    pub fn choose(&self, random: u64) -> usize {
        // The high word of the product is the cell, the low word the place in it.
        let product = u128::from(random) * self.cells.len() as u128;
        let index = (product >> 64) as usize;
        let place = (product as u64) >> 32;
        let cell = &self.cells[index];
        // No branch: the processor could not guess it, and a wrong guess costs more than a map.
        select_unpredictable(place < cell.threshold, index, cell.alias as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The probability that the table gives to each index, from the thresholds themselves.
    fn shares(table: &AliasTable) -> Vec<f64> {
        let n = table.cells.len();
        let mut shares = vec![0.0; n];
        for (i, cell) in table.cells.iter().enumerate() {
            let own = cell.threshold as f64 / WHOLE;
            shares[i] += own / n as f64;
            shares[cell.alias as usize] += (1.0 - own) / n as f64;
        }
        shares
    }

    proptest! {
        #[test]
        fn a0t2_every_index_gets_its_share(weights in prop::collection::vec(0.0..1.0_f64, 1..300)) {
            let sum: f64 = weights.iter().sum();
            prop_assume!(sum > 0.0);
            let expected: Vec<f64> = weights.iter().map(|w| w / sum).collect();
            let table = AliasTable::new(expected.iter().copied());
            for (share, p) in shares(&table).iter().zip(&expected) {
                prop_assert!((share - p).abs() < 1e-9, "{share} {p}");
            }
        }
    }

    #[test]
    fn a0t2_random_bits_are_used_from_end_to_end() {
        let table = AliasTable::new([0.25, 0.75]);
        let steps = 1 << 12;
        let chosen = |i: u64| table.choose(i << 52) == 0;
        assert_eq!((0..steps).filter(|&i| chosen(i)).count(), steps as usize / 4);
        assert!(table.choose(u64::MAX) < 2);
        assert_eq!(AliasTable::new([1.0]).choose(u64::MAX), 0);
    }
}
