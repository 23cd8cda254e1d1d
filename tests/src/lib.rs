//! What the tests of whole programs share.
//!
//! * [`CommandLine`]: the course's command lines, read from `tests/commands`;
//! * [`program`]: runs one of them inside the test process, its pictures in a folder of choice;
//! * [`mod@reference`]: draws the same pictures with the double-precision oracle, and keeps them in
//!   `tests/references`;
//! * [`chance`]: what pictures of random samples must look like;
//! * [`stage`]: renders scenes through any structure, for comparisons to the last bit;
//! * [`binary`] and [`mod@battery`]: run the real programs, on good and on hostile input. The
//!   `tests/cli.rs` of every assignment uses them.

pub mod battery;
pub mod binary;
pub mod chance;
mod command_line;
pub mod cost;
pub mod program;
pub mod reference;
pub mod stage;

pub use command_line::{CommandLine, Picture, PictureKind};

use std::path::{Path, PathBuf};

/// A file of the workspace, given relative to its root.
pub fn workspace_file(path: impl AsRef<Path>) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path)
}
