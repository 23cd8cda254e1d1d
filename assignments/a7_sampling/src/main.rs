//! Assignment 7 as a program.

use std::process::ExitCode;

fn main() -> ExitCode {
    let program: a7_sampling::Program = common::cli::parse();
    common::cli::run(|| a7_sampling::run(&program.args))
}
