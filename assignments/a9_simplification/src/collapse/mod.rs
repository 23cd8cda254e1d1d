//! Edge collapse: what [`simplify`](crate::simplify()) is made of.
//!
//! ```text
//! weld → build → run (cost, queue, ring, merge, wedges) → snapshot → refit → mend → deviation → mesh
//! ```

mod abreast;
mod accumulated;
mod against;
mod around;
mod banded;
mod build;
mod cells;
mod circle;
mod cost;
mod counted;
mod deviation;
mod drawers;
mod eight;
mod heap;
mod lattice;
mod levels;
mod locate;
mod melax;
mod memoryless;
mod mend;
mod merge;
mod nearby;
mod original;
mod packed;
mod polygon;
mod probes;
mod quadric;
mod queue;
mod refit;
mod rim;
mod ring;
mod rows;
mod run;
#[cfg(test)]
mod scattered;
mod single;
mod snapshot;
mod surely;
mod surface;
mod wedges;
mod weld;
mod witness;

pub(crate) use levels::{Level, Prepared};
