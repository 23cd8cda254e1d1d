//! What a scene does not need: for every kind of work that is skipped a scene where that matters,
//! how much was done with the skip and without, what it saves, and that no bit of the picture
//! depends on it.
//!
//! Every command line runs in a process of its own, on one thread; both ways in turn. Their
//! pictures, in floating point, must agree to the last bit, or nothing is printed.

mod case;

use crate::child;
use crate::pictures::at_home;
use crate::report::{Better, Cell, Section, Table};
use crate::sample::Sample;
use case::{CASES, Case, MESH};
use common::cli::AppError;
use std::fs;
use std::path::{Path, PathBuf};

/// What to measure.
#[derive(clap::Args)]
pub struct Options {
    /// Rounds; every round runs every command line with the skip and without
    #[arg(long, default_value_t = 7)]
    rounds: usize,
    /// Runs of a process are repeated until they have taken so many milliseconds of processor time
    #[arg(long, default_value_t = 200)]
    least: u64,
    /// Three rounds of short runs, done within seconds
    #[arg(long)]
    quick: bool,
}

/// What one process said and did.
struct Outcome {
    counted: u64,
    milliseconds: f64,
    picture: Vec<u8>,
}

/// Both ways of a case, the second only if there is a switch.
#[derive(Default)]
struct Both {
    counted: [Option<u64>; 2],
    milliseconds: [Sample; 2],
}

/// Measures all cases.
///
/// # Errors
/// If not started from the repository's root, if a command line fails, or if a skip changes a
/// picture or a count.
pub fn measure(options: &Options) -> Result<Section, AppError> {
    at_home()?;
    let (rounds, least) = if options.quick {
        (options.rounds.min(3), options.least.min(50))
    } else {
        (options.rounds, options.least)
    };
    let measured = child::in_folder(|folder| all(rounds.max(1), least, folder))?;
    Ok(section(&measured))
}

fn all(rounds: usize, least: u64, folder: &Path) -> Result<Vec<Both>, AppError> {
    let mut measured: Vec<Both> = CASES.iter().map(|_| Both::default()).collect();
    for _ in 0..rounds {
        for (case, both) in CASES.iter().zip(&mut measured) {
            let ways = if case.switch.is_empty() { 1 } else { 2 };
            let outcomes =
                (0..ways).map(|way| once(case, way == 1, least, folder)).collect::<Result<Vec<_>, _>>()?;
            both.note(case, &outcomes)?;
        }
    }
    Ok(measured)
}

impl Both {
    fn note(&mut self, case: &Case, outcomes: &[Outcome]) -> Result<(), AppError> {
        if outcomes.iter().any(|o| o.picture != outcomes[0].picture) {
            let what = format!("-noskip {} changes the picture: {}", case.switch, case.item);
            return Err(AppError::CheckFailed(what));
        }
        for (way, outcome) in outcomes.iter().enumerate() {
            if self.counted[way].is_some_and(|before| before != outcome.counted) {
                return Err(AppError::CheckFailed(format!("{}: two runs count differently", case.item)));
            }
            self.counted[way] = Some(outcome.counted);
            self.milliseconds[way].add(outcome.milliseconds);
        }
        Ok(())
    }
}

/// The scene's file, written if it is a text.
fn scene_file(case: &Case, folder: &Path) -> Result<PathBuf, AppError> {
    if case.has_file() {
        return Ok(Path::new("scenes").join(case.scene));
    }
    let file = folder.join("scene.txt");
    fs::write(&file, case.scene.replace("MESH", MESH))?;
    Ok(file)
}

/// The words of a case's command line.
fn words(case: &Case, toiling: bool, scene: &Path, picture: &Path) -> Vec<String> {
    let line = format!(
        "{} -input {} -threads 1 -stats {} {} {}",
        case.program,
        scene.display(),
        case.flags,
        case.picture,
        picture.display()
    );
    let mut words: Vec<String> = line.split_whitespace().map(str::to_owned).collect();
    if toiling {
        words.extend(["-noskip", case.switch].map(str::to_owned));
    }
    words
}

