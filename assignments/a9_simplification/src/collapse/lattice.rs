//! Cubic cells that are found by hashing, so that neither empty space nor a crowded corner of it
//! costs anything.

use common::math::Vec3;
use common::math::lanes::{LANES, Vectors, scale, subtract};
use common::simd::{Simd, SimdBase, SimdMask, f32x8, i32x8};

/// What meets more cells than this is better held against everything.
const MOST_CELLS: u64 = 1024;

/// The greatest number of a cell.
const FARTHEST: f32 = i16::MAX as f32;
/// How far the slots of neighbours along y and z are apart.
const BESIDE: i32 = 12_347;
const BEHIND: i32 = 7_654_321;

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

    /// The cell of a place along an axis. What is near zero or very far off shares cells with what is
    /// beside it: all that matters is that numbers never fall along an axis.
    #[inline(always)]
    fn cell(&self, x: f32) -> i32 {
        (x * self.fineness).clamp(-FARTHEST, FARTHEST) as i32
    }

    /// The cells that a box meets.
    #[inline(always)]
    pub(super) fn cells(&self, low: Vec3, high: Vec3) -> Cells {
        let low = [self.cell(low.x), self.cell(low.y), self.cell(low.z)];
        let high = [self.cell(high.x), self.cell(high.y), self.cell(high.z)];
        let more = [high[0] - low[0], high[1] - low[1], high[2] - low[2]];
        Cells { low, more: [more[0] as u32, more[1] as u32, more[2] as u32] }
    }

    /// The cells of eight places.
    #[inline(always)]
    fn eight_cells<S: Simd>(&self, simd: S, places: Vectors<f32x8<S>>) -> Vectors<i32x8<S>> {
        let (least, most) = (f32x8::splat(simd, -FARTHEST), f32x8::splat(simd, FARTHEST));
        let [x, y, z] = scale(places, f32x8::splat(simd, self.fineness));
        [
            simd.cvt_i32_f32x8(x.max(least).min(most)),
            simd.cvt_i32_f32x8(y.max(least).min(most)),
            simd.cvt_i32_f32x8(z.max(least).min(most)),
        ]
    }

    /// The cells that eight boxes meet.
    #[inline(always)]
    pub(super) fn met<S: Simd>(&self, simd: S, low: Vectors<f32x8<S>>, high: Vectors<f32x8<S>>) -> Met {
        let (low, high) = (self.eight_cells(simd, low), self.eight_cells(simd, high));
        let more = subtract(high, low);
        let all = more[0] | more[1] | more[2];
        let by = |x: i32| i32x8::splat(simd, x);
        let slot = (low[0] + low[1] * by(BESIDE) + low[2] * by(BEHIND)) & by(self.last_slot as i32);
        let mut met = Met { one: all.simd_eq(by(0)).to_bitmask(), ..Met::default() };
        slot.store_slice(&mut met.slot);
        for axis in 0..3 {
            low[axis].store_slice(&mut met.low[axis]);
            more[axis].store_slice(&mut met.more[axis]);
        }
        met
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

/// The cells that eight boxes meet.
#[derive(Clone, Copy, Default)]
pub(super) struct Met {
    /// A bit for each that meets only one.
    pub one: u64,
    /// Of these the slots.
    pub slot: [i32; LANES],
    low: [[i32; LANES]; 3],
    more: [[i32; LANES]; 3],
}

impl Met {
    /// Those of one box.
    #[inline(always)]
    pub(super) fn cells(&self, lane: usize) -> Cells {
        let [x, y, z] = &self.more;
        let low = [self.low[0][lane], self.low[1][lane], self.low[2][lane]];
        Cells { low, more: [x[lane] as u32, y[lane] as u32, z[lane] as u32] }
    }
}

impl Cells {
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
