//! Assignment 3 as a program.

use std::process::ExitCode;

fn main() -> ExitCode {
    let program: a3_phong::Program = common::cli::parse();
    common::cli::run(|| a3_phong::run(&program.args))
}
