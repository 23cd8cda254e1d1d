//! The ground floor: what a scene can say, and the plumbing that every step shares.
//!
//! `common` knows no assignment. It holds the scene format and its data ([`scene`]), meshes
//! ([`mesh`]), geometry prepared for tracing ([`geometry`]) with its intersection tests
//! ([`shape`]), rays and cameras ([`ray`], [`camera`]), the seam every acceleration structure
//! fills ([`accel`]), pictures ([`picture`]), files written whole or not at all ([`atomic`]), the
//! tile loop ([`tiles`]) and the command line ([`cli`]).

pub mod accel;
pub mod atomic;
pub mod camera;
pub mod cli;
pub mod counters;
pub mod geometry;
pub mod math;
pub mod mesh;
pub mod picture;
pub mod ray;
pub mod scene;
pub mod shape;
pub mod simd;
pub mod tiles;
