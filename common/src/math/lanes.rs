//! Vectors of which eight stand side by side: the arithmetic of single ones, step by step.
//!
//! Nothing is fused and nothing is added in another order than `glam` adds, or [`super::sum3`], so
//! each lane has the bits that it would have alone.

use crate::simd::{Select, Simd, SimdBase, SimdFloat, f32x4, f32x8, f64x8};
use std::ops::{Add, Mul, Sub};

/// Lanes.
pub const LANES: usize = 8;

/// Eight vectors, one axis after the other.
pub type Vectors<V> = [V; 3];

/// Eight vectors in memory.
pub type Stored<T> = [[T; LANES]; 3];

/// Eight numbers in double precision.
#[inline(always)]
pub fn widen<S: Simd>(simd: S, v: f32x8<S>) -> f64x8<S> {
    let (low, high) = simd.widen_f32x8(v);
    simd.combine_f64x4(low, high)
}

/// Eight numbers rounded to single precision.
#[inline(always)]
pub fn narrow<S: Simd>(simd: S, v: f64x8<S>) -> f32x8<S> {
    let (low, high) = simd.split_f64x8(v);
    simd.narrow_f64x4(low, high)
}

/// The same for every axis. That of arrays is a call of its own, in which vectors go through memory.
#[inline(always)]
pub fn each<A: Copy, B>(v: Vectors<A>, of: impl Fn(A) -> B) -> Vectors<B> {
    [of(v[0]), of(v[1]), of(v[2])]
}

/// Vectors from memory.
#[inline(always)]
pub fn load<S: Simd>(simd: S, v: &Stored<f32>) -> Vectors<f32x8<S>> {
    each([0, 1, 2], |axis: usize| f32x8::from_slice(simd, &v[axis]))
}

/// Vectors from memory.
#[inline(always)]
pub fn load_wide<S: Simd>(simd: S, v: &Stored<f64>) -> Vectors<f64x8<S>> {
    each([0, 1, 2], |axis: usize| f64x8::from_slice(simd, &v[axis]))
}

/// Vectors to memory.
#[inline(always)]
pub fn store<S: Simd>(v: Vectors<f32x8<S>>) -> Stored<f32> {
    let mut stored = [[0.0; LANES]; 3];
    for axis in 0..3 {
        v[axis].store_slice(&mut stored[axis]);
    }
    stored
}

/// Vectors to memory.
#[inline(always)]
pub fn store_wide<S: Simd>(v: Vectors<f64x8<S>>) -> Stored<f64> {
    let mut stored = [[0.0; LANES]; 3];
    for axis in 0..3 {
        v[axis].store_slice(&mut stored[axis]);
    }
    stored
}

/// Four vectors of four numbers, turned so that the first numbers make one vector, and so on.
#[inline(always)]
pub fn turn<S: Simd>(simd: S, [a, b, c, d]: [f32x4<S>; 4]) -> [f32x4<S>; 4] {
    let (even, odd) = (simd.zip_low_f32x4(a, c), simd.zip_low_f32x4(b, d));
    let (first, second) = (simd.zip_low_f32x4(even, odd), simd.zip_high_f32x4(even, odd));
    let (even, odd) = (simd.zip_high_f32x4(a, c), simd.zip_high_f32x4(b, d));
    [first, second, simd.zip_low_f32x4(even, odd), simd.zip_high_f32x4(even, odd)]
}

/// The least lane of each of four vectors. If there is one that is no number, what comes out means nothing.
#[inline(always)]
pub fn least<S: Simd>(simd: S, vectors: [f32x8<S>; 4]) -> [f32; 4] {
    let [a, b, c, d] = halves(simd, vectors);
    let [a, b, c, d] = turn(simd, [a.0.min(a.1), b.0.min(b.1), c.0.min(c.1), d.0.min(d.1)]);
    *a.min(b).min(c.min(d))
}

/// The greatest.
#[inline(always)]
pub fn greatest<S: Simd>(simd: S, vectors: [f32x8<S>; 4]) -> [f32; 4] {
    let [a, b, c, d] = halves(simd, vectors);
    let [a, b, c, d] = turn(simd, [a.0.max(a.1), b.0.max(b.1), c.0.max(c.1), d.0.max(d.1)]);
    *a.max(b).max(c.max(d))
}

