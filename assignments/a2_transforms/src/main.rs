//! Assignment 2 as a program.

use std::process::ExitCode;

fn main() -> ExitCode {
    let program: a2_transforms::Program = common::cli::parse();
    common::cli::run(|| a2_transforms::run(&program.args))
}
