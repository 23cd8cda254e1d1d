//! Pictures of patterns and kernels.

mod kernel;
mod samples;

pub use kernel::kernel_picture;
pub use samples::{SamplesPicture, zoomed};
