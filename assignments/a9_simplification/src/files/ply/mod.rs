//! PLY files: the door to ply-rs-bw.
//!
//! ```text
//! ply
//! format ascii 1.0
//! element vertex 3
//! property float x
//! property float y
//! property float z
//! element face 1
//! property list uchar int vertex_indices
//! end_header
//! 0 0 0
//! 1 0 0
//! 0 1 0
//! 3 0 1 2
//! ```
//!
//! Of vertices x y z are read, nx ny nz, and texture coordinates by any of their usual names; of
//! faces the list of vertices, as a fan of triangles. All else is skipped.

mod element;
mod read;
mod write;

pub use read::parse;
pub use write::to_bytes;
