//! Sums of samples that do not depend on the order of adding.
//!
//! A picture is a mean, and a mean that is computed in parts, by many threads or machines, or with
//! a night between the parts, should be that of one go, to the bit. [`fixed`] numbers can be added
//! in any order; [`Sums`] holds them for all pixels of a [`Frame`], [`join`] puts parts together,
//! [`checkpoint`] keeps them in files, [`develop`] makes pictures of them.

pub mod checkpoint;
pub mod develop;
pub mod fixed;
pub mod identity;
pub mod join;
mod layout;
mod sums;
mod survey;

pub use identity::Identity;
pub use layout::{Aov, Layout};
pub use sums::{Frame, MAX_SAMPLES, Patch, Sums, TooLarge};
