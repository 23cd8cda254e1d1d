//! A progress bar for work that takes long: the door to indicatif.

use super::output::is_quiet;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::{IsTerminal, stderr};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Work done sooner than this shows no bar.
const PATIENCE: Duration = Duration::from_millis(500);

/// Counts steps from any thread, and shows a bar with the time left on stderr if that is a
/// terminal and the work takes longer than half a second. The bar goes when this is dropped.
#[derive(Debug)]
pub struct Progress<'a> {
    /// Shown beside the bar; `None` where no bar is wanted or could be seen.
    label: Option<&'a str>,
    total: usize,
    done: AtomicUsize,
    started: Instant,
    bar: OnceLock<ProgressBar>,
}

impl<'a> Progress<'a> {
    /// Begins counting towards `total`. Without a label, or when quiet, no bar is ever shown.
    pub fn new(label: Option<&'a str>, total: usize) -> Self {
        Self {
            label: label.filter(|_| !is_quiet() && stderr().is_terminal()),
            total,
            done: AtomicUsize::new(0),
            started: Instant::now(),
            bar: OnceLock::new(),
        }
    }

    /// Counts one step.
    pub fn step(&self) {
        self.advance(1);
    }

    /// Counts several steps.
    pub fn advance(&self, steps: usize) {
        let done = self.done.fetch_add(steps, Ordering::Relaxed) + steps;
        if let Some(label) = self.label
            && self.started.elapsed() > PATIENCE
        {
            let bar = self.bar.get_or_init(|| self.make_bar(label, done));
            bar.set_position(done as u64);
        }
    }

    /// Steps counted so far.
    pub fn count(&self) -> usize {
        self.done.load(Ordering::Relaxed)
    }

    fn make_bar(&self, label: &str, done: usize) -> ProgressBar {
        let style = ProgressStyle::with_template("{prefix} [{bar:40}] {percent:>3} %, {eta} left")
            .expect("the template is well formed")
            .progress_chars("=> ");
        ProgressBar::new(self.total as u64)
            .with_style(style)
            .with_prefix(label.to_owned())
            .with_elapsed(self.started.elapsed())
            .with_position(done as u64)
    }
}

impl Drop for Progress<'_> {
    fn drop(&mut self) {
        if let Some(bar) = self.bar.get() {
            bar.finish_and_clear();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_template_is_well_formed() {
        let progress = Progress::new(None, 10);
        assert_eq!(progress.make_bar("tiles", 3).position(), 3);
    }

    #[test]
    fn counts_without_a_bar() {
        let progress = Progress::new(None, 2);
        progress.step();
        progress.step();
        assert_eq!(progress.count(), 2);
        assert!(progress.bar.get().is_none());
    }
}
