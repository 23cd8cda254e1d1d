//! Which boxes are near? Boxes in cubic cells.

use crate::collapse::lattice::{Cells, Lattice};

/// Many boxes, numbered.
pub(super) struct Boxes {
    lattice: Lattice,
    /// Boxes of all cells with slot i are `sorted[first[i]..first[i + 1]]`.
    first: Vec<u32>,
    sorted: Vec<u32>,
    /// Those that meet many cells.
    large: Vec<u32>,
    count: usize,
}

impl Boxes {
    /// Sorts `count` boxes into the slots of the cells that they meet, as far as `wanted` says of a slot that
    /// somebody will ask for it.
    pub(super) fn new(
        lattice: Lattice,
        count: usize,
        cells: impl Fn(usize) -> Cells,
        wanted: impl Fn(usize) -> bool,
    ) -> Self {
        let mut first = vec![0u32; lattice.slots() + 1];
        let mut large = Vec::new();
        for i in 0..count {
            let cells = cells(i);
            if cells.are_many() {
                large.push(i as u32);
            } else {
                lattice.each(&cells, |slot| first[slot] += u32::from(wanted(slot)));
            }
        }
        // Where each slot ends …
        for i in 1..first.len() {
            first[i] += first[i - 1];
        }
        let mut sorted = vec![0; first[first.len() - 1] as usize];
        // … and, filled from its end, where it begins.
        for i in (0..count).rev() {
            let cells = cells(i);
            if !cells.are_many() {
                lattice.each(&cells, |slot| {
                    if wanted(slot) {
                        first[slot] -= 1;
                        sorted[first[slot] as usize] = i as u32;
                    }
                });
            }
        }
        Self { lattice, first, sorted, large, count }
    }

    /// Calls `what` with the number of every box that meets some cells; with some of them more than once,
    /// and with others that are only near. Those that are only in slots that were not wanted are not told.
    #[inline(always)]
    pub(super) fn near(&self, cells: &Cells, mut what: impl FnMut(u32)) {
        if cells.are_many() {
            return self.all(&mut what);
        }
        self.lattice.each(cells, |slot| {
            let within = self.first[slot] as usize..self.first[slot + 1] as usize;
            self.sorted[within].iter().for_each(|&i| what(i));
        });
        self.large.iter().for_each(|&i| what(i));
    }

    #[cold]
    #[inline(never)]
    fn all(&self, what: &mut dyn FnMut(u32)) {
        (0..self.count as u32).for_each(what);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use common::math::DVec3;

    #[test]
    fn every_box_that_meets_another_is_told() {
        let mut state = 1u32;
        let mut random = || {
            state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            f64::from(state >> 8) / f64::from(1 << 24)
        };
        let mut point = |size: f64| (DVec3::new(random(), random(), random()) - 0.5) * size;
        // Of all sizes, most of them crowded about the origin.
        let mut random_box = |i: i32| {
            let low = point(0.5f64.powi(i % 10));
            (low, low + point(0.3f64.powi(i % 7)).abs())
        };
        let all: Vec<_> = (0..500).map(&mut random_box).collect();
        for size in [0.0, 1e-3, 1.0] {
            let lattice = Lattice::new(DVec3::ZERO, size, 2 * all.len());
            let boxes = Boxes::new(lattice, all.len(), |i| lattice.cells(all[i].0, all[i].1), |_| true);
            for i in 0..200 {
                let (low, high) = random_box(i);
                let mut told = vec![false; all.len()];
                boxes.near(&lattice.cells(low, high), |i| told[i as usize] = true);
                for (other, told) in all.iter().zip(told) {
                    assert!(told || other.0.cmpgt(high).any() || other.1.cmplt(low).any(), "{other:?}");
                }
            }
        }
        let lattice = Lattice::new(DVec3::ZERO, 1.0, 0);
        let none = Boxes::new(lattice, 0, |_| unreachable!(), |_| true);
        none.near(&lattice.cells(DVec3::ZERO, DVec3::ONE), |_| panic!("there is none"));
    }
}
