//! A failure as a file.

use ::stress::{Row, Tier};
use common::cli::AppError;
use std::fs;
use std::path::{Path, PathBuf};

/// All that is needed to run a trial again.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Reproducer {
    /// The check of the registry.
    pub check: String,
    /// The row of the check.
    pub row: String,
    /// How much was tried: some checks have other worlds for more.
    pub tier: Tier,
    /// The seed of the survey.
    pub seed: u64,
    /// Number of the trial; `None` if the check is no series of trials.
    pub trial: Option<u64>,
    /// What went wrong, for people: the ray in decimal and in bits.
    pub text: String,
}

/// Longest file name that is made of a row's name.
const LONGEST: usize = 60;

impl Reproducer {
    /// Of a row's first failure, if there is one.
    pub fn of(row: &Row, tier: Tier) -> Option<Self> {
        let first = row.first.as_ref()?;
        let (check, name, text) = (row.check.to_owned(), row.name.clone(), first.text.clone());
        Some(Self { check, row: name, tier, seed: row.seed, trial: first.trial, text })
    }

    fn content(&self) -> String {
        let trial = self.trial.map_or("none".to_owned(), |number| number.to_string());
        format!(
            "check {}\nrow {}\ntier {}\nseed {}\ntrial {trial}\n\n{}\n",
            self.check,
            self.row,
            self.tier.name(),
            self.seed,
            self.text
        )
    }

    /// Writes it into a folder, which is made if it is not there, and returns the file.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn write(&self, folder: &Path) -> Result<PathBuf, AppError> {
        fs::create_dir_all(folder)?;
        let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
        let name: String = self.row.chars().map(plain).take(LONGEST).collect();
        let trial = self.trial.map_or(String::new(), |number| format!("_{number}"));
        let file = folder.join(format!("{name}_{}{trial}.txt", self.seed));
        fs::write(&file, self.content())?;
        Ok(file)
    }

    /// Reads what [`Reproducer::write`] wrote.
    ///
    /// # Errors
    /// If it cannot be read, or is something else.
    pub fn read(file: &Path) -> Result<Self, AppError> {
        let text = fs::read_to_string(file)
            .map_err(|error| AppError::Usage(format!("cannot read '{}': {error}", file.display())))?;
        Self::parse(&text)
            .ok_or_else(|| AppError::Usage(format!("'{}' is no reproducer of a failure", file.display())))
    }

    fn parse(content: &str) -> Option<Self> {
        let (head, text) = content.split_once("\n\n")?;
        let mut lines = head.lines();
        let mut value = |key: &str| Some(lines.next()?.strip_prefix(key)?.strip_prefix(' ')?.to_owned());
        let (check, row, tier, seed, trial) =
            (value("check")?, value("row")?, value("tier")?, value("seed")?, value("trial")?);
        Some(Self {
            check,
            row,
            tier: Tier::ALL.into_iter().find(|t| t.name() == tier)?,
            seed: seed.parse().ok()?,
            trial: if trial == "none" { None } else { Some(trial.parse().ok()?) },
            text: text.trim_end().to_owned(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_again() {
        for trial in [None, Some(12)] {
            let reproducer = Reproducer {
                check: "p01_grid".to_owned(),
                row: "p01 grid, split square fans".to_owned(),
                tier: Tier::Full,
                seed: 3,
                trial,
                text: "origin [1, 2]\n\ndirection".to_owned(),
            };
            assert_eq!(Reproducer::parse(&reproducer.content()), Some(reproducer));
        }
        assert_eq!(Reproducer::parse("check p01\n\n"), None);
    }
}
