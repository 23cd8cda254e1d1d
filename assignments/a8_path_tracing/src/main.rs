//! Assignment 8 as a program.

use std::process::ExitCode;

fn main() -> ExitCode {
    let program: a8_path_tracing::Program = common::cli::parse();
    common::cli::run(|| a8_path_tracing::run(&program.args))
}
