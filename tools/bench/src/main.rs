//! Run time, measured. `cargo run --release -p bench -- all` measures everything and makes a page
//! of it; `-- pictures` and the names below measure one part and print it. Other people's work
//! takes part in `rays` and `simplify` with `cargo run --release -p bench --features peers -- rays`.
//!
//! What is compared is interleaved, so that a busy moment of the machine hits all alike, and
//! medians are printed with their quartiles. Results are verified before anything is timed.
//! Nothing here passes or fails by time.

mod all;
mod child;
mod clock;
mod compare;
mod fit;
mod growth;
mod kernels;
mod numerics;
mod page;
mod part;
mod path;
mod pictures;
mod rays;
mod report;
mod sample;
mod sampling;
mod scaling;
mod simplify;
mod skips;
mod startup;
mod statistics;
mod stress;
mod trees;
mod truth;
mod world;

use clap::Parser;
use common::cli::{self, AppError};
use part::Part;
use std::path::PathBuf;
use std::process::ExitCode;

/// Run time of raysteps: medians of interleaved rounds.
#[derive(Parser)]
#[command(name = "bench", version, rename_all = "snake_case")]
struct Program {
    #[command(subcommand)]
    task: Task,
    /// Writes what a part found, for `bench compare`
    #[arg(long, global = true, value_name = "FILE.csv")]
    results: Option<PathBuf>,
}

#[derive(clap::Subcommand)]
enum Task {
    /// Every part, one after the other: results.csv, figures, and one page that holds all
    All(all::Options),
    /// What moved between two runs, beyond the noise
    Compare(compare::Options),
    #[command(flatten)]
    Part(Part),
    /// A trial that failed once more, or one ray through every structure
    Replay(stress::Replay),
    /// One command line of an assignment, as a process to be timed
    #[command(hide = true)]
    Child {
        /// Again and again until that has taken so many milliseconds
        #[arg(long, default_value_t = 0)]
        least: u64,
        /// The program's name and its arguments.
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        words: Vec<String>,
    },
}

fn main() -> ExitCode {
    // Damaged input is tried by this very program, started again.
    ::stress::input::serve();
    let program = Program::parse();
    cli::run(|| match program.task {
        Task::All(_) | Task::Compare(_) if program.results.is_some() => {
            Err(AppError::Usage("--results is for one part; `bench all` writes to its --out".to_owned()))
        }
        Task::All(options) => all::run(&options),
        Task::Compare(options) => compare::run(&options),
        Task::Part(part) => part::run(&part, program.results.as_deref()),
        Task::Replay(options) => stress::replay(&options),
        Task::Child { least, words } => child::run(&words, least),
    })
}
