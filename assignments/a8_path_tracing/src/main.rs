//! Assignment 8 as a program.

use a8_path_tracing::{Program, merge, run};
use common::cli;
use std::process::ExitCode;

fn main() -> ExitCode {
    if merge::is_wanted(std::env::args_os()) {
        let program: merge::Program = cli::parse();
        return cli::run(|| merge::run(&program.args));
    }
    let program: Program = cli::parse();
    cli::run(|| run(&program.args))
}
