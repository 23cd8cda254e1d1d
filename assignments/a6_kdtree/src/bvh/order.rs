//! Rays in the order of octants and of cells of space along a Morton curve.

use super::stream::{MANY, OCTANTS};
use common::math::Bounds;
use common::math::lanes::Vectors;
use common::simd::{Select, Simd, SimdBase, f32x8, i32x8};

/// Bits of a cell's place along one axis.
const BITS: u32 = 3;

/// Cells of all octants.
const CELLS: usize = OCTANTS << (3 * BITS);

/// The cells of eight rays: the signs of their directions, then the place of their origins within `bounds`.
#[inline(always)]
pub fn cells_of<S: Simd>(
    simd: S,
    origin: Vectors<f32x8<S>>,
    direction: Vectors<f32x8<S>>,
    bounds: &Bounds,
) -> i32x8<S> {
    let of = |x: f32| f32x8::splat(simd, x);
    let bit = |x: u32| i32x8::splat(simd, x as i32);
    let (size, mut cell) = (bounds.size().max_element(), bit(0));
    for axis in 0..3 {
        // Cells are cubes. Of a flat scene there are fewer, of a point none that counts.
        let scale = ((1 << BITS) as f32 / size).min(f32::MAX);
        let place = (origin[axis] - of(bounds.min[axis])) * of(scale);
        let place = simd.cvt_i32_f32x8(place.max(of(0.0)).min(of(((1 << BITS) - 1) as f32)));
        for i in 0..BITS {
            cell |= (place & bit(1 << i)) << (2 * i + axis as u32);
        }
        let backward = direction[axis].simd_lt(of(0.0));
        cell |= backward.select(bit(1 << (3 * BITS + axis as u32)), bit(0));
    }
    cell
}

/// Which of all rays those are that are to flow.
pub struct Order {
    /// Their numbers in the order of their cells …
    numbers: Vec<u32>,
    /// … of whom so many have flown.
    flown: usize,
    /// Where each octant ends.
    ends: [usize; OCTANTS],
}

impl Order {
    /// Nobody.
    pub const NONE: Self = Self { numbers: Vec::new(), flown: 0, ends: [0; OCTANTS] };

    /// Sorts those that wait, by their numbers and cells, who flow next: nobody waits after that.
    pub fn sort(&mut self, waiting: &mut Vec<(u32, u16)>) {
        let mut ends = [0; CELLS];
        for (_, cell) in &*waiting {
            ends[usize::from(*cell)] += 1;
        }
        // Where each cell starts, which moves to where it ends.
        let mut end = 0;
        for cell in &mut ends {
            (*cell, end) = (end, end + *cell);
        }
        self.numbers.resize(end, 0);
        for (number, cell) in waiting.drain(..) {
            let place = &mut ends[usize::from(cell)];
            self.numbers[*place] = number;
            *place += 1;
        }
        self.ends = std::array::from_fn(|octant| ends[(octant + 1) * (CELLS / OCTANTS) - 1]);
        self.flown = 0;
    }

    /// The numbers of who flows next, and the octant of all of them. All streams of an octant are about equally long.
    pub fn next(&mut self) -> Option<(usize, &[u32])> {
        let first = self.flown;
        let octant = self.ends.iter().position(|end| *end > first)?;
        let left = self.ends[octant] - first;
        self.flown += left.div_ceil(left.div_ceil(MANY));
        Some((octant, &self.numbers[first..self.flown]))
    }
}
