//! What was found.

/// A trial that did not hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    /// Its number, by which it can be run alone; `None` for a check that is no series of trials.
    pub trial: Option<u64>,
    /// What was wrong, with the input (rays in decimal and in bits).
    pub text: String,
}

/// A series of trials, or a single check.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Number of the property in `accuracy.md`, 1 … 18.
    pub property: u8,
    /// The check of the registry that it is part of.
    pub check: &'static str,
    /// Unlike that of any other row of the check.
    pub name: String,
    /// How often it was tried.
    pub trials: u64,
    /// How often it did not hold.
    pub failures: u64,
    /// The largest value that was measured; most are shares of what is allowed.
    pub worst: f64,
    /// The seed of the survey.
    pub seed: u64,
    /// Wall clock.
    pub seconds: f64,
    /// The first failure.
    pub first: Option<Failure>,
}

/// The outcome of some trials.
#[derive(Default)]
pub(crate) struct Outcome {
    pub trials: u64,
    pub failures: u64,
    pub worst: f64,
    pub first: Option<Failure>,
}

impl Outcome {
    /// Adds a trial.
    pub fn note(mut self, trial: Option<u64>, result: Result<f64, String>) -> Self {
        self.trials += 1;
        match result {
            Ok(value) => self.worst = self.worst.max(value),
            Err(text) => {
                self.failures += 1;
                self.first.get_or_insert(Failure { trial, text });
            }
        }
        self
    }

    /// Both together; the first failure is that of the lowest number.
    pub fn merge(self, other: Self) -> Self {
        let first = match (self.first, other.first) {
            (Some(a), Some(b)) => Some(if a.trial <= b.trial { a } else { b }),
            (a, b) => a.or(b),
        };
        Self {
            trials: self.trials + other.trials,
            failures: self.failures + other.failures,
            worst: self.worst.max(other.worst),
            first,
        }
    }
}
