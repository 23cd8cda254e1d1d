//! Placeholder.

pub mod property;
