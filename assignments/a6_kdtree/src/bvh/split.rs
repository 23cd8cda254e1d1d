//! Where to cut a set of boxes in two: the surface area heuristic, estimated in bins.

use common::math::{Bounds, Vec3};

/// Bins along each axis.
const BINS: usize = 16;

/// A primitive while the tree is built.
#[derive(Clone, Copy, Debug)]
pub struct Item {
    /// Its box.
    pub bounds: Bounds,
    /// Its position in the caller's array.
    pub index: u32,
}

impl Item {
    /// Twice the centre of its box.
    #[inline]
    pub fn center2(&self) -> Vec3 {
        self.bounds.min + self.bounds.max
    }
}

/// Half the surface of a box; 0 for a point.
#[inline]
pub fn half_area(bounds: &Bounds) -> f32 {
    let s = bounds.size();
    s.x * s.y + s.y * s.z + s.z * s.x
}

/// A cut: items whose bin along `axis` is below `bin` go to the left.
#[derive(Clone, Copy, Debug)]
pub struct Cut {
    axis: usize,
    bin: usize,
    low: f32,
    scale: f32,
}

impl Cut {
    /// Whether an item goes to the left.
    #[inline]
    pub fn is_left(&self, item: &Item) -> bool {
        bin_of(item.center2()[self.axis], self.low, self.scale) < self.bin
    }
}

#[inline]
fn bin_of(center: f32, low: f32, scale: f32) -> usize {
    (((center - low) * scale) as usize).min(BINS - 1)
}

/// Boxes and numbers of the items in each bin of one axis.
#[derive(Clone, Copy)]
struct Bins {
    bounds: [Bounds; BINS],
    count: [u32; BINS],
}

const EMPTY: Bins = Bins { bounds: [Bounds::EMPTY; BINS], count: [0; BINS] };

/// The best cut of `items` whose doubled centres lie in `centers`; `None` if all centres are one
/// point. `block` items cost as much as one.
pub fn best_cut(items: &[Item], centers: &Bounds, block: f32) -> Option<Cut> {
    let size = centers.size();
    // The largest f32 below BINS keeps the last centre inside the last bin.
    let scale = Vec3::splat(BINS as f32 * 0.999_999) / size;
    let mut bins = [EMPTY; 3];
    for item in items {
        let center = item.center2();
        for axis in 0..3 {
            let bin = bin_of(center[axis], centers.min[axis], scale[axis]);
            bins[axis].count[bin] += 1;
            bins[axis].bounds[bin] = bins[axis].bounds[bin].union(&item.bounds);
        }
    }
    (0..3)
        .filter(|&axis| size[axis] > 0.0 && scale[axis].is_finite())
        .flat_map(|axis| cuts_of(&bins[axis], block).map(move |(bin, cost)| (axis, bin, cost)))
        .reduce(|best, cut| if cut.2 < best.2 { cut } else { best })
        .map(|(axis, bin, _)| Cut { axis, bin, low: centers.min[axis], scale: scale[axis] })
}

/// The cost of cutting before each bin, for cuts that leave both sides something.
fn cuts_of(bins: &Bins, block: f32) -> impl Iterator<Item = (usize, f32)> + '_ {
    let mut right = [(0.0, 0u32); BINS];
    let (mut bounds, mut count) = (Bounds::EMPTY, 0);
    for bin in (1..BINS).rev() {
        bounds = bounds.union(&bins.bounds[bin]);
        count += bins.count[bin];
        right[bin] = (half_area(&bounds), count);
    }
    let (mut bounds, mut count) = (Bounds::EMPTY, 0);
    (1..BINS).filter_map(move |bin| {
        bounds = bounds.union(&bins.bounds[bin - 1]);
        count += bins.count[bin - 1];
        let (right_area, right_count) = right[bin];
        let blocks = |items: u32| (items as f32 / block).ceil();
        let cost = half_area(&bounds) * blocks(count) + right_area * blocks(right_count);
        (count > 0 && right_count > 0).then_some((bin, cost))
    })
}
