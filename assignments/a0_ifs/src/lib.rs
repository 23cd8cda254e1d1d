//! Assignment 0: iterated function systems.
//!
//! A handful of affine maps, each with a probability, is all there is to a fern. [`parse()`] reads
//! them (A0T1), [`ChaosGame`] lets points wander under randomly chosen maps (A0T2), and [`Dots`]
//! is the picture of where they end up (A0T3).

mod affine;
mod chaos;
mod choice;
mod diagnostic;
mod dots;
mod ifs;
mod options;
mod parse;

pub use affine::{Affine2, Point2};
pub use chaos::{ChaosGame, play};
pub use choice::AliasTable;
pub use diagnostic::IfsError;
pub use dots::Dots;
pub use ifs::{Ifs, WeightedMap};
pub use options::Options;
pub use parse::{load, parse};