/// Both halves of each of four vectors. Not by `map`, which would be a call of its own.
#[inline(always)]
fn halves<S: Simd>(simd: S, [a, b, c, d]: [f32x8<S>; 4]) -> [(f32x4<S>, f32x4<S>); 4] {
    [simd.split_f32x8(a), simd.split_f32x8(b), simd.split_f32x8(c), simd.split_f32x8(d)]
}

/// The greatest lane of one vector.
#[inline(always)]
pub fn greatest_lane<S: Simd>(simd: S, v: f32x8<S>) -> f32 {
    let (low, high) = simd.split_f32x8(v);
    let [a, b, c, d] = *low.max(high);
    a.max(b).max(c.max(d))
}

/// Sums.
#[inline(always)]
pub fn add<V: Copy + Add<Output = V>>(a: Vectors<V>, b: Vectors<V>) -> Vectors<V> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// Differences.
#[inline(always)]
pub fn subtract<V: Copy + Sub<Output = V>>(a: Vectors<V>, b: Vectors<V>) -> Vectors<V> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Vectors times numbers.
#[inline(always)]
pub fn scale<V: Copy + Mul<Output = V>>(a: Vectors<V>, by: V) -> Vectors<V> {
    [a[0] * by, a[1] * by, a[2] * by]
}

/// Products, axis by axis.
#[inline(always)]
pub fn multiply<V: Copy + Mul<Output = V>>(a: Vectors<V>, b: Vectors<V>) -> Vectors<V> {
    [a[0] * b[0], a[1] * b[1], a[2] * b[2]]
}

/// Dot products.
#[inline(always)]
pub fn dot<V: Copy + Add<Output = V> + Mul<Output = V>>(a: Vectors<V>, b: Vectors<V>) -> V {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// [`super::sum3`].
#[inline(always)]
pub fn sum3<S: Simd>([x, y, z]: Vectors<f64x8<S>>) -> f64x8<S> {
    let (a, b, c) = ((x + y) + z, (y + z) + x, (z + x) + y);
    let is_first = a.simd_lt(b);
    let (low, high) = (is_first.select(a, b), is_first.select(b, a));
    let capped = high.simd_lt(c).select(high, c);
    low.simd_gt(capped).select(low, capped)
}

/// The largest component.
#[inline(always)]
pub fn max_element<S: Simd>([x, y, z]: Vectors<f64x8<S>>) -> f64x8<S> {
    let later = y.simd_gt(z).select(y, z);
    x.simd_gt(later).select(x, later)
}

/// Magnitudes.
#[inline(always)]
pub fn magnitudes<S: Simd>([x, y, z]: Vectors<f64x8<S>>) -> Vectors<f64x8<S>> {
    [x.abs(), y.abs(), z.abs()]
}

/// Vectors made unit; those that have no direction are replaced.
#[inline(always)]
pub fn normalize_or<S: Simd>(simd: S, v: Vectors<f64x8<S>>, instead: Vectors<f64x8<S>>) -> Vectors<f64x8<S>> {
    let inverse = f64x8::splat(simd, 1.0) / dot(v, v).sqrt();
    let good = inverse.simd_gt(f64x8::splat(simd, 0.0)) & inverse.simd_lt(f64x8::splat(simd, f64::INFINITY));
    let unit = scale(v, inverse);
    each([0, 1, 2], |axis: usize| good.select(unit[axis], instead[axis]))
}

/// Vectors made unit that have a direction.
#[inline(always)]
pub fn normalize<S: Simd>(simd: S, v: Vectors<f64x8<S>>) -> Vectors<f64x8<S>> {
    scale(v, f64x8::splat(simd, 1.0) / dot(v, v).sqrt())
}

/// The same in single precision.
#[inline(always)]
pub fn normalize_single<S: Simd>(simd: S, v: Vectors<f32x8<S>>) -> Vectors<f32x8<S>> {
    scale(v, f32x8::splat(simd, 1.0) / dot(v, v).sqrt())
}
