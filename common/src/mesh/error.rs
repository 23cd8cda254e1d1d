//! What is wrong with mesh files, and reading them whole.

use std::fs::File;
use std::io::Read;
use std::path::Path;

/// Largest mesh file that is read, in bytes.
const MOST_BYTES: u64 = 1 << 30;

/// Why a mesh could not be read: the file, the line if there is one, and the reason.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub struct MeshError {
    file: Option<String>,
    line: Option<usize>,
    message: String,
}

impl std::fmt::Display for MeshError {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        if let Some(file) = &self.file {
            write!(f, "{file}:")?;
        }
        if let Some(line) = self.line {
            write!(f, "{line}:")?;
        }
        let space = if self.file.is_some() || self.line.is_some() { " " } else { "" };
        write!(f, "{space}{}", self.message)
    }
}

impl MeshError {
    /// An error of no particular file.
    pub fn new(message: impl Into<String>) -> Self {
        Self { file: None, line: None, message: message.into() }
    }

    /// Line of the file, from 1, if the error has one.
    pub fn line(&self) -> Option<usize> {
        self.line
    }

    /// An error in a line, counted from 1.
    pub fn at_line(line: usize, message: impl Into<String>) -> Self {
        Self { line: Some(line), ..Self::new(message) }
    }

    /// The same, said of a file.
    #[must_use]
    pub fn in_file(self, name: &str) -> Self {
        Self { file: Some(name.to_owned()), ..self }
    }
}

/// The bytes of a mesh file.
///
/// # Errors
/// If the file cannot be read or is larger than 1 GiB.
pub fn read_bytes(path: &Path) -> Result<Vec<u8>, MeshError> {
    let fail = |error: std::io::Error| MeshError::new(error.to_string());
    let read = || {
        let mut bytes = Vec::new();
        File::open(path).map_err(fail)?.take(MOST_BYTES + 1).read_to_end(&mut bytes).map_err(fail)?;
        match bytes.len() as u64 > MOST_BYTES {
            true => Err(MeshError::new(format!("the file is larger than {} MiB", MOST_BYTES >> 20))),
            false => Ok(bytes),
        }
    };
    read().map_err(|error| error.in_file(&path.display().to_string()))
}
