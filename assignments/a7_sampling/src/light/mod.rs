//! A7T5: lights that have an extent.
//!
//! A light of one point throws shadows with sharp edges. One with an extent is partly hidden at
//! the edge of a shadow; how much of it is seen from there is found by asking for points of it,
//! chosen evenly ([`SoftLights`]).

mod cone;
mod emitters;
mod shape;
mod soft;

pub use cone::Cone;
pub use emitters::{Emitters, LightPoint, brightness};
pub use shape::{EmitterShape, ShapePoint, triangle};
pub use soft::{LampsOfSample, SoftLights};
