//! What cuts cost, four at a time.

use super::split::Lanes;
use common::math::lanes::turn;
use common::simd::{Simd, SimdBase, f32x4, f32x8, i32x4};

/// Bins along each axis. Half as many for sets of up to 64 would save a tenth of the time, and
/// cost 3 % more memory and ½ % more nodes on the way of a ray.
pub const BINS: usize = 16;

/// As many cuts are priced at a time.
const GROUP: usize = 4;

/// Boxes and numbers of the items in each bin of one axis.
#[derive(Clone, Copy)]
pub struct Bins {
    /// Boxes around the items.
    pub bounds: [Lanes; BINS],
    /// How many they are.
    pub count: [u32; BINS],
}

/// The cost of the cheapest cut and the bin before which it is; ∞ if all are in one bin.
#[inline(always)]
pub fn cheapest<S: Simd>(simd: S, bins: &Bins, shift: u32) -> (f32, usize) {
    let (mut right, mut right_count) = ([0.0; BINS], [0; BINS]);
    let (mut around, mut count) = (f32x8::splat(simd, f32::NEG_INFINITY), 0);
    for first in (0..BINS).step_by(GROUP).rev() {
        let mut boxes = [around; GROUP];
        for bin in (first..first + GROUP).rev() {
            around = around.max(f32x8::load_array_ref(simd, &bins.bounds[bin]));
            count += bins.count[bin];
            (boxes[bin - first], right_count[bin]) = (around, count as i32);
        }
        half_areas(simd, boxes).store_slice(&mut right[first..first + GROUP]);
    }
    let all = i32x4::splat(simd, count as i32);
    let (mut around, mut count) = (f32x8::splat(simd, f32::NEG_INFINITY), 0);
    let mut best = (f32::INFINITY, 0);
    for first in (0..BINS).step_by(GROUP) {
        let (mut boxes, mut counts) = ([around; GROUP], [0; GROUP]);
        for bin in first..first + GROUP {
            (boxes[bin - first], counts[bin - first]) = (around, count as i32);
            around = around.max(f32x8::load_array_ref(simd, &bins.bounds[bin]));
            count += bins.count[bin];
        }
        let left = i32x4::from_slice(simd, &counts);
        let of_right =
            f32x4::from_slice(simd, &right[first..first + GROUP]) * blocks(simd, all - left, shift);
        let cost = half_areas(simd, boxes) * blocks(simd, left, shift) + of_right;
        let mut costs = [0.0; GROUP];
        cost.store_slice(&mut costs);
        for (bin, cost) in (first..).zip(costs) {
            // Nothing on one side is no cut, whatever it costs.
            if cost < best.0 && counts[bin - first] > 0 && right_count[bin] > 0 {
                best = (cost, bin);
            }
        }
    }
    best
}

/// How many blocks each of some numbers of items takes.
#[inline(always)]
fn blocks<S: Simd>(simd: S, items: i32x4<S>, shift: u32) -> f32x4<S> {
    simd.cvt_f32_i32x4((items + i32x4::splat(simd, (1 << shift) - 1)) >> shift)
}

/// [`half_area`] of four boxes.
#[inline(always)]
fn half_areas<S: Simd>(simd: S, [a, b, c, d]: [f32x8<S>; GROUP]) -> f32x4<S> {
    let size = |lanes: f32x8<S>| {
        let (minus_min, max) = simd.split_f32x8(lanes);
        max + minus_min
    };
    let [x, y, z, _] = turn(simd, [size(a), size(b), size(c), size(d)]);
    x * y + y * z + z * x
}
