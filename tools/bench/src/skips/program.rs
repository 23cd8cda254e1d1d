//! The programs of the assignments inside this one, so that a process can be timed that does
//! nothing else.

use crate::clock;
use common::cli::{self, AppError, say};

/// Most runs of one command line within a process.
const MOST_RUNS: u32 = 1000;

/// Which program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Name {
    /// Assignment 1.
    Flat,
    /// Assignment 5, which does what 2 to 4 do.
    Grid,
    /// Assignment 6.
    Trees,
    /// Assignment 7.
    Samples,
    /// Assignment 8.
    Paths,
}

impl Name {
    /// Its name on the command line.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Flat => "a1_ray_casting",
            Self::Grid => "a5_grid",
            Self::Trees => "a6_kdtree",
            Self::Samples => "a7_sampling",
            Self::Paths => "a8_path_tracing",
        }
    }

    /// The one of that name.
    pub fn named(name: &str) -> Option<Self> {
        [Self::Flat, Self::Grid, Self::Trees, Self::Samples, Self::Paths]
            .into_iter()
            .find(|p| p.as_str() == name)
    }

    /// What a command line asks for; the words begin with the program's name.
    ///
    /// # Errors
    /// If the words are no command line of this program.
    pub fn parse(self, words: &[String]) -> Result<Box<dyn Fn() -> Result<(), AppError>>, AppError> {
        let words = words.iter().cloned();
        Ok(match self {
            Self::Flat => {
                let args = parsed::<a1_ray_casting::Program>(words)?.args;
                Box::new(move || a1_ray_casting::run(&args))
            }
            Self::Grid => {
                let args = parsed::<a5_grid::Program>(words)?.args;
                Box::new(move || a5_grid::run(&args))
            }
            Self::Trees => {
                let args = parsed::<a6_kdtree::Program>(words)?.args;
                Box::new(move || a6_kdtree::run(&args))
            }
            Self::Samples => {
                let args = parsed::<a7_sampling::Program>(words)?.args;
                Box::new(move || a7_sampling::run(&args))
            }
            Self::Paths => {
                let args = parsed::<a8_path_tracing::Program>(words)?.args;
                Box::new(move || a8_path_tracing::run(&args))
            }
        })
    }
}

fn parsed<P: clap::Parser>(words: impl Iterator<Item = String>) -> Result<P, AppError> {
    Ok(cli::try_parse_from::<P>(words).map_err(|stop| AppError::Usage(stop.text))?.options)
}

/// The child's part: does what the words say until that has taken `least` milliseconds of processor
/// time, then says how much one run takes.
///
/// # Errors
/// Those of the program.
pub fn work(words: &[String], least: u64) -> Result<(), AppError> {
    let unknown = || AppError::Usage(format!("no program is called {:?}", words.first()));
    let program = words.first().and_then(|name| Name::named(name)).ok_or_else(unknown)?;
    let run = program.parse(words)?;
    // The first one finds pages and files cold.
    run()?;
    let (before, mut spent, mut runs) = (clock::whole_process_time()?, 0, 0);
    while runs == 0 || runs < MOST_RUNS && spent < least * 1_000_000 {
        run()?;
        runs += 1;
        spent = clock::whole_process_time()?.saturating_sub(before);
    }
    say(&format!("cpu_ms {}", spent as f64 / 1e6 / f64::from(runs)));
    Ok(())
}
