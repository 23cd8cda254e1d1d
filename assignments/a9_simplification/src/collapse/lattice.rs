//! Cubic cells that are found by hashing, so that neither empty space nor a crowded corner of it
//! costs anything.

use common::math::Vec3;

/// What meets more cells than this is better held against everything.
const MOST_CELLS: u64 = 1024;

/// The greatest number of a cell.
const FARTHEST: i32 = i16::MAX as i32;
/// How far the slots of neighbours along y and z are apart.
const BESIDE: i32 = 12_347;
const BEHIND: i32 = 7_654_321;

/// Numbers of a cell along the axes, and the same negative, so that the least of several is both the lowest
/// and the highest; every fourth is 0.
pub(super) type Cell = [i16; 8];

/// Space, cut into cubes that share some slots.
#[derive(Clone, Copy)]
pub(super) struct Lattice {
    /// Cells for each unit of length.
    fineness: f32,
    /// All bits of a slot's number.
    last_slot: usize,
}

/// Cells in a box: the lowest, and how many more there are along each axis.
#[derive(Clone, Copy, Default)]
pub(super) struct Cells {
    low: [i32; 3],
    more: [u32; 3],
}

impl Lattice {
    /// Cells of a size, in at least so many slots.
    pub(super) fn new(size: f64, slots: usize) -> Self {
        let last_slot = slots.max(1).next_power_of_two() - 1;
        Self { fineness: (1.0 / size).min(1e30) as f32, last_slot }
    }

    /// Cells for each unit of length.
    pub(super) fn fineness(&self) -> f32 {
        self.fineness
    }

    /// How many slots there are.
    pub(super) fn slots(&self) -> usize {
        self.last_slot + 1
    }

    /// The cell of a place. What is near zero or very far off shares cells with what is
    /// beside it: all that matters is that numbers never fall along an axis.
    #[inline(always)]
    pub(super) fn cell(&self, p: Vec3) -> Cell {
        let p = p * self.fineness;
        let number = |x: f32| (x as i32).clamp(-FARTHEST, FARTHEST) as i16;
        let [x, y, z] = [number(p.x), number(p.y), number(p.z)];
        [x, y, z, 0, -x, -y, -z, 0]
    }

    /// The cells that a box meets.
    #[inline(always)]
    pub(super) fn cells(&self, low: Vec3, high: Vec3) -> Cells {
        let (low, high) = (self.cell(low), self.cell(high));
        between(low, low, high)
    }

    /// Calls `what` with the slots of some cells, most often of one.
    #[inline(always)]
    pub(super) fn each_slot(&self, cells: &Cells, mut what: impl FnMut(usize)) {
        if cells.is_one() {
            return what(first_slot(cells) as usize & self.last_slot);
        }
        self.slots_of(cells).for_each(what);
    }

    /// The slots of some cells. Those of neighbours along x are neighbours, too.
    #[inline(always)]
    pub(super) fn slots_of(&self, cells: &Cells) -> Slots {
        let (next, more) = (first_slot(cells), cells.more);
        Slots { next, more, left: more, last_slot: self.last_slot, is_over: false }
    }
}

/// The slot of the lowest cell in an endless table.
#[inline(always)]
fn first_slot(&Cells { low: [x, y, z], .. }: &Cells) -> i32 {
    x.wrapping_add(y.wrapping_mul(BESIDE)).wrapping_add(z.wrapping_mul(BEHIND))
}

/// See [`Lattice::slots_of`].
pub(super) struct Slots {
    next: i32,
    more: [u32; 3],
    left: [u32; 3],
    last_slot: usize,
    is_over: bool,
}

impl Iterator for Slots {
    type Item = usize;

    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        if self.is_over {
            return None;
        }
        let (slot, more) = (self.next as usize & self.last_slot, self.more);
        let [x_left, y_left, z_left] = self.left;
        if x_left > 0 {
            (self.left[0], self.next) = (x_left - 1, self.next.wrapping_add(1));
        } else if y_left > 0 {
            self.left = [more[0], y_left - 1, z_left];
            self.next = self.next.wrapping_add(BESIDE).wrapping_sub(more[0] as i32);
        } else if z_left > 0 {
            self.left = [more[0], more[1], z_left - 1];
            let back = (more[1] as i32).wrapping_mul(BESIDE).wrapping_add(more[0] as i32);
            self.next = self.next.wrapping_add(BEHIND).wrapping_sub(back);
        } else {
            self.is_over = true;
        }
        Some(slot)
    }
}

/// All cells between three.
#[inline(always)]
pub(super) fn between(a: Cell, b: Cell, c: Cell) -> Cells {
    let [x, y, z, _, u, v, w, _] = least(least(a, b), c).map(i32::from);
    Cells { low: [x, y, z], more: [(-u - x) as u32, (-v - y) as u32, (-w - z) as u32] }
}

#[inline(always)]
fn least(a: Cell, b: Cell) -> Cell {
    std::array::from_fn(|i| a[i].min(b[i]))
}

impl Cells {
    /// Whether it is only one.
    #[inline(always)]
    fn is_one(&self) -> bool {
        self.more == [0; 3]
    }

    /// Whether there are so many that it is better not to ask for each.
    #[inline(always)]
    pub(super) fn are_many(&self) -> bool {
        let [x, y, z] = self.more.map(u64::from);
        // Most are few.
        if x | y | z < 8 {
            return false;
        }
        (x + 1) * (y + 1) * (z + 1) > MOST_CELLS
    }
}
