//! The numbered promises of `accuracy.md` as checks: the test command runs them briefly
//! (`tests/quick`), `bench -- stress` at length.
//!
//! * [`properties()`] is the registry; each check is a plain function of a [`Stress`], which says
//!   how much to do and keeps the [`Row`]s that are found;
//! * [`survey()`] runs them, [`again`] runs one trial that failed once more;
//! * [`kit`] has what checks share: random rays, closed meshes, exact oracles;
//! * the other modules hold the checks, by what they are about.
//!
//! The oracles decide with unbounded integers ([`kit::Dyadic`]) and share no arithmetic with the
//! core. A trial is one ray (or one shape, one text) with a stream of random numbers of its own,
//! so the first failure is a reproducer already; it is printed in bits.
//! `PROPERTY_FACTOR=30` runs thirty times as many trials, `PROPERTY_SEED=7` runs others.

pub mod kit;
mod registry;
mod row;
mod stress;
mod survey;
mod tier;

mod builds;
mod determinism;
pub mod input;
pub mod light;
mod march;
mod pixels;
mod round;
mod secondary;
mod simplify;
mod structures;
mod transforms;
mod values;
mod watertight;

pub use registry::{Property, properties};
pub use row::{Failure, Row};
pub use stress::{Single, Stress, panic_words};
pub use survey::{again, examine, is_chosen, survey};
pub use tier::{Tier, Trials};

/// The seed that the environment asks for (`PROPERTY_SEED`), else the usual one.
pub fn seed_of_environment() -> u64 {
    stress::setting("PROPERTY_SEED").unwrap_or(0)
}
