//! accuracy.md, property 15: what a filter makes of samples has the analytic value on average;
//! weights sum to one; and errors fall with the number of samples as fast as each pattern promises.

mod board;
mod coverage;
mod slopes;

pub use board::board;
pub use coverage::{analytic, uniform, weights};
pub use slopes::slopes;

use a7_sampling::Pattern;

/// Patterns with chance in them; the uniform one has none to average over.
const CHANCES: [Pattern; 7] = [
    Pattern::Random,
    Pattern::Jittered,
    Pattern::MultiJittered,
    Pattern::Halton,
    Pattern::R2,
    Pattern::Sobol,
    Pattern::BlueNoise,
];
