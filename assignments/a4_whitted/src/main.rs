//! Assignment 4 as a program.

use std::process::ExitCode;

fn main() -> ExitCode {
    let program: a4_whitted::Program = common::cli::parse();
    common::cli::run(|| a4_whitted::run(&program.args))
}
