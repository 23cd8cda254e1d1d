//! Assignment 9 as a program.

use std::process::ExitCode;

fn main() -> ExitCode {
    let program: a9_simplification::Program = common::cli::parse();
    common::cli::run(|| a9_simplification::run(&program.args))
}
