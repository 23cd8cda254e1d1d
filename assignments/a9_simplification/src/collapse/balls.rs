//! Which balls meet a box? Balls in cubic cells that are found by hashing, so that neither empty space
//! nor a crowded corner of it costs anything.

use common::math::DVec3;

/// Balls that meet more cells than this are held against every box, boxes that do against every ball.
const MOST_CELLS: f64 = 1024.0;

/// Slots for each ball, and as many more, so that few cells share one.
const SLOTS: usize = 4;
const MORE_SLOTS: usize = 1 << 12;

/// A place and what is around it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ball {
    pub centre: DVec3,
    pub radius: f64,
}

impl Ball {
    /// Whether it meets a box.
    #[inline(always)]
    pub(super) fn meets(&self, low: DVec3, high: DVec3) -> bool {
        let off = (low - self.centre).max(self.centre - high).max(DVec3::ZERO);
        off.length_squared() <= self.radius * self.radius
    }
}

/// Many balls, each with something that belongs to it.
pub(super) struct Balls<T> {
    pub all: Vec<(Ball, T)>,
    /// Cells for each unit of length.
    fineness: f64,
    /// All bits of a slot's number.
    last_slot: usize,
    /// Balls of all cells with slot i are `sorted[first[i]..first[i + 1]]`.
    first: Vec<u32>,
    sorted: Vec<(u32, T)>,
    large: Vec<u32>,
}

/// Numbers of cells along the axes, lowest and highest.
type Cells = [[i32; 3]; 2];

impl<T: Copy> Balls<T> {
    /// Sorts them; `size` is the length of what they will be held against.
    pub(super) fn new(all: Vec<(Ball, T)>, size: f64) -> Self {
        let mean = all.iter().map(|(ball, _)| ball.radius).sum::<f64>() / all.len().max(1) as f64;
        let fineness = 1.0 / (2.0 * mean + 0.75 * size).max(f64::MIN_POSITIVE);
        let last_slot = (SLOTS * all.len() + MORE_SLOTS).next_power_of_two() - 1;
        let mut balls =
            Self { all, fineness, last_slot, first: Vec::new(), sorted: Vec::new(), large: Vec::new() };
        balls.sort();
        balls
    }

    fn sort(&mut self) {
        let mut first = vec![0u32; self.last_slot + 2];
        let (mut large, mut in_cells) = (Vec::new(), Vec::with_capacity(self.all.len()));
        for (i, &(Ball { centre, radius }, _)) in (0..).zip(&self.all) {
            let cells = self.cells(centre - radius, centre + radius);
            if count(&cells) > MOST_CELLS {
                large.push(i);
            } else {
                each(&cells, |cell| first[self.slot(cell) + 1] += 1);
                in_cells.push((i, cells));
            }
        }
        for i in 1..first.len() {
            first[i] += first[i - 1];
        }
        // There is a ball if there is a place for one.
        let mut sorted = Vec::new();
        if let Some(&(_, any)) = self.all.first() {
            sorted.resize(first[first.len() - 1] as usize, (0, any));
        }
        let mut free = first.clone();
        for (i, cells) in in_cells {
            each(&cells, |cell| {
                let slot = &mut free[self.slot(cell)];
                sorted[*slot as usize] = (i, self.all[i as usize].1);
                *slot += 1;
            });
        }
        (self.first, self.sorted, self.large) = (first, sorted, large);
    }

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
        x.wrapping_add(y.wrapping_mul(12_347)).wrapping_add(z.wrapping_mul(7_654_321)) as usize & self.last_slot
    }

    /// Calls `what` with the number of every ball that meets a box and what belongs to it, with some of
    /// them more than once, and with others.
    #[inline(always)]
    pub(super) fn near(&self, low: DVec3, high: DVec3, mut what: impl FnMut(u32, T)) {
        let cells = self.cells(low, high);
        let few = count(&cells) <= MOST_CELLS;
        if few {
            each(&cells, |cell| {
                let slot = self.slot(cell);
                let range = self.first[slot] as usize..self.first[slot + 1] as usize;
                for &(ball, of_ball) in &self.sorted[range] {
                    what(ball, of_ball);
                }
            });
        }
        if !few || !self.large.is_empty() {
            self.beyond(few, &mut what);
        }
    }

    #[cold]
    #[inline(never)]
    fn beyond(&self, few: bool, what: &mut dyn FnMut(u32, T)) {
        if few {
            self.large.iter().for_each(|&i| what(i, self.all[i as usize].1));
        } else {
            (0..).zip(&self.all).for_each(|(i, (_, of_ball))| what(i, *of_ball));
        }
    }
}

fn count([low, high]: &Cells) -> f64 {
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
    fn every_ball_that_meets_a_box_is_told() {
        let mut state = 1u32;
        let mut random = || {
            state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            f64::from(state >> 8) / f64::from(1 << 24)
        };
        let mut point = |size: f64| (DVec3::new(random(), random(), random()) - 0.5) * size;
        // Of all sizes, most of them crowded about the origin.
        let all: Vec<(Ball, ())> = (0..500)
            .map(|i| {
                let centre = point(0.5f64.powi(i % 10));
                (Ball { centre, radius: point(0.3f64.powi(i % 7)).length() }, ())
            })
            .collect();
        for size in [0.0, 1e-3, 1.0] {
            let balls = Balls::new(all.clone(), size);
            for i in 0..200 {
                let (low, way) = (point(1.5), point(0.3f64.powi(i % 9)).abs());
                let mut told = vec![false; all.len()];
                balls.near(low, low + way, |ball, ()| told[ball as usize] = true);
                for ((ball, ()), told) in all.iter().zip(told) {
                    let off = (low - ball.centre).max(ball.centre - low - way).max(DVec3::ZERO);
                    assert!(told || off.length() > ball.radius, "{ball:?} {low} {way}");
                    assert_eq!(ball.meets(low, low + way), off.length() <= ball.radius);
                }
            }
        }
        Balls::<()>::new(Vec::new(), 0.0).near(DVec3::ZERO, DVec3::ONE, |_, ()| panic!("there is none"));
    }
}
