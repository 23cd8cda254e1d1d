//! Running a property many times.

use super::Draw;
use rayon::prelude::*;
use std::time::Instant;

/// Trials that share one stream of random numbers.
const CHUNK: u64 = 512;

#[derive(Default)]
struct Outcome {
    failures: u64,
    /// Number of the first failing trial and its reproducer.
    first: Option<(u64, String)>,
    worst: f64,
}

impl Outcome {
    fn merge(self, other: Self) -> Self {
        let first = match (self.first, other.first) {
            (Some(a), Some(b)) => Some(if a.0 <= b.0 { a } else { b }),
            (a, b) => a.or(b),
        };
        Self { failures: self.failures + other.failures, first, worst: self.worst.max(other.worst) }
    }

    fn note(&mut self, number: u64, result: Result<f64, String>) {
        match result {
            Ok(value) => self.worst = self.worst.max(value),
            Err(text) => {
                self.failures += 1;
                self.first.get_or_insert((number, text));
            }
        }
    }
}

fn setting(name: &str, default: u64) -> u64 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(default)
}

/// Runs `trial` with `trials` seeded streams on all cores and returns the largest value that
/// any of them measured. What a trial draws depends on the seed and its number only.
///
/// # Panics
/// If a trial fails; the message holds seed, number of failures and the first reproducer.
pub fn run(
    name: &str,
    seed: u64,
    trials: u64,
    trial: impl Fn(&mut Draw) -> Result<f64, String> + Sync,
) -> f64 {
    let started = Instant::now();
    let trials = trials * setting("PROPERTY_FACTOR", 1);
    let seed = seed + (setting("PROPERTY_SEED", 0) << 32);
    let outcome = (0..trials.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| {
            let mut draw = Draw::new(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ chunk);
            let mut outcome = Outcome::default();
            for number in chunk * CHUNK..((chunk + 1) * CHUNK).min(trials) {
                outcome.note(number, trial(&mut draw));
            }
            outcome
        })
        .reduce(Outcome::default, Outcome::merge);
    tally(name, trials, outcome.worst, started);
    if let Some((number, text)) = outcome.first {
        panic!(
            "{name}: {} of {trials} fail, seed {seed}, first is trial {number}:\n{text}",
            outcome.failures
        );
    }
    outcome.worst
}

/// Reports a property that held; seen with `cargo test -- --nocapture`.
pub fn tally(name: &str, trials: u64, worst: f64, started: Instant) {
    let seconds = started.elapsed().as_secs_f64();
    println!("property | {name} | {trials} trials | worst {worst:.4} | {seconds:.2} s");
}
