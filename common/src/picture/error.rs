//! What can go wrong with picture files.

use super::{Kind, Size, SizeError};
use crate::atomic::Unwritable;
use std::io;
use std::path::{Path, PathBuf};

/// Why a picture could not be read or written. Each text names the file.
#[derive(Debug, thiserror::Error)]
pub enum PictureError {
    /// The suffix names no known kind of picture.
    #[error("'{}': {problem}; known are {}{hint}", path.display(), known_suffixes())]
    UnknownSuffix {
        /// The file.
        path: PathBuf,
        /// What is the matter with its suffix.
        problem: String,
        /// What was probably meant, or nothing.
        hint: String,
    },
    /// Nothing can be written there.
    #[error(transparent)]
    Unwritable(#[from] Unwritable),
    /// The format cannot hold a picture of this size.
    #[error("a picture of {size} pixels does not fit a .{suffix} file, whose sides end at {longest}")]
    SideTooLong {
        /// The size asked for.
        size: Size,
        /// The format's suffix.
        suffix: &'static str,
        /// Longest side in pixels.
        longest: u32,
    },
    /// The encoder refused the picture.
    #[error("cannot encode '{}'", path.display())]
    Encode {
        /// The picture to be written.
        path: PathBuf,
        /// The encoder's reason.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
    /// The system refused to read.
    #[error("cannot read picture '{}'", path.display())]
    Read {
        /// The picture to be read.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// The content is not what its kind demands.
    #[error("'{}' is not a valid .{suffix} picture", path.display())]
    Decode {
        /// The picture to be read.
        path: PathBuf,
        /// The kind it was taken for.
        suffix: &'static str,
        /// The decoder's reason.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
    /// Two pictures that should be compared differ in size.
    #[error("the pictures differ in size: {expected} expected, but {actual} found")]
    SizesDiffer {
        /// Size of the reference.
        expected: Size,
        /// Size of the other picture.
        actual: Size,
    },
    /// The size itself is not usable.
    #[error(transparent)]
    Size(#[from] SizeError),
}

impl PictureError {
    /// The error for a path whose suffix (without the dot) names no [`Kind`].
    pub(super) fn unknown_suffix(path: &Path, suffix: &str) -> Self {
        let problem = if suffix.is_empty() {
            "the name needs a suffix that says which kind of picture it is".to_owned()
        } else {
            format!("'.{suffix}' is no kind of picture that can be used here")
        };
        Self::UnknownSuffix { path: path.to_owned(), problem, hint: hint(suffix) }
    }
}

/// The known suffix nearest to `suffix`, as a question, if one is near.
fn hint(suffix: &str) -> String {
    let wanted = suffix.to_ascii_lowercase();
    let distance = |kind: &Kind| strsim::damerau_levenshtein(&wanted, kind.suffix());
    Kind::ALL
        .into_iter()
        .min_by_key(distance)
        .filter(|kind| distance(kind) <= 2)
        .map(|kind| format!("; did you mean .{}?", kind.suffix()))
        .unwrap_or_default()
}

fn known_suffixes() -> String {
    Kind::ALL.map(|kind| format!(".{}", kind.suffix())).join(" ")
}
