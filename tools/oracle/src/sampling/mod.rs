//! Sampling (course rules §7): where samples stand, what they count, and pictures of both.

mod develop;
mod filter;
mod lens;
mod pictures;

pub(crate) use develop::develop;
pub use filter::Filter;
pub(crate) use lens::lens_places;
pub use pictures::{filter_picture, samples_picture};

/// The centres of the `side`² equal squares of the unit square, row by row.
pub(crate) fn grid(side: u32) -> impl Iterator<Item = [f64; 2]> {
    let at = move |i: u32| (f64::from(i) + 0.5) / f64::from(side);
    (0..side).flat_map(move |row| (0..side).map(move |column| [at(column), at(row)]))
}

/// Where the samples of a pixel stand, from its lower left corner, in the order in which they are
/// taken: row by row.
pub fn pixel_places(side: u32) -> Vec<[f64; 2]> {
    grid(side).collect()
}
