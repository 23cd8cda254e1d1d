//! One test, run by cargo in the copy.

use crate::copy::Copy;
use crate::list::Test;
use common::cli::AppError;
use std::io::Read;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// How a test ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It ran, and nothing was wrong.
    Passed,
    /// It ran and failed, or its process died.
    Failed,
    /// It did not end in time.
    Endless,
    /// There was nothing to run; what the compiler said.
    NotBuilt(String),
}

/// Builds and runs a test.
///
/// # Errors
/// If cargo cannot be started, or there is no such test.
pub fn run(copy: &Copy, test: &Test, patience: Duration) -> Result<Verdict, AppError> {
    let built = cargo(copy, test).output()?;
    let told = String::from_utf8_lossy(&built.stderr).into_owned();
    if !built.status.success() {
        return Ok(Verdict::NotBuilt(told));
    }
    let program = executable(&told)
        .ok_or_else(|| AppError::CheckFailed(format!("cargo names no executable for {test}:\n{told}")))?;
    let mut running = Command::new(copy.root.join(program));
    running.current_dir(copy.package(test)?).env("INSTA_UPDATE", "no").args(["--exact", &test.name]);
    let mut child = running.stdout(Stdio::piped()).stderr(Stdio::null()).spawn()?;
    let text = child.stdout.take().map(|mut out| {
        std::thread::spawn(move || {
            let mut text = String::new();
            out.read_to_string(&mut text).map(|_| text).unwrap_or_default()
        })
    });
    let Some(succeeded) = wait(&mut child, patience)? else { return Ok(Verdict::Endless) };
    let text = text.and_then(|reader| reader.join().ok()).unwrap_or_default();
    if !succeeded {
        return Ok(Verdict::Failed);
    }
    match text.contains("1 passed") {
        true => Ok(Verdict::Passed),
        false => Err(AppError::CheckFailed(format!("there is no test {test}"))),
    }
}

/// A debug build, but quick to make: what differs from the last one is all that is compiled.
fn cargo(copy: &Copy, test: &Test) -> Command {
    let mut cargo = Command::new("cargo");
    cargo.current_dir(&copy.root).args(["test", "--no-run", "--package", &test.package]);
    match test.target.as_str() {
        "lib" => cargo.arg("--lib"),
        target => cargo.args(["--test", target]),
    };
    cargo
        .env("CARGO_TARGET_DIR", &copy.target)
        .env("CARGO_INCREMENTAL", "1")
        .env("CARGO_TERM_COLOR", "never");
    cargo
}

/// Run by itself, not by cargo, so that it can be stopped: `  Executable tests/it.rs (path)`.
fn executable(told: &str) -> Option<&str> {
    let line = told.lines().rev().find(|line| line.trim_start().starts_with("Executable"))?;
    line.rsplit_once('(')?.1.strip_suffix(')')
}

/// Whether it succeeded; `None` if it had to be stopped.
fn wait(child: &mut Child, patience: Duration) -> std::io::Result<Option<bool>> {
    let started = Instant::now();
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status.success()));
        }
        if started.elapsed() > patience {
            child.kill()?;
            child.wait()?;
            return Ok(None);
        }
        std::thread::sleep(Duration::from_millis(20));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_executable_is_found_in_what_cargo_says() {
        let told = "   Compiling a\n    Finished `test`\n  Executable unittests src/lib.rs (/t/deps/a-1)\n";
        assert_eq!(executable(told), Some("/t/deps/a-1"));
        assert_eq!(executable("error: it cannot be built"), None);
    }

    #[test]
    fn what_does_not_end_is_stopped() {
        let shell = |line: &str| Command::new("sh").args(["-c", line]).spawn().unwrap();
        assert_eq!(wait(&mut shell("true"), Duration::from_secs(60)).unwrap(), Some(true));
        assert_eq!(wait(&mut shell("false"), Duration::from_secs(60)).unwrap(), Some(false));
        assert_eq!(wait(&mut shell("exec sleep 600"), Duration::from_millis(50)).unwrap(), None);
    }
}
