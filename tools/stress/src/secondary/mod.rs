//! accuracy.md, properties 7 and 8: a ray that leaves a surface does not meet it again, and what
//! is closed stays closed.

mod inside;
mod leaving;
mod planes;

pub use inside::{black_box, bounces};
pub use leaving::{ellipsoids, meshes, planes, spheres, triangles};
pub use planes::close_planes;
