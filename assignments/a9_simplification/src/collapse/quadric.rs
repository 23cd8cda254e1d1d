//! Squared distances to planes, summed: symmetric 3×3 matrices.

use common::math::DVec3;

/// A symmetric 3×3 matrix: xx, xy, xz, yy, yz, zz.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Symmetric(pub [f64; 6]);

impl Symmetric {
    /// w·n·nᵀ.
    #[inline(always)]
    pub(super) fn outer(n: DVec3, w: f64) -> Self {
        let m = n * w;
        Self([m.x * n.x, m.x * n.y, m.x * n.z, m.y * n.y, m.y * n.z, m.z * n.z])
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
        let ix = 1.0 / xx;
        let (lyx, lzx) = (xy * ix, xz * ix);
        let iy = 1.0 / (yy - lyx * xy);
        let vyz = yz - lyx * xz;
        let lzy = vyz * iy;
        let iz = 1.0 / (zz - lzx * xz - lzy * vyz);
        let ry = r.y - lyx * r.x;
        let rz = r.z - lzx * r.x - lzy * ry;
        let z = rz * iz;
        let y = ry * iy - lzy * z;
        DVec3::new(r.x * ix - lyx * y - lzx * z, y, z)
    }
}

impl std::ops::Add for Symmetric {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] + other.0[i]))
    }
}

impl std::ops::AddAssign for Symmetric {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}
