//! From an estimator to sums: passes over the picture until it is good enough.
//!
//! A pass gives every pixel some more samples. Between passes the sums can be looked at, written
//! to disk, or gone on with on another day; a pass that is broken off counts for nothing. How
//! samples are dealt out to passes changes no bit.

mod estimator;
mod pace;
mod pass;
mod rendering;
mod schedule;
mod spared;

pub use estimator::Estimator;
pub use pace::Pace;
pub use rendering::{End, Rendering, Tally};
pub use schedule::Goal;
pub use spared::{spared, trace_spared};
