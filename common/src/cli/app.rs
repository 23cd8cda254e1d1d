//! How a program ends: what it prints, and its exit code.

use super::heap::keep_freed_memory;
use super::output::complain;
use std::error::Error;
use std::fmt::Write;
use std::process::ExitCode;

/// Why a program gives up. Any other error becomes [`AppError::Input`] through `?`.
#[derive(Debug)]
pub enum AppError {
    /// The command line asks for something impossible: exit code 2.
    Usage(String),
    /// A file, a scene or the system is to blame: exit code 2.
    Input(Box<dyn Error + Send + Sync>),
    /// The program did its work and found a difference: exit code 1.
    CheckFailed(String),
}

// As with other catch-all errors, this is possible because `AppError` is itself no `Error`.
impl<E: Error + Send + Sync + 'static> From<E> for AppError {
    fn from(error: E) -> Self {
        Self::Input(Box::new(error))
    }
}

impl AppError {
    /// 1 for a failed check, 2 for bad input or usage.
    pub fn code(&self) -> u8 {
        match self {
            Self::CheckFailed(_) => 1,
            Self::Usage(_) | Self::Input(_) => 2,
        }
    }

    /// The text for the user: `error: ...`, and each cause on a line of its own.
    pub fn report(&self) -> String {
        match self {
            Self::Usage(text) | Self::CheckFailed(text) => headed(text),
            Self::Input(error) => with_causes(error.as_ref()),
        }
    }
}

/// Texts that are rendered with a heading of their own (scene errors) keep it.
fn headed(text: &str) -> String {
    let text = text.trim_end();
    if text.starts_with("error") { text.to_owned() } else { format!("error: {text}") }
}

fn with_causes(error: &dyn Error) -> String {
    let mut text = headed(&error.to_string());
    let mut cause = error.source();
    while let Some(error) = cause {
        let _ = write!(text, "\n  caused by: {error}");
        cause = error.source();
    }
    text
}

/// Runs a program's main function, prints its error once, and turns it into the exit code:
/// 0 done, 1 a check failed, 2 bad input or usage.
pub fn run(main: impl FnOnce() -> Result<(), AppError>) -> ExitCode {
    keep_freed_memory();
    match main() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            complain(&error.report());
            ExitCode::from(error.code())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::{Film, Size, Transfer, write};
    use std::path::Path;

    fn write_nowhere() -> Result<(), AppError> {
        let film = Film::new(Size::new(1, 1)?);
        Ok(write(Path::new("/proc/no/such.tga"), &film, Transfer::Linear)?)
    }

    #[test]
    fn causes_follow_the_error() {
        let error = write_nowhere().unwrap_err();
        assert_eq!(error.code(), 2);
        let report = error.report();
        let mut lines = report.lines();
        assert_eq!(lines.next(), Some("error: cannot write '/proc/no/such.tga'"));
        assert!(lines.next().unwrap().starts_with("  caused by: "));
        assert_eq!(lines.next(), None);
    }

    #[test]
    fn a_heading_is_not_given_twice() {
        let usage = AppError::Usage("error: expected a number\n".to_owned());
        assert_eq!(usage.report(), "error: expected a number");
        let check = AppError::CheckFailed("3 pixels differ".to_owned());
        assert_eq!((check.report().as_str(), check.code()), ("error: 3 pixels differ", 1));
    }
}
