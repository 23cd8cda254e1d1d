//! A copy of the repository, in which things may be broken.

use crate::list::{Fault, Test};
use common::cli::AppError;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The copy.
pub struct Copy {
    /// Its root.
    pub root: PathBuf,
    /// Where it is built.
    pub target: PathBuf,
}

/// A file that is mended when this is dropped.
pub struct Planted {
    file: PathBuf,
    sound: String,
}

impl Copy {
    /// Copies what git knows of, as it stands in the working tree. Files that have not changed since
    /// the last copy keep their dates, so that they need not be compiled again.
    ///
    /// # Errors
    /// If there is no git, or a file cannot be read or written.
    pub fn new(from: &Path, folder: &Path) -> Result<Self, AppError> {
        let listed = Command::new("git").arg("-C").arg(from).args(["ls-files", "-z"]).output()?;
        if !listed.status.success() {
            return Err(AppError::Usage("this needs the repository and git".to_owned()));
        }
        let copy = Self { root: folder.join("tree"), target: std::path::absolute(folder.join("target"))? };
        for name in String::from_utf8_lossy(&listed.stdout).split_terminator('\0') {
            let (source, place) = (from.join(name), copy.root.join(name));
            let Ok(text) = fs::read(&source) else { continue };
            if fs::read(&place).ok().as_ref() != Some(&text) {
                fs::create_dir_all(place.parent().unwrap_or(&copy.root))?;
                fs::write(&place, text)?;
            }
        }
        Ok(copy)
    }

    /// The folder of a test's package: tests are run there.
    ///
    /// # Errors
    /// If there is no such package.
    pub fn package(&self, test: &Test) -> Result<PathBuf, AppError> {
        let folders = ["", "assignments", "tools"].map(|folder| self.root.join(folder).join(&test.package));
        let found = folders.into_iter().find(|folder| folder.join("Cargo.toml").is_file());
        found.ok_or_else(|| AppError::CheckFailed(format!("there is no package {}", test.package)))
    }

    /// Plants a fault until the result is dropped.
    ///
    /// # Errors
    /// If it does not fit exactly once.
    pub fn plant(&self, fault: &Fault) -> Result<Planted, AppError> {
        let file = self.root.join(&fault.file);
        let sound = fs::read_to_string(&file)?;
        if sound.matches(&fault.from).count() != 1 {
            let why = format!("{}: does not stand exactly once in {}", fault.name, fault.file);
            return Err(AppError::CheckFailed(why));
        }
        fs::write(&file, sound.replace(&fault.from, &fault.to))?;
        Ok(Planted { file, sound })
    }
}

impl Drop for Planted {
    fn drop(&mut self) {
        if let Err(error) = fs::write(&self.file, &self.sound) {
            common::cli::note(&format!("{} is still broken: {error}", self.file.display()));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_planted_is_mended() {
        let folder = tempfile::tempdir().unwrap();
        let copy = Copy { root: folder.path().to_owned(), target: folder.path().to_owned() };
        let file = folder.path().join("a.rs");
        fs::write(&file, "one two three two").unwrap();
        let test = Test { package: String::new(), target: String::new(), name: String::new() };
        let fault = |from: &str| Fault {
            name: "it".to_owned(),
            file: "a.rs".to_owned(),
            from: from.to_owned(),
            to: "x".to_owned(),
            test: test.clone(),
        };
        let planted = copy.plant(&fault("one")).unwrap();
        assert_eq!(fs::read_to_string(&file).unwrap(), "x two three two");
        drop(planted);
        assert_eq!(fs::read_to_string(&file).unwrap(), "one two three two");
        assert!(copy.plant(&fault("two")).is_err() && copy.plant(&fault("four")).is_err());
    }
}
