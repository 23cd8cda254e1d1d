//! The course's command lines as data.
//!
//! Flags are looked up in the plain words, not through the programs' own parser: what the oracle
//! is asked to draw must not depend on the code that is being checked.

use crate::workspace_file;
use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// One line of `tests/commands/A?.txt`.
#[derive(Clone, Debug)]
pub struct CommandLine {
    /// The assignment that it belongs to.
    pub assignment: u8,
    /// Its line in the file, from 1.
    pub line: usize,
    /// The words, the program's name first.
    pub words: Vec<String>,
}

/// What a picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PictureKind {
    /// `-output`
    Color,
    /// `-depth`
    Depth,
    /// `-normals`
    Normals,
    /// `-render_samples`
    Samples,
    /// `-render_filter`
    Filter,
}

/// A picture that a command line writes.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Picture {
    /// What it shows.
    pub kind: PictureKind,
    /// The file's name, without a folder.
    pub file: String,
}

impl Picture {
    /// The file's name without its suffix.
    pub fn stem(&self) -> &str {
        self.file.rsplit_once('.').map_or(self.file.as_str(), |(stem, _)| stem)
    }
}

impl CommandLine {
    /// All command lines of one assignment.
    ///
    /// # Panics
    /// If there is no file for it.
    pub fn of_assignment(assignment: u8) -> Vec<Self> {
        let path = workspace_file(format!("tests/commands/A{assignment}.txt"));
        let text = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let words = |line: &str| line.split_whitespace().map(str::to_owned).collect();
        (1..)
            .zip(text.lines())
            .filter(|(_, text)| !text.trim().is_empty())
            .map(|(line, text)| Self { assignment, line, words: words(text) })
            .collect()
    }

    /// All command lines of assignments 1 to 5, in order: those whose scenes have no textures.
    pub fn of_ray_tracers() -> Vec<Self> {
        (1..=5).flat_map(Self::of_assignment).collect()
    }

    /// All command lines whose pictures have references, in order: those of all ray-tracing
    /// assignments that have programs, but for those that leave samples to chance.
    pub fn with_references() -> Vec<Self> {
        (1..=7).flat_map(Self::of_assignment).filter(|line| !line.leaves_to_chance()).collect()
    }

    /// Whether the line has random or jittered samples, which no rule determines.
    pub fn leaves_to_chance(&self) -> bool {
        self.has("-random_samples") || self.has("-jittered_samples")
    }

    /// Whether a flag is given.
    pub fn has(&self, flag: &str) -> bool {
        self.words.iter().any(|word| word == flag)
    }

    /// The `N` words after a flag.
    ///
    /// # Panics
    /// If there are fewer.
    pub fn values<const N: usize>(&self, flag: &str) -> Option<[&str; N]> {
        let at = self.words.iter().position(|word| word == flag)?;
        Some(std::array::from_fn(|i| self.words[at + 1 + i].as_str()))
    }

    /// The `N` numbers after a flag.
    ///
    /// # Panics
    /// If they are no numbers.
    pub fn numbers<T: FromStr, const N: usize>(&self, flag: &str) -> Option<[T; N]> {
        let number = |text: &str| text.parse().unwrap_or_else(|_| panic!("{self}: `{text}` is no number"));
        Some(self.values::<N>(flag)?.map(number))
    }

    /// The scene file as the line names it, relative to the workspace.
    ///
    /// # Panics
    /// If the line names none.
    pub fn scene(&self) -> &str {
        let [scene] = self.values("-input").unwrap_or_else(|| panic!("{self}: no -input"));
        scene
    }

    /// The scene file where it really is.
    pub fn scene_file(&self) -> PathBuf {
        workspace_file(self.scene())
    }

    /// The pictures that it writes.
    pub fn pictures(&self) -> Vec<Picture> {
        let color = self.values("-output").map(|[file]| (PictureKind::Color, file));
        let depth = self.values("-depth").map(|[_, _, file]| (PictureKind::Depth, file));
        let normals = self.values("-normals").map(|[file]| (PictureKind::Normals, file));
        let samples = self.values("-render_samples").map(|[file, _]| (PictureKind::Samples, file));
        let filter = self.values("-render_filter").map(|[file, _]| (PictureKind::Filter, file));
        let found = [color, depth, normals, samples, filter].into_iter().flatten();
        found.map(|(kind, file)| Picture { kind, file: file.to_owned() }).collect()
    }

    /// The same line with other words after a flag, which is appended if it is not there.
    pub fn with(&self, flag: &str, values: &[&str]) -> Self {
        let mut changed = self.clone();
        let values = values.iter().map(|v| (*v).to_owned());
        match changed.words.iter().position(|word| word == flag) {
            Some(at) => drop(changed.words.splice(at + 1..at + 1 + values.len(), values)),
            None => changed.words.extend([flag.to_owned()].into_iter().chain(values)),
        }
        changed
    }

    /// The same line without a flag that takes no value.
    pub fn without(&self, flag: &str) -> Self {
        let mut changed = self.clone();
        changed.words.retain(|word| word != flag);
        changed
    }

    /// The same line with its scene where it really is, and its pictures in `folder`.
    pub fn redirected(&self, folder: &Path) -> Self {
        let into = |file: &str| folder.join(file).display().to_string();
        let mut line = self.with("-input", &[&self.scene_file().display().to_string()]);
        if let Some([file]) = self.values("-output") {
            line = line.with("-output", &[&into(file)]);
        }
        if let Some([min, max, file]) = self.values("-depth") {
            line = line.with("-depth", &[min, max, &into(file)]);
        }
        for flag in ["-normals", "-render_samples", "-render_filter"] {
            if let Some([file]) = self.values(flag) {
                line = line.with(flag, &[&into(file)]);
            }
        }
        line
    }
}

impl fmt::Display for CommandLine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "A{}.txt:{}: {}", self.assignment, self.line, self.words.join(" "))
    }
}
