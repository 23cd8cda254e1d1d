//! Where samples are added up.

mod negative;
mod shares;

pub use negative::Negative;
pub use shares::Shares;
