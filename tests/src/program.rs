//! Runs a command line inside the test process: the same parser and the same `run` as the
//! program's, without starting one.

use crate::{CommandLine, Picture};
use clap::Parser;
use common::cli::{AppError, set_quiet, try_parse_from};
use common::picture::{Film, Transfer, read};
use std::path::Path;

/// Parses words, the program's name first, as the program `P` does.
///
/// # Panics
/// If they are refused.
pub fn parsed_words<P: Parser>(words: &[String]) -> P {
    match try_parse_from::<P>(words) {
        Ok(parsed) => parsed.options,
        Err(stop) => panic!("{}\n{}", words.join(" "), stop.text),
    }
}

/// Runs a command line of assignments 1 to 7, its pictures going into `folder`. `-gui` is left
/// out: a test opens no windows.
///
/// # Errors
/// Those of the program.
pub fn run(line: &CommandLine, folder: &Path) -> Result<(), AppError> {
    let line = line.redirected(folder).without("-gui");
    // Flags of the window are part of the course's lines, and warned of without one.
    set_quiet(true);
    match line.assignment {
        1 => a1_ray_casting::run(&parsed_words::<a1_ray_casting::Program>(&line.words).args),
        2 => a2_transforms::run(&parsed_words::<a2_transforms::Program>(&line.words).args),
        3 => a3_phong::run(&parsed_words::<a3_phong::Program>(&line.words).args),
        4 => a4_whitted::run(&parsed_words::<a4_whitted::Program>(&line.words).args),
        5 => a5_grid::run(&parsed_words::<a5_grid::Program>(&line.words).args),
        6 => a6_kdtree::run(&parsed_words::<a6_kdtree::Program>(&line.words).args),
        7 => a7_sampling::run(&parsed_words::<a7_sampling::Program>(&line.words).args),
        other => Err(AppError::Usage(format!("assignment {other} draws no such pictures"))),
    }
}

/// Runs a command line and reads back what it has written.
///
/// # Panics
/// If the program fails or a picture is missing.
pub fn pictures(line: &CommandLine) -> Vec<(Picture, Film)> {
    let pictures = line.pictures();
    if pictures.is_empty() {
        return Vec::new();
    }
    let folder = tempfile::tempdir().expect("there is room for temporary files");
    run(line, folder.path()).unwrap_or_else(|error| panic!("{line}\n{}", error.report()));
    let film = |picture: &Picture| {
        read(&folder.path().join(&picture.file), Transfer::Linear).unwrap_or_else(|e| panic!("{line}\n{e}"))
    };
    pictures.into_iter().map(|picture| (picture.clone(), film(&picture))).collect()
}
