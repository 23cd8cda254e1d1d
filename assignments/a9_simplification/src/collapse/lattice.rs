//! Cubic cells that are found by hashing, so that neither empty space nor a crowded corner of it
//! costs anything.

use common::math::lanes::{LANES, Vectors, scale, subtract};
use common::simd::{Simd, SimdBase, SimdMask, f32x8, i32x8};

/// What meets more cells than this is better held against everything.
const MOST_CELLS: f32 = 1024.0;

/// See [`Lattice::spread`]: in sides of a cell.
const SPREAD: f32 = 0.1;

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

/// Cells in a box: the slot of the lowest, and how many more there are along each axis, ten bits for each.
#[derive(Clone, Copy)]
pub(super) struct Cells {
    slot: i32,
    more: i32,
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

    /// By how much boxes that are sorted into cells are made smaller on every side: who asks looks farther by as much. So
    /// most meet fewer cells.
    #[inline(always)]
    pub(super) fn spread(&self) -> f32 {
        SPREAD / self.fineness
    }

    /// How many slots there are.
    pub(super) fn slots(&self) -> usize {
        self.last_slot + 1
    }

    /// The cells of eight places. What is near zero or very far off shares cells with what is beside it: all that matters is
    /// that numbers never fall along an axis.
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
        let slot = low[0] + low[1] * i32x8::splat(simd, BESIDE) + low[2] * i32x8::splat(simd, BEHIND);
        let one = f32x8::splat(simd, 1.0);
        let [x, y, z] =
            [simd.cvt_f32_i32x8(more[0]), simd.cvt_f32_i32x8(more[1]), simd.cvt_f32_i32x8(more[2])];
        let count = (x + one) * (y + one) * (z + one);
        let mut met =
            Met { many: count.simd_gt(f32x8::splat(simd, MOST_CELLS)).to_bitmask(), ..Met::default() };
        slot.store_slice(&mut met.slot);
        (more[0] | (more[1] << 10) | (more[2] << 20)).store_slice(&mut met.more);
        met
    }

    /// The slots of some cells. Those of neighbours along x are neighbours, too.
    #[inline(always)]
    pub(super) fn slots_of(&self, cells: Cells) -> Slots {
        let more = [cells.more & 1023, cells.more >> 10 & 1023, cells.more >> 20];
        Slots { next: cells.slot, more, left: more, last_slot: self.last_slot, is_over: false }
    }
}

/// See [`Lattice::slots_of`].
pub(super) struct Slots {
    next: i32,
    more: [i32; 3],
    left: [i32; 3],
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
            self.next = self.next.wrapping_add(BESIDE).wrapping_sub(more[0]);
        } else if z_left > 0 {
            self.left = [more[0], more[1], z_left - 1];
            let back = more[1].wrapping_mul(BESIDE).wrapping_add(more[0]);
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
    /// A bit for each that meets so many that it is better not to ask for each.
    pub many: u64,
    slot: [i32; LANES],
    more: [i32; LANES],
}

impl Met {
    /// Those of one box.
    #[inline(always)]
    pub(super) fn cells(&self, lane: usize) -> Cells {
        Cells { slot: self.slot[lane], more: self.more[lane] }
    }
}
