//! A bounding volume hierarchy, eight children wide.
//!
//! Built as a binary tree by the binned surface area heuristic (Wald, "On fast Construction of
//! SAH-based Bounding Volume Hierarchies", 2007), then collapsed so that one vector test asks
//! eight boxes at once (Dammertz, Hanika & Keller 2008; Wald, Benthin & Boulos 2008). Leaves are
//! blocks of eight triangles, as the list has them.

mod binary;
mod bundle;
mod frustum;
pub(crate) mod packet;
pub(crate) mod single;
mod split;
pub(crate) mod stack;
mod traverse;
mod validate;
pub(crate) mod wide;

pub use binary::{Binary, BinaryNode};
pub use wide::Bvh;
