//! Numbered jobs handed out to threads: the loop below the tile loop.
//!
//! The calling thread starts alone and calls for help when a tenth of a millisecond has not been
//! enough: waking other threads costs about as much, and many pictures are done by then.

use super::TileOptions;
use crate::cli::Progress;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// How long the calling thread works alone: about the price of waking the others.
const ALONE: Duration = Duration::from_micros(100);

/// What a loop leaves behind.
#[derive(Debug)]
pub struct Finished<S> {
    /// The state of every thread that took part, in no particular order; at least one.
    pub states: Vec<S>,
    /// Whether every job was done; false only after [`TileOptions::stop`].
    pub complete: bool,
}

/// Calls `work` once for every job from 0 to `count` (excluded), each thread with a state of its
/// own from `make_state`. Jobs begin in order; [`TileOptions::tile`] plays no part.
///
/// # Panics
/// If `work` does.
pub fn for_each_job<S: Send>(
    count: usize,
    options: &TileOptions,
    make_state: impl Fn() -> S + Sync,
    work: impl Fn(&mut S, usize) + Sync,
) -> Finished<S> {
    let queue = Queue::new(count, options);
    let mut state = make_state();
    let started = Instant::now();
    while started.elapsed() < ALONE {
        let Some(job) = queue.next() else {
            return queue.finish(vec![state]);
        };
        work(&mut state, job);
        queue.done();
    }
    let states = Mutex::new(Vec::new());
    let drain = |mut state: S| {
        while let Some(job) = queue.next() {
            work(&mut state, job);
            queue.done();
        }
        states.lock().expect("pushing does not panic").push(state);
    };
    let help = || drain(make_state());
    with_helpers(options.threads, queue.remaining(), || drain(state), &help);
    queue.finish(states.into_inner().expect("pushing does not panic"))
}

/// Runs `own` here and `help` on the other threads: those of the current pool, or of one made for
/// the occasion if another number of threads is asked for.
fn with_helpers(threads: Option<usize>, jobs: usize, own: impl FnOnce() + Send, help: &(impl Fn() + Sync)) {
    let most = jobs.max(1);
    let threads = threads.map(|n| n.clamp(1, most));
    if threads == Some(1) {
        return own();
    }
    let current = rayon::current_num_threads();
    let threads = threads.unwrap_or(current.min(most));
    if threads <= current {
        rayon::in_place_scope(|scope| {
            (1..threads).for_each(|_| scope.spawn(|_| help()));
            own();
        });
    } else {
        let builder = rayon::ThreadPoolBuilder::new().num_threads(threads - 1);
        match builder.build() {
            Ok(pool) => pool.in_place_scope(|scope| {
                (1..threads).for_each(|_| scope.spawn(|_| help()));
                own();
            }),
            // No more threads to be had: the work is done all the same.
            Err(_) => own(),
        }
    }
}

/// The jobs not begun yet, and how many are done.
struct Queue<'a> {
    count: usize,
    next: AtomicUsize,
    stop: Option<&'a AtomicBool>,
    progress: Progress<'a>,
}

impl<'a> Queue<'a> {
    fn new(count: usize, options: &TileOptions<'a>) -> Self {
        Self {
            count,
            next: AtomicUsize::new(0),
            stop: options.stop,
            progress: Progress::new(options.label, count),
        }
    }

    /// The next job, or `None` when there is none left or the work has been stopped.
    fn next(&self) -> Option<usize> {
        if self.stop.is_some_and(|stop| stop.load(Ordering::Relaxed)) {
            return None;
        }
        let job = self.next.fetch_add(1, Ordering::Relaxed);
        (job < self.count).then_some(job)
    }

    /// Jobs not begun yet.
    fn remaining(&self) -> usize {
        let begun = self.next.load(Ordering::Relaxed);
        self.count.saturating_sub(begun)
    }

    fn done(&self) {
        self.progress.step();
    }

    /// Clears the progress bar and passes on the states.
    fn finish<S>(self, states: Vec<S>) -> Finished<S> {
        Finished { states, complete: self.progress.count() == self.count }
    }
}
