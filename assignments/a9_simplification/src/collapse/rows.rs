//! Rows of memory become columns of lanes, a whole row at a time.

use common::math::lanes::LANES;
use common::simd::{Simd, SimdBase, f32x8};

/// Eight rows of sixteen numbers, turned: what is alike stands side by side.
#[inline(always)]
pub(super) fn rows_turned<S: Simd>(simd: S, rows: &[&[f32; 16]; LANES]) -> [f32x8<S>; 16] {
    let [a, b, c, d, e, f, g, h] = half_turned(simd, rows, 0);
    let [i, j, k, l, m, n, o, p] = half_turned(simd, rows, LANES);
    [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p]
}

#[inline(always)]
fn half_turned<S: Simd>(simd: S, rows: &[&[f32; 16]; LANES], from: usize) -> [f32x8<S>; LANES] {
    let mut turned = [f32x8::splat(simd, 0.0); LANES];
    for lane in 0..LANES {
        turned[lane] = f32x8::from_slice(simd, &rows[lane][from..from + LANES]);
    }
    self::turned(simd, turned)
}

/// Eight rows of eight numbers, turned: columns become rows.
#[inline(always)]
pub(super) fn turned<S: Simd>(simd: S, rows: [f32x8<S>; LANES]) -> [f32x8<S>; LANES] {
    shuffled(simd, shuffled(simd, shuffled(simd, rows)))
}

/// The first half of the rows, each between its entries those of one of the other half: a third of the way to turn them.
#[inline(always)]
fn shuffled<S: Simd>(simd: S, [a, b, c, d, e, f, g, h]: [f32x8<S>; LANES]) -> [f32x8<S>; LANES] {
    [
        simd.zip_low_f32x8(a, e),
        simd.zip_high_f32x8(a, e),
        simd.zip_low_f32x8(b, f),
        simd.zip_high_f32x8(b, f),
        simd.zip_low_f32x8(c, g),
        simd.zip_high_f32x8(c, g),
        simd.zip_low_f32x8(d, h),
        simd.zip_high_f32x8(d, h),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use common::simd::{self, dispatch};

    #[inline(always)]
    fn columns<S: Simd>(simd: S, rows: &[&[f32; 16]; LANES]) -> [[f32; LANES]; 16] {
        let mut columns = [[0.0; LANES]; 16];
        for (column, lanes) in columns.iter_mut().zip(rows_turned(simd, rows)) {
            lanes.store_slice(column);
        }
        columns
    }

    #[test]
    fn what_is_alike_stands_side_by_side() {
        let rows: [[f32; 16]; LANES] =
            std::array::from_fn(|row| std::array::from_fn(|i| (100 * row + i) as f32));
        let columns = dispatch!(simd::level(), s => columns(s, &rows.each_ref()));
        for (i, column) in columns.iter().enumerate() {
            assert_eq!(*column, std::array::from_fn(|row| (100 * row + i) as f32));
        }
    }
}
