//! Pictures of patterns and kernels.

mod counts;
mod kernel;
mod samples;

pub use counts::counts_picture;
pub use kernel::kernel_picture;
pub use samples::{SamplesPicture, zoomed};
