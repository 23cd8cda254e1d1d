//! The real programs, each run in a scratch folder of its own.

use crate::workspace_file;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

/// A program under test.
#[derive(Clone, Copy, Debug)]
pub struct Binary {
    /// The executable, `env!("CARGO_BIN_EXE_…")` of its own crate's tests.
    pub path: &'static str,
    /// The assignment that it belongs to.
    pub assignment: u8,
}

/// How a program ended.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The exit code; `None` if a signal killed it.
    pub code: Option<i32>,
    /// What it printed.
    pub stdout: String,
    /// What it complained about.
    pub stderr: String,
}

impl Binary {
    /// The program in `folder`, without a terminal and without a screen to open windows on.
    pub fn command(&self, folder: &Path, args: &[&str]) -> Command {
        let mut command = Command::new(self.path);
        command.args(args).current_dir(folder).stdin(Stdio::null());
        command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").env("COLUMNS", "100");
        command
    }

    /// Runs it to its end.
    ///
    /// # Panics
    /// If it cannot be started.
    pub fn run(&self, folder: &Path, args: &[&str]) -> Outcome {
        let output = self.command(folder, args).output();
        Outcome::of(output.unwrap_or_else(|error| panic!("{}: {error}", self.path)))
    }
}

impl Outcome {
    fn of(output: Output) -> Self {
        let text = |bytes| String::from_utf8(bytes).expect("programs print UTF-8");
        Self { code: output.status.code(), stdout: text(output.stdout), stderr: text(output.stderr) }
    }
}

/// A folder for one run, with files to begin with.
pub struct Scratch {
    folder: TempDir,
}

impl Scratch {
    /// A folder that holds these files, given by name and content.
    ///
    /// # Panics
    /// If there is no room for temporary files.
    pub fn new(files: &[(&str, &[u8])]) -> Self {
        let scratch = Self { folder: tempfile::tempdir().expect("there is room for temporary files") };
        for (name, content) in files {
            fs::write(scratch.file(name), content).expect("there is room for temporary files");
        }
        scratch
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// A file in it.
    pub fn file(&self, name: &str) -> PathBuf {
        self.path().join(name)
    }

    /// Everything in it: names, and the content of files (`None` for folders).
    ///
    /// # Panics
    /// If it cannot be listed.
    pub fn content(&self) -> BTreeMap<PathBuf, Option<Vec<u8>>> {
        let entries = fs::read_dir(self.path()).expect("the scratch folder can be listed");
        let paths = entries.map(|entry| entry.expect("the scratch folder can be listed").path());
        paths.map(|path| (path.clone(), fs::read(path).ok())).collect()
    }
}

/// The bytes of a file of the workspace.
///
/// # Panics
/// If it cannot be read.
pub fn workspace_bytes(path: &str) -> Vec<u8> {
    fs::read(workspace_file(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}
