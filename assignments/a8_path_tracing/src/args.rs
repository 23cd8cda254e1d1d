//! The flags of assignment 8, on top of those of assignments 1 to 7.

use crate::path::Integrator;
use a7_sampling::SamplingArgs;

/// Path tracing: all the light there is.
#[derive(clap::Parser)]
#[command(
    name = "a8_path_tracing",
    version,
    rename_all = "snake_case",
    after_help = "Example:\n  a8_path_tracing -input scenes/scene8_01_cornell_box.txt -size 256 256 -output out.png -spp 64"
)]
pub struct Program {
    /// All flags.
    #[command(flatten)]
    pub args: PathArgs,
}

/// Paths.
#[derive(Clone, Debug, clap::Args)]
#[command(rename_all = "snake_case", next_help_heading = "Assignment 8: paths")]
pub struct PathArgs {
    /// Paths per pixel
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(u32::MAX / 2)))]
    pub spp: Option<u32>,

    /// How light is looked for
    #[arg(long, value_name = "NAME", value_enum, default_value_t)]
    pub integrator: Integrator,

    /// Surfaces that a path meets before it may be ended at random
    #[arg(long, value_name = "N", default_value_t = 2)]
    pub rr_depth: u32,

    /// Flags of assignments 1 to 7.
    #[command(flatten)]
    pub sampling: SamplingArgs,
}

/// The whole program.
///
/// # Errors
/// Bad usage, an unreadable scene, an unwritable picture.
pub fn run(_: &PathArgs) -> Result<(), common::cli::AppError> {
    Ok(())
}
