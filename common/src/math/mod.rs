//! Vectors, matrices and the arithmetic that decides: the door to glam.
//!
//! Nothing else in the workspace names `glam`; it is replaced by editing this module.

pub mod affine;
pub mod bounds;
pub mod exact;
pub mod interval;

pub use affine::Affine;
pub use bounds::Bounds;
pub use glam::{DMat3, DMat4, DVec3, DVec4, Vec2, Vec3};
pub use interval::Interval;

/// Half the distance from 1 to the next `f32`, 2⁻²⁴: the relative error of one rounding.
pub const UNIT_ROUNDOFF: f64 = 1.0 / (1u64 << 24) as f64;

/// x + y + z, adding the largest magnitudes first, so that the result does not depend on the
/// order of the axes: permuting or mirroring a scene gives the same bits.
#[inline]
pub fn sum3(x: f64, y: f64, z: f64) -> f64 {
    let (x, y) = if x.abs() < y.abs() { (y, x) } else { (x, y) };
    let (y, z) = if y.abs() < z.abs() { (z, y) } else { (y, z) };
    let (x, y) = if x.abs() < y.abs() { (y, x) } else { (x, y) };
    (x + y) + z
}

/// Dot product whose bits do not depend on the order of the axes; see [`sum3`].
#[inline]
pub fn dot3(a: DVec3, b: DVec3) -> f64 {
    sum3(a.x * b.x, a.y * b.y, a.z * b.z)
}