fn once(case: &Case, toiling: bool, least: u64, folder: &Path) -> Result<Outcome, AppError> {
    let picture = folder.join("out.pfm");
    let words = words(case, toiling, &scene_file(case, folder)?, &picture);
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let (text, milliseconds) = child::start(&words, least)?;
    let missing = || AppError::CheckFailed(format!("`{}` counts no {}", words.join(" "), case.counter));
    let counted = figure(&text, case.counter).ok_or_else(missing)? as u64;
    Ok(Outcome { counted, milliseconds, picture: fs::read(&picture)? })
}

/// The number that follows a name in what a program printed, the first time it stands there.
fn figure(text: &str, name: &str) -> Option<f64> {
    let rest = text.lines().find_map(|line| line.trim_start().strip_prefix(name))?;
    let number = |c: char| c.is_ascii_digit() || c == '.';
    rest.trim_start().split(|c| !number(c)).next()?.parse().ok()
}

fn section(measured: &[Both]) -> Section {
    let columns = [
        ("-noskip", Better::Neither),
        ("what is counted", Better::Neither),
        ("skipping", Better::Less),
        ("not skipping", Better::Neither),
        ("ms skipping", Better::Less),
        ("ms not skipping", Better::Neither),
        ("saved", Better::More),
        ("picture", Better::Neither),
    ];
    let mut table = Table::new("work that is skipped", "work", &columns);
    for (case, both) in CASES.iter().zip(measured) {
        let [skipping, toiling] = &both.milliseconds;
        let exists = !case.switch.is_empty();
        let count = |way: usize| both.counted[way].map_or(Cell::None, Cell::from);
        let share = 100.0 * (1.0 - skipping.median() / toiling.median());
        table.row(
            case.item,
            [
                Cell::from(if exists { case.switch } else { "never exists" }),
                Cell::from(case.counter),
                count(0),
                count(1),
                Cell::from(skipping),
                Cell::from(toiling),
                if exists { Cell::from(format!("{share:.0} %")) } else { Cell::None },
                if exists { Cell::from("bit-equal") } else { Cell::None },
            ],
        );
    }
    Section {
        part: "skips",
        title: "What a scene does not need, and what leaving it out saves".to_owned(),
        remarks: [
            "whole processes on one thread, processor time: median (quartiles)",
            "what never exists has no switch: traversal carries t, number and two weights of a hit",
            "and nothing else; transforms are baked; planes and discs are in no tree or grid",
        ]
        .map(str::to_owned)
        .to_vec(),
        tables: vec![table],
        ..Section::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_read_from_reports() {
        let text = "  num shadow rays            420\n  paths: 12 in 3 passes\ncpu_ns 12.5\n";
        assert_eq!(figure(text, "num shadow rays"), Some(420.0));
        assert_eq!(figure(text, "cpu_ns"), Some(12.5));
        assert_eq!((figure(text, "paths:"), figure(text, "rays")), (Some(12.0), None));
    }

    #[test]
    fn command_lines_are_understood_both_ways() {
        for case in &CASES {
            for toiling in [false, !case.switch.is_empty()] {
                let words = words(case, toiling, Path::new("a.txt"), Path::new("b.pfm"));
                assert!(child::prepare(&words).is_ok(), "{words:?}");
            }
        }
    }

    #[test]
    fn a_picture_that_differs_is_an_error() {
        let outcome = |picture: u8, counted| Outcome { counted, milliseconds: 1.0, picture: vec![picture] };
        let mut both = Both::default();
        assert!(both.note(&CASES[0], &[outcome(1, 5), outcome(1, 7)]).is_ok());
        assert_eq!(both.counted, [Some(5), Some(7)]);
        assert!(both.note(&CASES[0], &[outcome(1, 5), outcome(2, 7)]).is_err(), "another picture");
        assert!(both.note(&CASES[0], &[outcome(1, 6), outcome(1, 7)]).is_err(), "another count");
    }
}
