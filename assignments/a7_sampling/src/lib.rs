//! Assignment 7: many rays for a pixel.
//!
//! A pixel is a small area and a moment of exposure, a lens is an opening, a lamp has a size: a
//! picture is an average over all of these. [`sampler`] chooses what to ask, [`filter`] and
//! [`film`] add up the answers, [`Exposure`] does both for a whole picture. [`light`] and
//! [`aperture`] turn coordinates into points of lamps and lenses.

pub mod adaptive;
pub mod aperture;
mod args;
mod exposure;
pub mod film;
pub mod filter;
pub mod light;
mod motion;
mod picture;
mod plan;
pub mod sampler;
mod shoot;
mod smooth;

pub use adaptive::{Adaptive, Survey};
pub use args::{EffectArgs, Program, SamplingArgs};
pub use exposure::{Exposure, Sample, Shade, Watch};
pub use film::{Negative, Shares};
pub use filter::{Kernel, KernelName};
pub use motion::MotionArgs;
pub use picture::{SamplesPicture, counts_picture, kernel_picture};
pub use plan::{FilterArgs, PatternArgs};
pub use sampler::{Pattern, Sampler};
pub use shoot::{Sampled, SoftWhitted, run};
pub use smooth::smoothed;
