//! Assignment 1 as a program.

use std::process::ExitCode;

fn main() -> ExitCode {
    let program: a1_ray_casting::Program = common::cli::parse();
    common::cli::run(|| a1_ray_casting::run(&program.args))
}
