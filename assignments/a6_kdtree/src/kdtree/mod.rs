//! A6T1: kd-trees. Space is cut in two by planes across the axes, again and again.
//!
//! Three rules say where to cut ([`Rule`]); the tree, its traversal and its checks are the same
//! for all. The third rule, the surface area heuristic, is built in O(n log n) as Wald & Havran
//! describe ("On building fast kd-Trees for Ray Tracing, and on doing that in O(N log N)",
//! 2006): events are sorted once and kept sorted, triangles are clipped to the nodes. The few
//! nodes of thousands choose among planes at equal distances, before anything is sorted.

mod ask;
mod build;
mod clip;
mod coarse;
mod current;
mod event;
mod flow;
mod leaf;
mod lists;
mod pile;
mod plan;
mod query;
mod reference;
mod rule;
mod sah;
mod stack;
mod sweep;
mod traverse;
mod tree;
mod validate;

pub(crate) use clip::halves;
pub use rule::{MAX_DEPTH, Options, Rule};
pub use sah::{MET, STEP};
pub use tree::{KdTree, Node, Summary};
