//! Squared distances to planes and lines, summed: symmetric 3×3 matrices.

use common::math::DVec3;
use std::ops::{Add, AddAssign, Mul, SubAssign};

/// A symmetric 3×3 matrix: xx, xy, xz, yy, yz, zz. Aligned so that it lies in one cache line.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(align(64))]
pub(super) struct Symmetric(pub [f64; 6]);

impl Symmetric {
    /// w·n·nᵀ: for a unit vector n and a plane through the origin across n, w times the squared
    /// distance to the plane.
    #[inline(always)]
    pub(super) fn outer(n: DVec3, w: f64) -> Self {
        let m = n * w;
        Self([m.x * n.x, m.x * n.y, m.x * n.z, m.y * n.y, m.y * n.z, m.z * n.z])
    }

    /// w times the squared distance to the line through the origin along e, times |e|².
    pub(super) fn line(e: DVec3, w: f64) -> Self {
        let mut sum = Self::outer(e, -w);
        sum.add_diagonal(w * e.length_squared());
        sum
    }

    /// In single precision.
    #[inline(always)]
    pub(super) fn single(&self) -> [f32; 6] {
        self.0.map(|entry| entry as f32)
    }

    /// Times a vector.
    #[inline(always)]
    pub(super) fn times(&self, v: DVec3) -> DVec3 {
        let [xx, xy, xz, yy, yz, zz] = self.0;
        DVec3::new(
            xx * v.x + xy * v.y + xz * v.z,
            xy * v.x + yy * v.y + yz * v.z,
            xz * v.x + yz * v.y + zz * v.z,
        )
    }

    /// vᵀ·A·v.
    #[inline(always)]
    pub(super) fn square(&self, v: DVec3) -> f64 {
        v.dot(self.times(v))
    }

    /// Sum of the diagonal.
    #[inline(always)]
    pub(super) fn trace(&self) -> f64 {
        self.0[0] + self.0[3] + self.0[5]
    }

    /// Adds x to the diagonal.
    #[inline(always)]
    pub(super) fn add_diagonal(&mut self, x: f64) {
        self.0[0] += x;
        self.0[3] += x;
        self.0[5] += x;
    }

    /// The solution y of A·y = r for a positive definite A (L·D·Lᵀ).
    #[inline(always)]
    pub(super) fn solve(&self, r: DVec3) -> DVec3 {
        let [xx, xy, xz, yy, yz, zz] = self.0;
        let inverse_x = 1.0 / xx;
        let (yx, zx) = (xy * inverse_x, xz * inverse_x);
        let inverse_y = 1.0 / (yy - yx * xy);
        let yz_left = yz - yx * xz;
        let zy = yz_left * inverse_y;
        let inverse_z = 1.0 / (zz - zx * xz - zy * yz_left);
        let ry = r.y - yx * r.x;
        let rz = r.z - zx * r.x - zy * ry;
        let z = rz * inverse_z;
        let y = ry * inverse_y - zy * z;
        DVec3::new(r.x * inverse_x - yx * y - zx * z, y, z)
    }
}

impl Add for Symmetric {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] + other.0[i]))
    }
}

impl AddAssign for Symmetric {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Symmetric {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = Self(std::array::from_fn(|i| self.0[i] - other.0[i]));
    }
}

impl Mul<f64> for Symmetric {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        Self(self.0.map(|entry| entry * factor))
    }
}
