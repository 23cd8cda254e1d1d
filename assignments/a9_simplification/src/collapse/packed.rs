//! Balls with a normal each, eight side by side in half the memory that single precision takes: which of them are near, and
//! do not look where one looks oneself?
//!
//! Places are whole numbers of a fine unit, of which only the last sixteen bits are kept: what is near differs by few, and
//! what is not told apart from it is only asked in vain.

use common::math::Vec3;
use common::math::lanes::{LANES, Stored, Vectors, store};
use common::simd::{Simd, SimdBase, SimdMask, f32x8, i32x8};

/// Places are rounded to single precision, in units of about the box: more than is lost of a distance.
pub(super) const ROUNDING: f32 = 2e-6;
/// More than what is lost of a cosine where a normal is rounded to 1/511, times 511 …
const LOST: f32 = 1.6;
/// … and of a height above its plane, in terms of how far away one is …
const TILT: f32 = 2e-3;
/// … and of either by whole numbers, in units.
const WHOLE: f32 = 4.0;
/// Longest normal whose largest component is 1.
const LONGEST: f32 = 1.74;
/// What is larger, in units, is none of these.
const LARGEST: f32 = 8192.0;
/// So many units at most in a unit of length, so that places remain numbers.
const FINEST: f32 = 1e8;

/// Eight balls, packed: x and y, z and how far they reach.
pub(super) struct Packed {
    xy: [i32; LANES],
    z_reach: [i32; LANES],
    /// A bit for each that is too large to be told from others.
    pub too_large: u64,
}

/// Eight balls, and their numbers.
#[derive(Clone, Copy)]
pub(super) struct Block {
    normals: [i32; LANES],
    xy: [i32; LANES],
    z_reach: [i32; LANES],
    pub numbers: [u32; LANES],
}

/// How places become whole numbers: so many units there are in one of length.
#[derive(Clone, Copy)]
pub(super) struct Scale(f32);

/// What is asked.
#[derive(Clone, Copy)]
pub(super) struct Question {
    at: [i32; 3],
    reach: f32,
    normal: Vec3,
}

impl Scale {
    pub(super) fn new(units: f32) -> Self {
        Self(units.min(FINEST))
    }

    /// Eight balls.
    #[inline(always)]
    pub(super) fn balls<S: Simd>(self, simd: S, middle: Vectors<f32x8<S>>, reach: f32x8<S>) -> Packed {
        let of = |x: f32| f32x8::splat(simd, x);
        let (low, units) = (i32x8::splat(simd, 0xffff), of(self.0));
        let reach = (reach + of(ROUNDING)) * units + of(WHOLE);
        // Not what is no number.
        let is_small = reach.simd_lt(of(LARGEST));
        let x = simd.cvt_i32_f32x8(middle[0] * units);
        let y = simd.cvt_i32_f32x8(middle[1] * units);
        let z = simd.cvt_i32_f32x8(middle[2] * units);
        let (mut xy, mut z_reach) = ([0; LANES], [0; LANES]);
        ((x & low) | (y << 16)).store_slice(&mut xy);
        ((z & low) | (simd.cvt_i32_f32x8(reach) << 16)).store_slice(&mut z_reach);
        Packed { xy, z_reach, too_large: !is_small.to_bitmask() & 0xff }
    }
}

/// What is asked from eight places.
#[derive(Clone, Copy, Default)]
pub(super) struct Questions {
    at: [[i32; LANES]; 3],
    reach: [f32; LANES],
    normal: Stored<f32>,
    /// A bit for each that looks too far.
    pub too_far: u64,
}

impl Scale {
    /// What one asks from eight places, as far as one looks and along normals whose largest component is 1.
    #[inline(always)]
    pub(super) fn questions<S: Simd>(
        self,
        simd: S,
        at: Vectors<f32x8<S>>,
        reach: f32x8<S>,
        normal: Vectors<f32x8<S>>,
    ) -> Questions {
        let of = |x: f32| f32x8::splat(simd, x);
        let reach = (reach + of(ROUNDING)) * of(self.0) + of(WHOLE);
        let too_far = !reach.simd_lt(of(LARGEST)).to_bitmask() & 0xff;
        let mut questions = Questions { normal: store(normal), too_far, ..Questions::default() };
        reach.store_slice(&mut questions.reach);
        for (whole, at) in questions.at.iter_mut().zip(at) {
            simd.cvt_i32_f32x8(at * of(self.0)).store_slice(whole);
        }
        questions
    }
}

impl Questions {
    #[inline(always)]
    pub(super) fn of(&self, lane: usize) -> Question {
        let ([x, y, z], [u, v, w]) = (&self.at, &self.normal);
        let normal = Vec3::new(u[lane], v[lane], w[lane]);
        Question { at: [x[lane], y[lane], z[lane]], reach: self.reach[lane], normal }
    }
}

impl Block {
    /// Without size or normal.
    pub(super) const EMPTY: Self =
        Self { normals: [0; LANES], xy: [0; LANES], z_reach: [0; LANES], numbers: [0; LANES] };

    #[inline(always)]
    pub(super) fn set(&mut self, lane: usize, (number, normal): (u32, u32), balls: &Packed, ball: usize) {
        self.numbers[lane] = number;
        self.xy[lane] = balls.xy[ball];
        self.z_reach[lane] = balls.z_reach[ball];
        self.normals[lane] = normal as i32;
    }

    /// Which of them may be near in the middle and in height above their planes, and not look along the normal.
    #[inline(always)]
    pub(super) fn found<S: Simd>(&self, simd: S, question: &Question) -> u64 {
        let of = |x: f32| f32x8::splat(simd, x);
        let load = |lanes: &[i32; LANES]| i32x8::from_slice(simd, lanes);
        let normals = load(&self.normals);
        let u = simd.cvt_f32_i32x8((normals << 22) >> 22);
        let v = simd.cvt_f32_i32x8((normals << 12) >> 22);
        let w = simd.cvt_f32_i32x8((normals << 2) >> 22);
        let Vec3 { x, y, z } = question.normal;
        let is_against = (u * of(x) + v * of(y) + w * of(z)).simd_le(of(LOST));
        // Most look along it.
        if is_against.to_bitmask() == 0 {
            return 0;
        }
        let (xy, z_reach) = (load(&self.xy), load(&self.z_reach));
        let [x, y, z] = question.at.map(|x| i32x8::splat(simd, x));
        // Differences of sixteen bits, with their signs.
        let x = simd.cvt_f32_i32x8(((xy - x) << 16) >> 16);
        let y = simd.cvt_f32_i32x8(((xy >> 16) - y) << 16 >> 16);
        let z = simd.cvt_f32_i32x8(((z_reach - z) << 16) >> 16);
        let far = simd.cvt_f32_i32x8(z_reach >> 16) + of(question.reach);
        let is_near = (x * x + y * y + z * z).simd_le(far * far);
        let above = (x * u + y * v + z * w) * of(1.0 / 511.0);
        let height = far * of(TILT) + of(LONGEST * question.reach);
        (is_against & is_near & above.abs().simd_le(height)).to_bitmask()
    }
}
