//! The child's side: reads case after case, and says before each which one it is.

use super::FAMILIES;
use super::changes::Cases;
use crate::Tier;
use crate::stress::guarded;
use std::fmt;
use std::io::{Write, stdout};
use std::str::FromStr;

/// The variable of the environment that makes a process a worker.
pub const VARIABLE: &str = "STRESS_WORKER";

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

/// Lines for the watchdog: `@number` before a case, `!number text` for one that was neither read
/// nor refused, `=` at the end.
fn work(task: Task) -> std::io::Result<()> {
    let family = FAMILIES.get(task.family).ok_or_else(|| std::io::Error::other("no such family"))?;
    let cases = Cases::new(family, task.tier, task.seed);
    let mut out = stdout();
    for number in task.from..task.to.min(cases.len()) {
        let case = cases.case(number);
        // Each line at once: the next case may be the last one.
        out.write_all(format!("@{number}\n").as_bytes())?;
        if let Err(why) = guarded(|| (family.read)(&case.name, &case.bytes)) {
            out.write_all(format!("!{number} {}\n", why.replace('\n', " / ")).as_bytes())?;
        }
    }
    out.write_all(b"=\n")?;
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
