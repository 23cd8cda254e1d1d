//! Nanoseconds of processor time, interleaved.

use crate::clock;
use crate::sample::Sample;

/// Shorter work than this many nanoseconds is repeated within a round, for the clock's sake.
const LONG_ENOUGH: u64 = 4_000_000;

/// Something to be timed: one call does `units` units of work.
pub struct Work<'a> {
    /// How many units.
    pub units: f64,
    /// The work.
    pub run: Box<dyn FnMut() + 'a>,
}

/// Nanoseconds per unit of each, a figure for every round. Every round does all of them in turn;
/// a first round warms up and finds out how often each must be repeated.
pub fn interleave(rounds: usize, works: &mut [Work]) -> Vec<Sample> {
    let repeats: Vec<u64> = works.iter_mut().map(|work| LONG_ENOUGH / once(work, 1).max(1) + 1).collect();
    let mut samples = vec![Sample::default(); works.len()];
    for _ in 0..rounds.max(1) {
        for ((work, &repeat), sample) in works.iter_mut().zip(&repeats).zip(&mut samples) {
            let nanoseconds = once(work, repeat);
            sample.add(nanoseconds as f64 / (repeat as f64 * work.units));
        }
    }
    samples
}

fn once(work: &mut Work, repeat: u64) -> u64 {
    let before = clock::thread_time();
    (0..repeat).for_each(|_| (work.run)());
    clock::thread_time() - before
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    #[test]
    fn everything_is_done_in_every_round() {
        let counts = [Cell::new(0), Cell::new(0)];
        let mut works: Vec<Work> = counts
            .iter()
            .map(|count| Work {
                units: 2.0,
                run: Box::new(|| {
                    count.set(count.get() + 1);
                    std::hint::black_box((0..200_000u64).fold(0, |a, b| std::hint::black_box(a ^ b)));
                }),
            })
            .collect();
        let samples = interleave(3, &mut works);
        drop(works);
        assert!(samples.iter().all(|s| s.median() >= 0.0));
        assert!(counts.iter().all(|count| count.get() >= 4));
    }
}
