//! This program as one of the assignments', so that a whole command line can be timed as a process.

use crate::clock;
use clap::Parser;
use common::cli::{self, AppError};
use std::io;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

/// The programs that can be timed.
pub const PROGRAMS: [&str; 8] = [
    "a1_ray_casting",
    "a2_transforms",
    "a3_phong",
    "a4_whitted",
    "a5_grid",
    "a6_kdtree",
    "a7_sampling",
    "a8_path_tracing",
];

/// Starts the line of standard output that tells the processor time of a run.
const TIME: &str = "cpu_ns ";

/// Most runs of one command line within a process.
const MOST_RUNS: u64 = 1000;

/// What a command line asks for.
type Work = Box<dyn Fn() -> Result<(), AppError>>;

/// Does what a program does (the first word names it), then says how much processor time it took. With
/// `least` milliseconds it is done once more, and again until that time is over: what is said then is
/// one run's share, without the start of the process and the first touch of memory and files.
///
/// # Errors
/// Those of the program.
pub fn run(words: &[String], least: u64) -> Result<(), AppError> {
    let work = prepare(words)?;
    work()?;
    let spent = if least == 0 { clock::process_time()? } else { repeat(&work, least)? };
    cli::say(&format!("{TIME}{spent}"));
    Ok(())
}

/// Nanoseconds of one run. Threads come and go from run to run, so the whole process is asked, which
/// counts what has ended coarsely: there have to be many.
fn repeat(work: &Work, least: u64) -> Result<u64, AppError> {
    let (before, mut spent, mut runs) = (clock::whole_process_time()?, 0, 0);
    while runs == 0 || runs < MOST_RUNS && spent < least * 1_000_000 {
        work()?;
        runs += 1;
        spent = clock::whole_process_time()?.saturating_sub(before);
    }
    Ok(spent / runs)
}

/// What the words ask for, which begin with a program's name.
///
/// # Errors
/// If they are no command line of it.
pub fn prepare(words: &[String]) -> Result<Work, AppError> {
    let program = words.first().map(String::as_str).unwrap_or_default();
    match program {
        "a1_ray_casting" => parsed(words, |p: &a1_ray_casting::Program| a1_ray_casting::run(&p.args)),
        "a2_transforms" => parsed(words, |p: &a2_transforms::Program| a2_transforms::run(&p.args)),
        "a3_phong" => parsed(words, |p: &a3_phong::Program| a3_phong::run(&p.args)),
        "a4_whitted" => parsed(words, |p: &a4_whitted::Program| a4_whitted::run(&p.args)),
        "a5_grid" => parsed(words, |p: &a5_grid::Program| a5_grid::run(&p.args)),
        "a6_kdtree" => parsed(words, |p: &a6_kdtree::Program| a6_kdtree::run(&p.args)),
        "a7_sampling" => parsed(words, |p: &a7_sampling::Program| a7_sampling::run(&p.args)),
        "a8_path_tracing" => parsed(words, |p: &a8_path_tracing::Program| a8_path_tracing::run(&p.args)),
        _ => Err(AppError::Usage(format!("`{program}` is none of {}", PROGRAMS.join(", ")))),
    }
}

fn parsed<P: Parser + 'static>(
    words: &[String],
    run: impl Fn(&P) -> Result<(), AppError> + 'static,
) -> Result<Work, AppError> {
    match cli::try_parse_from::<P>(words) {
        Ok(parsed) => Ok(Box::new(move || run(&parsed.options))),
        Err(stop) if stop.code == 0 => Ok(Box::new(move || {
            cli::say(stop.text.trim_end());
            Ok(())
        })),
        Err(stop) => Err(AppError::Usage(stop.text)),
    }
}

/// Wall-clock and processor time of one command line as a process of its own.
///
/// # Errors
/// If it fails, or cannot be started.
pub fn time(words: &[&str], picture: Option<&Path>) -> Result<clock::Span, AppError> {
    let mut words = words.to_vec();
    let picture = picture.map(|picture| picture.display().to_string());
    words.extend(picture.iter().flat_map(|picture| ["-output", picture]));
    let started = Instant::now();
    let (_, cpu) = start(&words, 0)?;
    Ok(clock::Span { wall: started.elapsed().as_secs_f64() * 1e3, cpu })
}

/// Has a command line run by a process of its own, see [`run`]: what it says, and milliseconds of
/// processor time.
///
/// # Errors
/// If it fails, or cannot be started.
pub fn start(words: &[&str], least: u64) -> Result<(String, f64), AppError> {
    let mut command = Command::new(std::env::current_exe()?);
    let output = command.arg("child").arg("--least").arg(least.to_string()).args(words).output()?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let cpu = text.lines().find_map(|l| l.strip_prefix(TIME)?.parse::<f64>().ok());
    match cpu {
        Some(ns) if output.status.success() => Ok((text, ns / 1e6)),
        _ => {
            let (line, said) = (words.join(" "), String::from_utf8_lossy(&output.stderr));
            Err(AppError::Input(io::Error::other(format!("`{line}` failed:\n{said}")).into()))
        }
    }
}

/// Calls `work` with an empty folder, which is gone afterwards.
///
/// # Errors
/// Those of `work`, or if the folder cannot be made.
pub fn in_folder<T>(work: impl FnOnce(&Path) -> Result<T, AppError>) -> Result<T, AppError> {
    let folder = std::env::temp_dir().join(format!("raysteps-bench-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    let result = work(&folder);
    std::fs::remove_dir_all(&folder)?;
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_program_is_known_and_no_other() {
        let run = |name: &str| run(&[name.to_owned(), "-help".to_owned()], 0);
        assert!(PROGRAMS.iter().all(|name| run(name).is_ok()));
        assert!(matches!(run("a9_simplification"), Err(AppError::Usage(_))));
        assert!(matches!(super::run(&[], 0), Err(AppError::Usage(_))));
    }
}
