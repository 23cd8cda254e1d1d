//! Files of iterated function systems.

use super::family::{Sample, refusal};
use super::scenes::texts;
use crate::kit::repository;
use std::path::Path;

/// The repository's, and one that promises more maps than any memory holds.
pub fn samples() -> Vec<Sample> {
    let mut all = texts(&repository().join("scenes"), |n| n.ends_with(".txt") && !n.starts_with("scene"));
    assert!(all.len() >= 4, "the iterated function systems of the repository");
    all.push(Sample { name: "promise".to_owned(), bytes: b"4000000000 0.5 1 0 0 0 1 0 0 0 1".to_vec() });
    all
}

/// Maps, or an error with a place in the text.
pub fn read(_: &str, bytes: &[u8]) -> Result<(), String> {
    let text = String::from_utf8_lossy(bytes);
    match a0_ifs::parse(Path::new("hostile.txt"), &text) {
        Ok(_) => Ok(()),
        Err(error) if error.position().is_none() => Err(format!("a refusal without a place: {error}")),
        Err(error) => refusal(&error.to_string()),
    }
}
