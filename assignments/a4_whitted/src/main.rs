//! Assignment 4 as a program.

use std::process::ExitCode;

/// Whitted ray tracing: shadows, reflection, refraction.
#[derive(clap::Parser)]
#[command(
    name = "a4_whitted",
    version,
    rename_all = "snake_case",
    after_help = "Example:\n  a4_whitted -input scenes/scene4_04_reflective_sphere.txt -size 200 200 -output out.tga -shadows -bounces 3 -weight 0.01"
)]
struct Program {
    #[command(flatten)]
    args: a4_whitted::WhittedArgs,
}

fn main() -> ExitCode {
    let program: Program = common::cli::parse();
    common::cli::run(|| a4_whitted::run(&program.args))
}
