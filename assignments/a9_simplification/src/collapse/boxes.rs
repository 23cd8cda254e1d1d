//! Which boxes are near? Boxes in cubic cells that are found by hashing, so that neither empty space
//! nor a crowded corner of it costs anything.

use common::math::DVec3;

/// Boxes that meet more cells than this are held against everything.
const MOST_CELLS: f64 = 1024.0;
/// Slots for each box, so that few cells share one.
const SLOTS: usize = 2;

/// Many boxes, numbered.
pub(super) struct Boxes {
    /// Cells for each unit of length.
    fineness: f64,
    /// All bits of a slot's number.
    last_slot: usize,
    /// Boxes of all cells with slot i are `sorted[first[i]..first[i + 1]]`.
    first: Vec<u32>,
    sorted: Vec<u32>,
    large: Vec<u32>,
    count: usize,
}

/// Numbers of cells along the axes, lowest and highest.
type Cells = [[i32; 3]; 2];

impl Boxes {
    /// Sorts `count` boxes, given by their lowest and highest corners, into cells of a size.
    pub(super) fn new(count: usize, size: f64, of: impl Fn(usize) -> (DVec3, DVec3)) -> Self {
        let last_slot = (SLOTS * count.max(1)).next_power_of_two() - 1;
        let first = vec![0u32; last_slot + 2];
        let fineness = 1.0 / size.max(f64::MIN_POSITIVE);
        let mut boxes = Self { fineness, last_slot, first, sorted: Vec::new(), large: Vec::new(), count };
        boxes.sort(of);
        boxes
    }

    /// Bytes that are held.
    #[cfg(test)]
    pub(super) fn bytes(&self) -> usize {
        (self.first.capacity() + self.sorted.capacity() + self.large.capacity()) * size_of::<u32>()
    }

    fn sort(&mut self, of: impl Fn(usize) -> (DVec3, DVec3)) {
        let mut first = std::mem::take(&mut self.first);
        for i in 0..self.count {
            let (low, high) = of(i);
            let cells = self.cells(low, high);
            if number_of(&cells) > MOST_CELLS {
                self.large.push(i as u32);
            } else {
                each(&cells, |cell| first[self.slot(cell) + 1] += 1);
            }
        }
        for i in 1..first.len() {
            first[i] += first[i - 1];
        }
        let mut sorted = vec![0; first[first.len() - 1] as usize];
        // Each slot is filled from its end.
        let mut free = first[1..].to_vec();
        for i in (0..self.count).rev() {
            let (low, high) = of(i);
            let cells = self.cells(low, high);
            if number_of(&cells) <= MOST_CELLS {
                each(&cells, |cell| {
                    let slot = &mut free[self.slot(cell)];
                    *slot -= 1;
                    sorted[*slot as usize] = i as u32;
                });
            }
        }
        (self.first, self.sorted) = (first, sorted);
    }

    #[inline(always)]
    fn cells(&self, low: DVec3, high: DVec3) -> Cells {
        let floor = |x: f64| {
            let x = x * self.fineness;
            // Saturates; an integer below is as good as the next.
            (x as i32).saturating_sub(i32::from(x < 0.0))
        };
        [[floor(low.x), floor(low.y), floor(low.z)], [floor(high.x), floor(high.y), floor(high.z)]]
    }

    /// Neighbours along x are neighbours in memory.
    #[inline(always)]
    fn slot(&self, [x, y, z]: [i32; 3]) -> usize {
        x.wrapping_add(y.wrapping_mul(12_347)).wrapping_add(z.wrapping_mul(7_654_321)) as usize
            & self.last_slot
    }

    /// Calls `what` with the number of every box that meets this one; with some of them more than once,
    /// and with others that are only near.
    #[inline(always)]
    pub(super) fn near(&self, low: DVec3, high: DVec3, mut what: impl FnMut(u32)) {
        let cells = self.cells(low, high);
        if number_of(&cells) > MOST_CELLS || !self.large.is_empty() {
            return self.near_many(&cells, &mut what);
        }
        each(&cells, |cell| self.within(cell).iter().for_each(|&i| what(i)));
    }

    #[cold]
    #[inline(never)]
    fn near_many(&self, cells: &Cells, what: &mut dyn FnMut(u32)) {
        if number_of(cells) > MOST_CELLS {
            (0..self.count as u32).for_each(what);
        } else {
            each(cells, |cell| self.within(cell).iter().for_each(|&i| what(i)));
            self.large.iter().for_each(|&i| what(i));
        }
    }

    #[inline(always)]
    fn within(&self, cell: [i32; 3]) -> &[u32] {
        let slot = self.slot(cell);
        &self.sorted[self.first[slot] as usize..self.first[slot + 1] as usize]
    }
}

fn number_of([low, high]: &Cells) -> f64 {
    let side = |axis: usize| f64::from(high[axis]) - f64::from(low[axis]) + 1.0;
    side(0) * side(1) * side(2)
}

#[inline(always)]
fn each([low, high]: &Cells, mut what: impl FnMut([i32; 3])) {
    let [mut x, mut y, mut z] = *low;
    loop {
        what([x, y, z]);
        if x < high[0] {
            x += 1;
        } else if y < high[1] {
            (x, y) = (low[0], y + 1);
        } else if z < high[2] {
            (x, y, z) = (low[0], low[1], z + 1);
        } else {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
            let boxes = Boxes::new(all.len(), size, |i| all[i]);
            for i in 0..200 {
                let (low, high) = random_box(i);
                let mut told = vec![false; all.len()];
                boxes.near(low, high, |i| told[i as usize] = true);
                for (other, told) in all.iter().zip(told) {
                    assert!(told || other.0.cmpgt(high).any() || other.1.cmplt(low).any(), "{other:?}");
                }
            }
        }
        Boxes::new(0, 1.0, |_| unreachable!()).near(DVec3::ZERO, DVec3::ONE, |_| panic!("there is none"));
    }
}
