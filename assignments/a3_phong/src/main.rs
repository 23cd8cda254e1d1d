//! Assignment 3 as a program.

use std::process::ExitCode;

/// Phong shading, and a tessellated preview drawn with a z-buffer.
#[derive(clap::Parser)]
#[command(
    name = "a3_phong",
    version,
    rename_all = "snake_case",
    after_help = "Example:\n  a3_phong -input scenes/scene3_09_exponent_variations.txt -size 300 300 -output out.tga -preview preview.tga -tessellation 100 50 -gouraud"
)]
struct Program {
    #[command(flatten)]
    args: a3_phong::PhongArgs,
}

fn main() -> ExitCode {
    let program: Program = common::cli::parse();
    common::cli::run(|| a3_phong::run(&program.args))
}
