//! The command line of `ifs`.

use clap::Parser;
use common::cli::ProgramArgs;
use std::path::PathBuf;

/// Draws the attractor of an iterated function system by the chaos game
#[derive(Debug, Parser)]
#[command(name = "ifs", version, rename_all = "snake_case", after_help = EXAMPLE)]
pub struct Options {
    /// The maps with their probabilities
    #[arg(long, value_name = "FILE", help_heading = HEADING)]
    pub input: PathBuf,

    /// Picture to write: .tga .png .ppm .pfm .exr .hdr
    #[arg(long, value_name = "FILE", help_heading = HEADING)]
    pub output: PathBuf,

    /// Number of points, each a black dot at most
    #[arg(long, value_name = "N", help_heading = HEADING, default_value_t = 10_000)]
    pub points: u64,

    /// Maps applied to each point; 0 shows the random start points
    #[arg(long, value_name = "K", help_heading = HEADING, default_value_t = 10)]
    pub iters: u32,

    /// Width and height of the picture in pixels
    #[arg(long, value_name = "S", help_heading = HEADING, default_value_t = 100)]
    pub size: i64,

    /// Where the random numbers begin; the same seed gives the same picture
    #[arg(long, value_name = "N", help_heading = HEADING, default_value_t = 0)]
    pub seed: u64,

    /// Threads, and what is printed.
    #[command(flatten)]
    pub program: ProgramArgs,
}

const HEADING: &str = "Assignment 0";

const EXAMPLE: &str = "Example:
  ifs -input fern.txt -points 50000 -iters 30 -size 400 -output fern.tga";
