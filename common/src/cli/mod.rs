//! The command line: the course's flags, errors and warnings, progress.
//!
//! Programs describe their flags with clap's derive and parse them with [`parse()`]. The course
//! writes long flags with one dash (`-size 200 200`); clap wants two. The translation, there and
//! back, is done here, so that neither the programs nor their users notice.
//!
//! A struct of flags that flattens a lower assignment's does so after its own fields: clap gives
//! the heading of the flattened struct to every field that follows it.
//!
//! ```no_run
//! use common::cli::{self, AppError, GeneralArgs};
//!
//! /// Renders pictures of spheres.
//! #[derive(clap::Parser)]
//! #[command(version, rename_all = "snake_case")]
//! struct Options {
//!     #[command(flatten, next_help_heading = "Assignment 1")]
//!     picture: PictureArgs,
//!     #[command(flatten)]
//!     general: GeneralArgs,
//! }
//!
//! #[derive(clap::Args)]
//! #[command(rename_all = "snake_case")]
//! struct PictureArgs {
//!     /// Width and height in pixels
//!     #[arg(long, num_args = 2, value_names = ["W", "H"], default_values_t = [100, 100])]
//!     size: Vec<i64>,
//! }
//!
//! fn main() -> std::process::ExitCode {
//!     cli::run(|| {
//!         let options: Options = cli::parse();
//!         let [width, height] = options.picture.size[..] else { unreachable!() };
//!         let size = common::picture::Size::new(width, height)?;
//!         cli::say(&format!("{size}"));
//!         Ok(())
//!     })
//! }
//! ```

mod app;
mod dashes;
mod general;
mod heap;
pub mod interrupt;
mod numbers;
mod output;
mod parse;
mod progress;

pub use app::{AppError, run};
pub use general::{GeneralArgs, ProgramArgs, SimdChoice, Skip};
pub use output::{is_quiet, note, say, set_quiet, warn};
pub use parse::{Parsed, Stop, parse, try_parse_from};
pub use progress::Progress;

#[cfg(test)]
mod tests;
