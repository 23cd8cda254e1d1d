//! Assignment 1 as a program.

use std::process::ExitCode;

/// Ray casting: the nearest thing along one ray per pixel, in flat colour and as depth.
#[derive(clap::Parser)]
#[command(
    name = "a1_ray_casting",
    version,
    rename_all = "snake_case",
    after_help = "Example:\n  a1_ray_casting -input scenes/scene1_01.txt -size 200 200 -output out.tga -depth 9 10 depth.tga"
)]
struct Program {
    #[command(flatten)]
    args: a1_ray_casting::CastArgs,
}

fn main() -> ExitCode {
    let program: Program = common::cli::parse();
    common::cli::run(|| a1_ray_casting::run(&program.args))
}
