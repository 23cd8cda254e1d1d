//! Assignment 6 as a program.

use std::process::ExitCode;

fn main() -> ExitCode {
    let program: a6_kdtree::Program = common::cli::parse();
    common::cli::run(|| a6_kdtree::run(&program.args))
}
