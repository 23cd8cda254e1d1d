//! Where to cut a set of boxes in two: the surface area heuristic, estimated in bins.

use super::price::{BINS, Bins, cheapest};
use common::math::Bounds;
use common::simd::{Simd, SimdBase, f32x8};

/// −min.x, −min.y, −min.z, something, max.x, max.y, max.z, something: with the lower corner
/// negated the box around two boxes is the maximum of their lanes, one instruction.
pub type Lanes = [f32; 8];

/// The box of nothing.
pub const NOTHING: Lanes = [f32::NEG_INFINITY; 8];

/// A primitive while the tree is built: its box, and in the fourth lane its position in the
/// caller's array.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub struct Item(pub Lanes);

/// Added to a position so that its bits are a normal, finite `f32` below 2³⁰, which neither
/// slows the vector arithmetic that comes upon it nor traps.
const TAG: u32 = 1.0f32.to_bits();

impl Item {
    /// The item at `index` (below 2³⁰).
    #[inline]
    pub fn new(bounds: &Bounds, index: u32) -> Self {
        let (a, b) = (-bounds.min, bounds.max);
        Self([a.x, a.y, a.z, f32::from_bits(TAG + index), b.x, b.y, b.z, 0.0])
    }

    /// Its position in the caller's array.
    #[inline]
    pub fn index(&self) -> u32 {
        self.0[3].to_bits() - TAG
    }
}

/// Half the surface of a box; 0 for a point.
#[inline(always)]
pub fn half_area(lanes: &Lanes) -> f32 {
    let [x, y, z] = [lanes[4] + lanes[0], lanes[5] + lanes[1], lanes[6] + lanes[2]];
    x * y + y * z + z * x
}

/// The boxes of some boxes and of their doubled centres.
#[inline(always)]
pub fn measure<S: Simd>(simd: S, items: &[Item]) -> [Lanes; 2] {
    let (mut bounds, mut centers) =
        (f32x8::splat(simd, f32::NEG_INFINITY), f32x8::splat(simd, f32::NEG_INFINITY));
    for item in items {
        let lanes = f32x8::load_array_ref(simd, &item.0);
        bounds = bounds.max(lanes);
        centers = centers.max(center(simd, lanes));
    }
    [stored(bounds), stored(centers)]
}

/// The doubled centre of a box, as a box.
#[inline(always)]
pub fn center<S: Simd>(simd: S, lanes: f32x8<S>) -> f32x8<S> {
    let (low, high) = simd.split_f32x8(lanes);
    lanes - simd.combine_f32x4(high, low)
}

#[inline(always)]
pub fn stored<S: Simd>(lanes: f32x8<S>) -> Lanes {
    let mut array = NOTHING;
    lanes.store_slice(&mut array);
    array
}

/// A cut: items whose place along `axis` is below `bin` go to the left.
#[derive(Clone, Copy, Debug)]
pub struct Cut {
    axis: usize,
    bin: f32,
    low: f32,
    scale: f32,
    /// How many items are on the left.
    pub left: usize,
    /// The boxes of both sides.
    pub bounds: [Lanes; 2],
}

impl Cut {
    /// Whether an item goes to the left.
    #[inline(always)]
    pub fn is_left(&self, item: &Item) -> bool {
        (item.0[4 + self.axis] - item.0[self.axis] - self.low) * self.scale < self.bin
    }
}

/// Where bins begin and how many there are to a unit of length, along each axis; the other lanes
/// are 0.
struct Grid {
    low: Lanes,
    scale: Lanes,
}

impl Grid {
    /// `None` if `centers` is a point, or too large for arithmetic. An axis along which nothing
    /// can be told apart has scale 0.
    fn over(centers: &Lanes) -> Option<Self> {
        let mut grid = Self { low: [0.0; 8], scale: [0.0; 8] };
        for axis in 0..3 {
            let size = centers[4 + axis] + centers[axis];
            // The largest f32 below BINS keeps the last centre inside the last bin.
            let scale = BINS as f32 * 0.999_999 / size;
            if !size.is_finite() {
                return None;
            }
            if size > 0.0 && scale.is_finite() {
                (grid.low[axis], grid.scale[axis]) = (-centers[axis], scale);
            }
        }
        grid.scale.iter().any(|scale| *scale > 0.0).then_some(grid)
    }
}

