//! Möller & Trumbore's test for eight triangles at a time: what our filter must be held against,
//! for it has as many lanes.

use super::kernel::Contender;
use common::math::Vec3;
use common::ray::Ray;
use common::simd::{self, Select, Simd, SimdBase, dispatch, f32x8};

/// Triangles side by side: a corner and the two edges there, `[part][axis][lane]`.
pub struct Lanes {
    blocks: Vec<[[[f32; 8]; 3]; 3]>,
}

type Wide<S> = [f32x8<S>; 3];

impl Lanes {
    /// Packs the triangles; lanes left over hold a triangle without area.
    pub fn new(triangles: &[[Vec3; 3]]) -> Self {
        let pack = |chunk: &[[Vec3; 3]]| {
            let mut block = [[[0.0; 8]; 3]; 3];
            for (lane, [a, b, c]) in chunk.iter().enumerate() {
                for (part, v) in block.iter_mut().zip([*a, *b - *a, *c - *a]) {
                    (0..3).for_each(|axis| part[axis][lane] = v[axis]);
                }
            }
            block
        };
        Self { blocks: triangles.chunks(8).map(pack).collect() }
    }

    #[inline(always)]
    fn nearest_in<S: Simd>(&self, simd: S, ray: &Ray) -> f64 {
        let infinity = f32x8::splat(simd, f32::INFINITY);
        let mut best = infinity;
        for block in &self.blocks {
            best = best.min(test(simd, block, ray, 0.0, f32::INFINITY));
        }
        let mut lanes = [0.0; 8];
        best.store_slice(&mut lanes);
        f64::from(lanes.into_iter().fold(f32::INFINITY, f32::min))
    }

    #[inline(always)]
    fn crossings_in<S: Simd>(&self, simd: S, ray: &Ray, found: &mut Vec<f64>) {
        for block in &self.blocks {
            let mut lanes = [0.0; 8];
            test(simd, block, ray, f32::NEG_INFINITY, f32::INFINITY).store_slice(&mut lanes);
            found.extend(lanes.into_iter().filter(|t| t.is_finite()).map(f64::from));
        }
    }
}

/// t of every lane that is hit between `min` and `max`, +∞ of the others.
#[inline(always)]
fn test<S: Simd>(simd: S, block: &[[[f32; 8]; 3]; 3], ray: &Ray, min: f32, max: f32) -> f32x8<S> {
    let (a, e, f) = (load(simd, &block[0]), load(simd, &block[1]), load(simd, &block[2]));
    let (o, d) = (splat(simd, ray.origin), splat(simd, ray.direction));
    let (zero, one) = (f32x8::splat(simd, 0.0), f32x8::splat(simd, 1.0));
    let p = cross(d, f);
    let inverse = one / dot(e, p);
    let c = [o[0] - a[0], o[1] - a[1], o[2] - a[2]];
    let q = cross(c, e);
    let (u, v, t) = (dot(c, p) * inverse, dot(d, q) * inverse, dot(f, q) * inverse);
    let inside = u.simd_ge(zero) & v.simd_ge(zero) & (u + v).simd_le(one);
    let counts = t.simd_gt(f32x8::splat(simd, min)) & t.simd_lt(f32x8::splat(simd, max));
    (inside & counts).select(t, f32x8::splat(simd, f32::INFINITY))
}

#[inline(always)]
fn load<S: Simd>(simd: S, part: &[[f32; 8]; 3]) -> Wide<S> {
    [f32x8::from_slice(simd, &part[0]), f32x8::from_slice(simd, &part[1]), f32x8::from_slice(simd, &part[2])]
}

#[inline(always)]
fn splat<S: Simd>(simd: S, v: Vec3) -> Wide<S> {
    [f32x8::splat(simd, v.x), f32x8::splat(simd, v.y), f32x8::splat(simd, v.z)]
}

#[inline(always)]
fn cross<S: Simd>(a: Wide<S>, b: Wide<S>) -> Wide<S> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
fn dot<S: Simd>(a: Wide<S>, b: Wide<S>) -> f32x8<S> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl Contender for Lanes {
    fn name(&self) -> &'static str {
        "Möller–Trumbore, f32 (8 lanes)"
    }

    fn crossings(&self, ray: &Ray, found: &mut Vec<f64>) {
        dispatch!(simd::level(), s => self.crossings_in(s, ray, found));
    }

    fn nearest(&self, ray: &Ray) -> f64 {
        dispatch!(simd::level(), s => self.nearest_in(s, ray))
    }
}
