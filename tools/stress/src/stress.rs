//! Running checks many times, and keeping what was found.

use crate::kit::Draw;
use crate::row::{Outcome, Row};
use crate::tier::{Tier, Trials};
use rayon::prelude::*;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;
use std::time::Instant;

/// A single trial to run alone.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Single {
    /// Name of its row.
    pub row: String,
    /// Its number.
    pub trial: u64,
}

/// What a check is given: how much to do, and where to put what it finds.
pub struct Stress {
    property: u8,
    check: &'static str,
    tier: Tier,
    seed: u64,
    single: Option<Single>,
    rows: Mutex<Vec<Row>>,
}

impl Stress {
    /// For a check of a property. Trials of one seed differ from those of any other; the usual one
    /// is 0.
    pub fn new(property: u8, check: &'static str, tier: Tier, seed: u64) -> Self {
        Self { property, check, tier, seed, single: None, rows: Mutex::default() }
    }

    /// The same, but it runs one trial and nothing else.
    pub fn only(self, single: Single) -> Self {
        Self { single: Some(single), ..self }
    }

    /// Whether one trial is to be run and nothing else.
    pub fn is_single(&self) -> bool {
        self.single.is_some()
    }

    pub(crate) fn single(&self) -> Option<&Single> {
        self.single.as_ref()
    }

    /// How much is asked for.
    pub fn tier(&self) -> Tier {
        self.tier
    }

    /// The seed of the survey.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// The check of the registry that this is for.
    pub fn check(&self) -> &'static str {
        self.check
    }

    /// A stream of random numbers for what is not a series of trials; other seeds of the survey
    /// give others.
    pub fn draw(&self, seed: u64) -> Draw {
        Draw::new(self.stream(seed))
    }

    fn stream(&self, seed: u64) -> u64 {
        seed.wrapping_add(self.seed << 32).wrapping_mul(0x9E37_79B9_7F4A_7C15)
    }

    /// Runs `trial` with as many streams of random numbers on all cores, and notes how often it
    /// failed. What a trial draws depends on the seeds and its number only. Returns the largest
    /// value that any of them measured; not a number if only a trial of another row is wanted.
    ///
    /// `PROPERTY_FACTOR=30` in the environment runs thirty times as many.
    pub fn run(
        &self,
        name: impl Into<String>,
        seed: u64,
        trials: impl Into<Trials>,
        trial: impl Fn(&mut Draw) -> Result<f64, String> + Sync,
    ) -> f64 {
        let (name, started) = (name.into(), Instant::now());
        let one = |outcome: Outcome, number: u64| {
            let mut draw = Draw::new(self.stream(seed) ^ number);
            outcome.note(Some(number), guarded(|| trial(&mut draw)))
        };
        let outcome = match &self.single {
            Some(single) if single.row == name => one(Outcome::default(), single.trial),
            Some(_) => return f64::NAN,
            None => (0..trials.into().at(self.tier) * factor())
                .into_par_iter()
                .fold(Outcome::default, one)
                .reduce(Outcome::default, Outcome::merge),
        };
        self.record(name, outcome, started)
    }

    /// Checks something once; the value is the worst that was measured. A panic is a failure.
    /// Returns the value; not a number if it failed or only a trial is wanted.
    pub fn case(&self, name: impl Into<String>, check: impl FnOnce() -> Result<f64, String>) -> f64 {
        if self.single.is_some() {
            return f64::NAN;
        }
        let started = Instant::now();
        let result = guarded(check);
        let value = result.as_ref().copied().unwrap_or(f64::NAN);
        self.record(name.into(), Outcome::default().note(None, result), started);
        value
    }

    /// As [`Stress::case`], for what was checked many times over: the value is how often.
    pub fn count(&self, name: impl Into<String>, check: impl FnOnce() -> Result<u64, String>) {
        let (name, started) = (name.into(), Instant::now());
        if self.single.is_none() {
            let mut trials = 1;
            let result = guarded(|| check().map(|count| trials = count));
            let outcome = Outcome::default().note(None, result.map(|()| 0.0));
            self.record(name, Outcome { trials, ..outcome }, started);
        }
    }

    /// Notes that a condition on a whole series holds, or not. Passed over if only a trial is
    /// wanted.
    pub fn expect(&self, what: &str, found: f64, holds: impl FnOnce(f64) -> bool) {
        self.case(what, || if holds(found) { Ok(found) } else { Err(format!("it is {found}")) });
    }

    /// Notes what was found; returns the worst of it.
    pub(crate) fn record(&self, name: String, outcome: Outcome, started: Instant) -> f64 {
        let Outcome { trials, failures, worst, first } = outcome;
        let seconds = started.elapsed().as_secs_f64();
        let (property, check, seed) = (self.property, self.check, self.seed);
        let row = Row { property, check, name, trials, failures, worst, seed, seconds, first };
        self.lock().push(row);
        worst
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Vec<Row>> {
        self.rows.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
    }

    /// All that was found.
    pub fn into_rows(self) -> Vec<Row> {
        self.rows.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner())
    }
}