/// The best cut of `items` whose doubled centres lie in `centers`; `None` if all centres are one
/// point. 2^`shift` items cost as much as one.
#[inline(always)]
pub fn best_cut<S: Simd>(simd: S, items: &[Item], centers: &Lanes, shift: u32) -> Option<Cut> {
    let grid = Grid::over(centers)?;
    let mut bins = [Bins { bounds: [NOTHING; BINS], count: [0; BINS] }; 3];
    fill(simd, items, &grid, &mut bins);
    let (mut best, mut found) = (f32::INFINITY, None);
    for (axis, bins) in bins.iter().enumerate() {
        if grid.scale[axis] > 0.0 {
            let (cost, bin) = cheapest(simd, bins, shift);
            if cost < best {
                (best, found) = (cost, Some((axis, bin)));
            }
        }
    }
    let (axis, bin) = found?;
    let (below, above) = bins[axis].bounds.split_at(bin);
    Some(Cut {
        axis,
        bin: bin as f32,
        low: grid.low[axis],
        scale: grid.scale[axis],
        left: bins[axis].count[..bin].iter().sum::<u32>() as usize,
        bounds: [around(simd, below), around(simd, above)],
    })
}

#[inline(always)]
fn fill<S: Simd>(simd: S, items: &[Item], grid: &Grid, bins: &mut [Bins; 3]) {
    let (low, _) = simd.split_f32x8(f32x8::load_array_ref(simd, &grid.low));
    let (scale, _) = simd.split_f32x8(f32x8::load_array_ref(simd, &grid.scale));
    for item in items {
        let lanes = f32x8::load_array_ref(simd, &item.0);
        let (minus_min, max) = simd.split_f32x8(lanes);
        let mut place = [0; 4];
        simd.cvt_i32_f32x4((max - minus_min - low) * scale).store_slice(&mut place);
        for axis in 0..3 {
            let (bins, bin) = (&mut bins[axis], place[axis] as usize % BINS);
            bins.count[bin] += 1;
            f32x8::load_array_ref(simd, &bins.bounds[bin]).max(lanes).store_slice(&mut bins.bounds[bin]);
        }
    }
}

/// The box around some boxes.
#[inline(always)]
fn around<S: Simd>(simd: S, boxes: &[Lanes]) -> Lanes {
    let mut around = f32x8::splat(simd, f32::NEG_INFINITY);
    for lanes in boxes {
        around = around.max(f32x8::load_array_ref(simd, lanes));
    }
    stored(around)
}

#[cfg(test)]
mod tests {
    use super::*;
    use common::math::Vec3;
    use common::simd::{dispatch, level};

    /// What is left and right of a cut is what it says, and no bin of any axis cuts cheaper.
    #[test]
    fn a6t2_the_best_of_all_cuts() {
        let random = |i: usize, k: usize| ((i * (17 + 8 * k) + i * i * (5 + k)) % 251) as f32;
        let item = |i: usize| {
            let min = Vec3::from([0, 1, 2].map(|k| random(i, k)));
            Item::new(&Bounds { min, max: min + Vec3::new(9.0, 1.0, (i % 5) as f32) }, i as u32)
        };
        let items: Vec<Item> = (0..300).map(item).collect();
        let [bounds, centers] = dispatch!(level(), s => measure(s, &items));
        assert!(items.iter().enumerate().all(|(i, item)| item.index() == i as u32));
        let found = dispatch!(level(), s => best_cut(s, &items, &centers, 3)).unwrap();
        let grid = Grid::over(&centers).unwrap();
        let cost = |cut: &Cut| {
            let (left, right): (Vec<Item>, Vec<Item>) = items.iter().partition(|item| cut.is_left(item));
            let of = |side: &[Item]| dispatch!(level(), s => measure(s, side))[0];
            let cost = |side: &[Item]| half_area(&of(side)) * side.len().div_ceil(8) as f32;
            (cost(&left) + cost(&right), left.len(), [of(&left), of(&right)])
        };
        let (least, left, sides) = cost(&found);
        assert_eq!(left, found.left);
        assert!((0..8).filter(|k| k % 4 < 3).all(|k| (0..2).all(|s| sides[s][k] == found.bounds[s][k])));
        assert!(least < half_area(&bounds) * 38.0);
        for (axis, bin) in (0..3).flat_map(|axis| (1..BINS).map(move |bin| (axis, bin))) {
            let (low, scale) = (grid.low[axis], grid.scale[axis]);
            let cut = Cut { axis, bin: bin as f32, low, scale, ..found };
            let (cost, left, _) = cost(&cut);
            assert!(left == 0 || left == items.len() || cost >= least);
        }
    }
}
