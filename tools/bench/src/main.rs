//! Run time, measured. `cargo run --release -p bench -- pictures`, or `-- kernels`,
//! `-- rays`, `-- trees`, `-- growth`, `-- sampling`, `-- simplify`, `-- stress`; other people's work takes part
//! in `rays` and `simplify` with `cargo run --release -p bench --features peers -- rays`.
//!
//! What is compared is interleaved, so that a busy moment of the machine hits all alike, and
//! medians are printed with their quartiles. Results are verified before anything is timed.
//! Nothing here passes or fails by time.

mod clock;
mod growth;
mod kernels;
mod path;
mod pictures;
mod rays;
mod report;
mod sample;
mod sampling;
mod simplify;
mod stress;
mod trees;
mod truth;
mod world;

use clap::Parser;
use common::cli::{self, AppError};
use std::process::ExitCode;

/// Run time of raysteps: medians of interleaved rounds.
#[derive(Parser)]
#[command(name = "bench", version, rename_all = "snake_case")]
struct Program {
    #[command(subcommand)]
    part: Part,
}

#[derive(clap::Subcommand)]
enum Part {
    /// Whole command lines, from process start to the written picture
    Pictures {
        /// Rounds; every round runs every command line once
        #[arg(long, default_value_t = 31)]
        rounds: usize,
    },
    /// Reading meshes, building grids, tracing rays, one part at a time
    Kernels {
        /// Rounds; every round runs every part once
        #[arg(long, default_value_t = 31)]
        rounds: usize,
    },
    /// Rays per second of every structure, beside what is wrong with its answers
    Rays(rays::Options),
    /// Build time against render time on five views: no tree, kd-trees, hierarchy
    Trees(trees::Options),
    /// Cost of a ray from a thousand to ten million triangles, with a plot
    Growth(growth::Options),
    /// Processor time of simplification against its error, on meshes of every kind
    Simplify(simplify::Options),
    /// Error of pictures against samples and against time: patterns, filters, adaptive sampling
    Sampling(sampling::Options),
    /// Error of path-traced pictures against processor time: integrators, samplers
    Path(path::Options),
    /// The promises of accuracy, tried: what, how often, how near to what is allowed
    Stress(stress::Options),
    /// A trial that failed once more, or one ray through every structure
    Replay(stress::Replay),
    /// One command line of assignment 5, as a process to be timed
    #[command(hide = true)]
    Child {
        /// The command line, without the program's name.
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        args: Vec<String>,
    },
}

fn main() -> ExitCode {
    ::stress::input::serve();
    let program = Program::parse();
    cli::run(|| match program.part {
        Part::Pictures { rounds } => pictures::run(rounds.max(1)),
        Part::Kernels { rounds } => kernels::run(rounds.max(1)),
        Part::Rays(options) => rays::run(&options),
        Part::Trees(options) => trees::run(&options),
        Part::Growth(options) => growth::run(&options),
        Part::Simplify(options) => simplify::run(&options),
        Part::Sampling(options) => sampling::run(&options),
        Part::Path(options) => path::run(&options),
        Part::Stress(options) => stress::run(&options),
        Part::Replay(options) => stress::replay(&options),
        Part::Child { args } => child(args),
    })
}

/// Does what the program `a5_grid` does, then says how much processor time it took.
fn child(args: Vec<String>) -> Result<(), AppError> {
    let words = std::iter::once("a5_grid".to_owned()).chain(args);
    let parsed = cli::try_parse_from::<a5_grid::Program>(words).map_err(|stop| AppError::Usage(stop.text))?;
    a5_grid::run(&parsed.options.args)?;
    cli::say(&format!("cpu_ns {}", clock::process_time()?));
    Ok(())
}