fn factor() -> u64 {
    setting("PROPERTY_FACTOR").unwrap_or(1)
}

/// A number of the environment.
pub(crate) fn setting(name: &str) -> Option<u64> {
    std::env::var(name).ok()?.parse().ok()
}

/// A panic as an error.
pub(crate) fn guarded<T>(work: impl FnOnce() -> Result<T, String>) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(work))
        .unwrap_or_else(|payload| Err(format!("panic: {}", panic_words(&*payload))))
}

/// What a panic said.
pub fn panic_words(payload: &(dyn Any + Send)) -> &str {
    let text = payload.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| payload.downcast_ref::<&str>().copied()).unwrap_or("without words")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails for some draws, panics for others.
    fn shaky(stress: &Stress) {
        stress.run("other", 1, 100, |_| Ok(1.0));
        stress.run("shaky", 7, 10_000, |draw| match draw.unit() {
            x if x > 0.999 => Err(format!("{x}")),
            x if x > 0.998 => panic!("{x}"),
            x => Ok(x),
        });
    }

    #[test]
    fn failures_and_panics_are_counted_and_come_again_alone() {
        let stress = Stress::new(1, "shaky", Tier::Quick, 3);
        shaky(&stress);
        let rows = stress.into_rows();
        let row = &rows[1];
        assert_eq!((rows[0].failures, rows[0].worst), (0, 1.0));
        assert_eq!(row.trials, 10_000 * factor());
        assert!(row.failures > 5 && row.worst < 0.998, "{row:?}");
        let first = row.first.clone().expect("a failure");
        let single = Single { row: "shaky".to_owned(), trial: first.trial.expect("a number") };
        let again = Stress::new(1, "shaky", Tier::Full, 3).only(single.clone());
        shaky(&again);
        let again = again.into_rows();
        assert_eq!((again.len(), again[0].first.as_ref()), (1, Some(&first)), "one trial, the same words");
        let other = Stress::new(1, "shaky", Tier::Quick, 4).only(single);
        shaky(&other);
        assert_ne!(other.into_rows()[0].first.as_ref(), Some(&first), "another seed");
    }

    #[test]
    fn single_checks_are_noted() {
        let stress = Stress::new(2, "single", Tier::Quick, 0);
        assert_eq!(stress.case("good", || Ok(3.0)), 3.0);
        assert!(stress.case("bad", || Err("no".to_owned())).is_nan());
        stress.case("broken", || panic!("boom"));
        stress.count("many", || Ok(17));
        stress.expect("large", 4.0, |x| x > 5.0);
        let rows = stress.into_rows();
        let summary: Vec<(u64, u64)> = rows.iter().map(|r| (r.trials, r.failures)).collect();
        assert_eq!(summary, [(1, 0), (1, 1), (1, 1), (17, 0), (1, 1)]);
        assert_eq!(rows[2].first.as_ref().map(|f| f.text.as_str()), Some("panic: boom"));
    }
}
