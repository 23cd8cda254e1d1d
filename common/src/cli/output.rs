//! Text for the user: results on stdout, everything else on stderr.
//!
//! A reader that has gone away (`| head`) is no error: the text is dropped and work goes on, since
//! pictures may still have to be written.

use std::io::{self, Write};
use std::sync::atomic::{AtomicBool, Ordering};

static QUIET: AtomicBool = AtomicBool::new(false);

/// Switches warnings, notes and progress bars off (or on again) for the whole program.
pub fn set_quiet(quiet: bool) {
    QUIET.store(quiet, Ordering::Relaxed);
}

/// Whether [`set_quiet`] has switched warnings and progress bars off.
pub fn is_quiet() -> bool {
    QUIET.load(Ordering::Relaxed)
}

/// Prints a result, and a line end, to stdout.
pub fn say(text: &str) {
    let _ = writeln!(io::stdout().lock(), "{text}");
}

/// Prints `warning: ...` to stderr, unless quiet: a flag has no effect, a scene looks wrong.
pub fn warn(text: &str) {
    note(&format!("warning: {text}"));
}

/// Prints a line to stderr, unless quiet.
pub fn note(text: &str) {
    if !is_quiet() {
        complain(text);
    }
}

/// Prints a line to stderr in any case.
pub(super) fn complain(text: &str) {
    let _ = writeln!(io::stderr().lock(), "{text}");
}
