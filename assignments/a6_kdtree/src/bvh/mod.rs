//! A bounding volume hierarchy, eight children wide.
//!
//! Built by the binned surface area heuristic (Wald, "On fast Construction of SAH-based Bounding
//! Volume Hierarchies", 2007) with eight children to a node, so that one vector test asks eight
//! boxes at once (Dammertz, Hanika & Keller 2008; Wald, Benthin & Boulos 2008). Leaves are blocks
//! of eight triangles, as the list has them.

pub(crate) mod abreast;
mod aside;
mod asking;
mod ball_hits;
mod balls;
pub(crate) mod beam;
mod beside;
mod blocked;
pub(crate) mod build;
pub(crate) mod bundle;
pub(crate) mod children;
mod collapse;
mod crowd;
mod cull;
mod fan;
mod firsts;
pub(crate) mod flow;
mod frustum;
mod horizon;
mod inlet;
pub(crate) mod known;
mod lines;
pub(crate) mod lists;
mod order;
pub(crate) mod packet;
mod pending;
pub(crate) mod pool;
mod price;
pub(crate) mod purpose;
mod queue;
pub(crate) mod record;
mod set;
mod sheets;
pub(crate) mod single;
mod slabs;
mod slot;
mod split;
pub(crate) mod stack;
mod straggler;
pub(crate) mod stream;
mod together;
mod traverse;
pub(crate) mod validate;
pub(crate) mod walk;
pub(crate) mod wide;

pub use wide::Bvh;
