//! Pictures: the film a program renders into, picture files, and the comparison of two pictures.
//!
//! A [`Film`] holds linear light; what becomes of it in an 8-bit file is decided by [`Transfer`]
//! (the course writes values as they are) and by the one rule in [`quantise`]. Files are checked
//! with [`check_output`] before any work is done, and written whole or not at all by [`write()`].

mod codec;
mod compare;
mod error;
mod film;
mod kind;
mod pfm;
pub mod quantise;
mod read;
mod size;
mod write;

pub use compare::{Comparison, WorstPixel, compare, triptych};
pub use error::PictureError;
pub use film::Film;
pub use kind::Kind;
pub use quantise::Transfer;
pub use read::read;
pub use size::{MAX_PIXELS, Size, SizeError};
pub use write::{check_output, write};

#[cfg(test)]
mod tests;
