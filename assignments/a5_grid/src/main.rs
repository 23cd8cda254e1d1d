//! Assignment 5 as a program.

use std::process::ExitCode;

fn main() -> ExitCode {
    let program: a5_grid::Program = common::cli::parse();
    common::cli::run(|| a5_grid::run(&program.args))
}
