//! A7T2: how samples near a pixel add up to its colour.

mod bell;
mod kernel;

pub use kernel::{Kernel, KernelName, MOST_RADIUS};
