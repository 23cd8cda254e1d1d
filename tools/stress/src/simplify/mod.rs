//! accuracy.md, property 17: simplification keeps what is whole, and says what is not.

mod hostile;
mod shapes;
mod whole;

pub use hostile::{named, soups};
pub use whole::whole;

use a9_simplification::Method;

/// Every way to simplify.
const METHODS: [Method; 3] = [Method::Qem, Method::Memoryless, Method::Melax];
