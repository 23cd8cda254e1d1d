//! Assignment 6: trees that find hits in logarithmic time.

pub mod bvh;
