//! Vectors, matrices and the arithmetic that decides: the door to glam.
//!
//! Nothing else in the workspace names `glam`; it is replaced by editing this module.

pub mod affine;
pub mod bounds;
pub mod circle;
pub mod exact;
pub mod interval;
pub mod lanes;

pub use affine::Affine;
pub use bounds::Bounds;
pub use glam::{DMat3, DMat4, DVec3, DVec4, Vec2, Vec3, Vec3A, Vec4};
pub use interval::Interval;

/// Half the distance from 1 to the next `f32`, 2⁻²⁴: the relative error of one rounding.
pub const UNIT_ROUNDOFF: f64 = 1.0 / (1u64 << 24) as f64;

/// x + y + z, the middle one of the three orders of adding, so that the result does not depend
/// on the order of the axes: permuting or mirroring a scene gives the same bits. Sorting the
/// summands would do too, but mispredicts its branches.
#[inline]
pub fn sum3(x: f64, y: f64, z: f64) -> f64 {
    let (a, b, c) = ((x + y) + z, (y + z) + x, (z + x) + y);
    let (low, high) = if a < b { (a, b) } else { (b, a) };
    let capped = if high < c { high } else { c };
    if low > capped { low } else { capped }
}

/// Dot product whose bits do not depend on the order of the axes; see [`sum3`].
#[inline]
pub fn dot3(a: DVec3, b: DVec3) -> f64 {
    sum3(a.x * b.x, a.y * b.y, a.z * b.z)
}
