//! Pass after pass until the goal is reached.

use super::pass::pass;
use super::{Estimator, Goal};
use crate::film::Sums;
use common::cli::Progress;
use common::counters::Counters;
use common::tiles::TileOptions;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Why a rendering ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// All samples are taken.
    Samples,
    /// The time is over.
    Time,
    /// All pixels are good enough.
    Error,
    /// [`TileOptions::stop`] said so.
    Stopped,
}

/// What was done.
#[derive(Clone, Copy, Debug)]
pub struct Tally {
    /// Whole passes.
    pub passes: u32,
    /// Paths of whole passes.
    pub paths: u64,
    /// Time spent in passes, a broken one among them.
    pub time: Duration,
    /// What was counted in whole passes.
    pub counters: Counters,
    /// Why it ended.
    pub end: End,
}

/// A goal and the way to it; only the goal decides what the sums will be.
pub struct Rendering<'a> {
    /// When it is over.
    pub goal: Goal,
    /// Threads, tiles, and what stops it. With a label, progress is shown.
    pub options: TileOptions<'a>,
}

/// Tells a bar how far things have come.
struct Watcher<'a> {
    bar: Progress<'a>,
    /// Where time is what is counted: the milliseconds told already.
    told: Option<AtomicUsize>,
    started: Instant,
}

impl Rendering<'_> {
    /// Goes on with `sums` until the goal is reached. Whenever there are more whole passes, `look`
    /// may look at the sums.
    pub fn run<E: Estimator>(&self, estimator: &E, sums: &mut Sums, mut look: impl FnMut(&Sums)) -> Tally {
        let watcher = Watcher::new(self, sums);
        let mut tally = Tally {
            passes: 0,
            paths: 0,
            time: Duration::ZERO,
            counters: Counters::default(),
            end: End::Samples,
        };
        let mut each = None;
        while sums.samples.end < self.goal.end {
            let active = self.survey(sums, &watcher);
            if active == 0 {
                tally.end = End::Error;
                break;
            }
            let (done, left) = (sums.done(), self.goal.end - sums.samples.end);
            let cost = each.map(|path: Duration| path.mul_f64(active as f64 / sums.taken().len() as f64));
            let Some(count) = self.goal.next_pass(done, left, cost, watcher.started.elapsed()) else {
                tally.end = End::Time;
                break;
            };
            let begun = Instant::now();
            let samples = sums.samples.end..sums.samples.end + count;
            let passed = pass(estimator, sums, samples.clone(), &self.options, &|paths| watcher.tell(paths));
            tally.time += begun.elapsed();
            let Some(passed) = passed else {
                tally.end = End::Stopped;
                break;
            };
            sums.add(&passed.patches, samples.end);
            each = Some(begun.elapsed().mul_f64(sums.taken().len() as f64 / active as f64) / count);
            tally.counters += passed.counters;
            tally.passes += 1;
            tally.paths += active as u64 * u64::from(count);
            look(sums);
        }
        tally
    }

    /// Stops pixels that are good enough; returns how many are not.
    fn survey(&self, sums: &mut Sums, watcher: &Watcher) -> usize {
        if let Some(error) = self.goal.error
            && sums.wants_survey()
        {
            let good = sums.survey(error);
            let left = (self.goal.end - sums.samples.end) as usize;
            watcher.tell(good * left);
        }
        sums.active()
    }
}

impl<'a> Watcher<'a> {
    fn new(rendering: &Rendering<'a>, sums: &Sums) -> Self {
        let goal = &rendering.goal;
        let left = goal.end.saturating_sub(sums.samples.end) as usize;
        let total = match goal.time {
            Some(time) => time.as_millis() as usize,
            None => sums.active().saturating_mul(left),
        };
        Self {
            bar: Progress::new(rendering.options.label, total),
            told: goal.time.map(|_| AtomicUsize::new(0)),
            started: Instant::now(),
        }
    }

    /// So many paths have been traced, or need not be.
    fn tell(&self, paths: usize) {
        let Some(told) = &self.told else { return self.bar.advance(paths) };
        let now = self.started.elapsed().as_millis() as usize;
        let before = told.fetch_max(now, Ordering::Relaxed);
        self.bar.advance(now.saturating_sub(before));
    }
}
