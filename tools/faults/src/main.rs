//! Do the tests notice? `cargo run --release -p faults` plants the faults of `faults.txt` in a copy
//! of this repository, one at a time, and runs the test that is said to guard against each: a test
//! that passes all the same is worth nothing.
//!
//! That takes half an hour, so the command is not part of the test run; what is: every fault can
//! still be planted, and every test that is named exists.

mod copy;
mod list;
mod trial;

use clap::Parser;
use common::cli::{self, AppError, note, say};
use copy::Copy;
use list::Fault;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};
use trial::Verdict;

/// Plants faults in a copy of the repository and sees whether their tests fail.
#[derive(Parser)]
#[command(name = "faults", version, rename_all = "snake_case")]
struct Program {
    /// Only faults whose names hold one of these words
    #[arg(long, num_args = 1..)]
    only: Vec<String>,
    /// Prints the faults and their tests, and plants none
    #[arg(long)]
    list: bool,
    /// Where the copy is kept; a second run builds faster
    #[arg(long, value_name = "FOLDER", default_value = "target/faults")]
    folder: PathBuf,
    /// Seconds after which a test that does not end counts as failed
    #[arg(long, default_value_t = 300)]
    patience: u64,
}

fn main() -> ExitCode {
    let program = Program::parse();
    cli::run(|| run(&program))
}

/// The repository's root, where this was built.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn run(program: &Program) -> Result<(), AppError> {
    let all = list::read(&root())?;
    let wanted = |fault: &&Fault| {
        program.only.is_empty() || program.only.iter().any(|word| fault.name.contains(word.as_str()))
    };
    let faults: Vec<&Fault> = all.iter().filter(wanted).collect();
    if faults.is_empty() {
        return Err(AppError::Usage("no fault is called so; --list names them all".to_owned()));
    }
    if program.list {
        faults.iter().for_each(|fault| say(&format!("{:<40} {}", fault.name, fault.test)));
        return Ok(());
    }
    let copy = Copy::new(&root(), &program.folder)?;
    let patience = Duration::from_secs(program.patience);
    let mut escaped = Vec::new();
    // Package by package: what all of them share is built anew for each that wants other features.
    let packages: BTreeSet<&str> = faults.iter().map(|fault| fault.test.package.as_str()).collect();
    for package in packages {
        let group: Vec<&Fault> =
            faults.iter().copied().filter(|fault| fault.test.package == package).collect();
        sound_without_faults(&copy, &group, patience)?;
        for fault in group {
            if !plant(&copy, fault, patience)? {
                escaped.push(fault.name.as_str());
            }
        }
    }
    say(&format!("{} faults planted, {} noticed", faults.len(), faults.len() - escaped.len()));
    if escaped.is_empty() {
        return Ok(());
    }
    Err(AppError::CheckFailed(format!("not noticed: {}", escaped.join(", "))))
}

/// A test that fails anyhow would notice everything.
fn sound_without_faults(copy: &Copy, faults: &[&Fault], patience: Duration) -> Result<(), AppError> {
    let mut tests: Vec<_> = faults.iter().map(|fault| &fault.test).collect();
    tests.sort();
    tests.dedup();
    for test in tests {
        note(&format!("without fault: {test}"));
        match trial::run(copy, test, patience)? {
            Verdict::Passed => {}
            other => return Err(AppError::CheckFailed(format!("{test} without any fault: {other:?}"))),
        }
    }
    Ok(())
}

/// Whether the fault is noticed.
fn plant(copy: &Copy, fault: &Fault, patience: Duration) -> Result<bool, AppError> {
    let started = Instant::now();
    let planted = copy.plant(fault)?;
    let verdict = trial::run(copy, &fault.test, patience)?;
    drop(planted);
    let words = match &verdict {
        Verdict::Failed => "noticed by",
        Verdict::Endless => "never ends:",
        Verdict::Passed => "NOT NOTICED by",
        Verdict::NotBuilt(why) => {
            return Err(AppError::CheckFailed(format!("{} does not compile:\n{why}", fault.name)));
        }
    };
    let seconds = started.elapsed().as_secs();
    say(&format!("{:<40} {words} {} ({seconds} s)", fault.name, fault.test));
    Ok(!matches!(verdict, Verdict::Passed))
}
