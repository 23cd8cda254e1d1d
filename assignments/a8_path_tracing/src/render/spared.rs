//! The samples that pixels were spared because they are good enough: how many, and what they
//! would have cost.

use super::{Estimator, Goal};
use crate::film::Sums;
use crate::path::Found;
use common::counters::Counters;
use common::tiles::{TileOptions, for_each_job};

/// Samples of one pixel that are traced together.
const TOGETHER: u32 = 2048;

/// How many samples of pixels that were stopped are left up to the goal.
pub fn spared(sums: &Sums, goal: &Goal) -> u64 {
    let left = |number: usize| u64::from(goal.end.saturating_sub(sums.samples.start + sums.taken()[number]));
    stopped(sums).map(left).sum()
}

/// Traces just those and forgets what they found: for who wants to know what stopping saves.
/// Returns what was counted.
pub fn trace_spared<E: Estimator>(
    estimator: &E,
    sums: &Sums,
    goal: &Goal,
    options: &TileOptions,
) -> Counters {
    let numbers: Vec<usize> = stopped(sums).collect();
    let make_state = || (E::Scratch::default(), Counters::default(), Vec::new());
    let finished = for_each_job(numbers.len(), options, make_state, |(scratch, counters, found), job| {
        let pixel = [sums.frame.pixel(numbers[job])];
        let mut from = sums.samples.start + sums.taken()[numbers[job]];
        while from < goal.end {
            let to = goal.end.min(from + TOGETHER);
            found.resize((to - from) as usize, Found::default());
            estimator.trace(scratch, &pixel, from..to, counters, found);
            from = to;
        }
    });
    let mut counters = Counters::default();
    finished.states.iter().for_each(|(_, counted, _)| counters += *counted);
    counters
}

fn stopped(sums: &Sums) -> impl Iterator<Item = usize> + '_ {
    (0..sums.taken().len()).filter(|number| !sums.is_active(*number))
}
