//! The child's side: reads case after case, and notes before each which one it is.

use super::FAMILIES;
use super::changes::Cases;
use crate::Tier;
use crate::stress::guarded;
use std::fmt;
use std::fs::File;
use std::io::{Error, Seek, SeekFrom, Write, stdout};
use std::str::FromStr;
use std::time::{Duration, Instant};

/// The variable of the environment that makes a process a worker.
pub const VARIABLE: &str = "STRESS_WORKER";

/// The variable that names the file for the number of the case.
pub const PROGRESS: &str = "STRESS_PROGRESS";

/// What a worker is to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Task {
    /// Number of the family.
    pub family: usize,
    /// The tier of the survey.
    pub tier: Tier,
    /// Its seed.
    pub seed: u64,
    /// The first case.
    pub from: usize,
    /// One past the last one.
    pub to: usize,
}

impl fmt::Display for Task {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{} {} {} {} {}", self.family, self.tier.name(), self.seed, self.from, self.to)
    }
}

impl FromStr for Task {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        let words: Vec<&str> = text.split(' ').collect();
        let &[family, tier, seed, from, to] = words.as_slice() else { return Err(()) };
        let number = |word: &str| word.parse::<usize>().map_err(drop);
        Ok(Self {
            family: number(family)?,
            tier: Tier::ALL.into_iter().find(|t| t.name() == tier).ok_or(())?,
            seed: seed.parse().map_err(drop)?,
            from: number(from)?,
            to: number(to)?,
        })
    }
}

/// Does a worker's work and ends the process, if the environment says that this is one. Programs
/// that run the checks of property 18 must call this before anything else.
pub fn serve() {
    if let Ok(task) = std::env::var(VARIABLE).unwrap_or_default().parse::<Task>() {
        // If nobody listens any more there is nothing left to do.
        let done = work(task);
        std::process::exit(i32::from(done.is_err()));
    }
}

/// Before each case its number goes to the file that [`PROGRESS`] names: eight bytes, always at the
/// same place. Lines for the watchdog: `!number text` for a case that was neither read nor
/// refused, and at the end `=` with the milliseconds that the slowest one took.
fn work(task: Task) -> std::io::Result<()> {
    let family = FAMILIES.get(task.family).ok_or_else(|| Error::other("no such family"))?;
    let cases = Cases::new(family, task.tier, task.seed);
    let place = std::env::var_os(PROGRESS).ok_or_else(|| Error::other("no place for progress"))?;
    let (mut progress, mut out) = (File::create(place)?, stdout());
    let mut slowest = Duration::ZERO;
    for number in task.from..task.to.min(cases.len()) {
        let case = cases.case(number);
        progress.seek(SeekFrom::Start(0))?;
        progress.write_all(&(number as u64).to_le_bytes())?;
        let started = Instant::now();
        if let Err(why) = guarded(|| (family.read)(&case.name, &case.bytes)) {
            out.write_all(format!("!{number} {}\n", why.replace('\n', " / ")).as_bytes())?;
        }
        slowest = slowest.max(started.elapsed());
    }
    out.write_all(format!("={}\n", slowest.as_millis()).as_bytes())?;
    out.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tasks_are_handed_over() {
        let task = Task { family: 3, tier: Tier::Long, seed: 7, from: 9, to: 11 };
        assert_eq!(task.to_string().parse(), Ok(task));
        assert_eq!("".parse::<Task>(), Err(()));
    }
}
