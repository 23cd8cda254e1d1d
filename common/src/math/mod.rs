//! Vectors, matrices and the arithmetic that decides: the door to glam.
//!
//! Nothing else in the workspace names `glam`; it is replaced by editing this module.

pub mod affine;
pub mod bounds;
pub mod exact;
pub mod interval;

pub use glam::{DMat3, DMat4, DVec3, DVec4, Vec2, Vec3};
