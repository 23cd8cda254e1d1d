//! Assignment 5 as a program.

use std::process::ExitCode;

/// A uniform grid: its cells as a picture, and ray tracing through it.
#[derive(clap::Parser)]
#[command(
    name = "a5_grid",
    version,
    rename_all = "snake_case",
    after_help = "Example:\n  a5_grid -input scenes/scene5_09_bunny_mesh_40k.txt -size 200 200 -output out.tga -grid 40 40 33 -visualize_grid"
)]
struct Program {
    #[command(flatten)]
    args: a5_grid::GridArgs,
}

fn main() -> ExitCode {
    let program: Program = common::cli::parse();
    common::cli::run(|| a5_grid::run(&program.args))
}
