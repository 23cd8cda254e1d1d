//! The surface area heuristic for large nodes: planes at equal distances.
//!
//! What lies on both sides of each plane is counted exactly, by the bins in which boxes begin
//! and end (Shevtsov, Soupikov & Kapustin, "Highly Parallel Fast KD-tree Construction", 2007);
//! the best of 255 planes across each axis is next to the best of all where there are thousands
//! of boxes, and no events need be sorted and handed down through the upper levels.

use super::reference::Reference;
use super::sah::{Split, Sweep};
use common::math::Bounds;

/// Parts between the planes.
const BINS: usize = 256;

/// Weights of the boxes that begin and that end in each bin.
type Ends = [[u32; 2]; BINS];

/// The cheapest of the planes; `None` if there is none in the box.
pub fn cheapest_split(
    references: &[Reference],
    bounds: &Bounds,
    weight: impl Fn(&Reference) -> u32,
) -> Option<Split> {
    let scale = [0, 1, 2].map(|axis| BINS as f32 / (bounds.max[axis] - bounds.min[axis]));
    let mut ends = [[[0; 2]; BINS]; 3];
    let mut total = 0;
    for reference in references {
        let weight = weight(reference);
        total += weight;
        for (axis, ends) in ends.iter_mut().enumerate() {
            for (end, corner) in [reference.bounds.min, reference.bounds.max].iter().enumerate() {
                let bin = ((corner[axis] - bounds.min[axis]) * scale[axis]) as i32;
                ends[bin.clamp(0, BINS as i32 - 1) as usize][end] += weight;
            }
        }
    }
    (0..3)
        .filter_map(|axis| cheapest(&ends[axis], bounds, axis, total))
        .reduce(|best, split| if split.cost < best.cost { split } else { best })
}

fn cheapest(ends: &Ends, bounds: &Bounds, axis: usize, total: u32) -> Option<Split> {
    let (low, high) = (bounds.min[axis], bounds.max[axis]);
    let sweep = Sweep::new(bounds, axis);
    let (mut left, mut right) = (0, total);
    let mut best: Option<Split> = None;
    for (bin, [begun, ended]) in ends.iter().enumerate() {
        (left, right) = (left + begun, right - ended);
        let share = (bin + 1) as f64 / BINS as f64;
        let at = (f64::from(low) * (1.0 - share) + f64::from(high) * share) as f32;
        let cost = sweep.cost(at, left, right);
        if low < at && at < high && cost.is_finite() && best.is_none_or(|b| cost < b.cost) {
            best = Some(Split { axis, at, planar_left: true, cost });
        }
    }
    best
}
