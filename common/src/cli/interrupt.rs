//! Ctrl-C as a wish to end well, and so SIGTERM, which engines send whose time is over: the door to
//! ctrlc.

use super::output::note;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

/// Exit code of a program that the user has killed: 128 and the signal's number, as shells have it.
const KILLED: i32 = 130;

static WISHED: AtomicBool = AtomicBool::new(false);
static WATCHED: OnceLock<()> = OnceLock::new();

/// From the first call on, the first Ctrl-C does not end the program but sets what is returned,
/// which a [`crate::tiles::TileOptions::stop`] may look at. The second one ends it at once.
///
/// Where the system lets nobody watch, Ctrl-C goes on ending the program.
pub fn watch() -> &'static AtomicBool {
    WATCHED.get_or_init(|| {
        let watched = ctrlc::set_handler(|| {
            if WISHED.swap(true, Ordering::Relaxed) {
                std::process::exit(KILLED);
            }
            note("ending; what is done is kept. Ctrl-C again ends at once");
        });
        if watched.is_err() {
            super::warn("Ctrl-C cannot be watched here: it ends the program without a picture");
        }
    });
    &WISHED
}
