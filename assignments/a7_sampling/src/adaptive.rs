//! A7T6: samples where the picture still has error.

/// Most samples of a pixel if no other number is given.
pub const MOST_SAMPLES: u32 = 1024;
