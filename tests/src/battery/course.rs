//! The course's own command lines, through the real program.

use super::accepted;
use crate::CommandLine;
use crate::binary::{Binary, Scratch};
use std::fs;
use std::path::Path;

/// Side of the pictures, in place of the course's.
const SIDE: &str = "40";

/// Runs every command line of the program's assignment, with smaller pictures; each must write
/// its pictures, and nothing else.
///
/// # Panics
/// If one fails.
pub fn command_lines(binary: &Binary) {
    let lines = CommandLine::of_assignment(binary.assignment);
    assert!(!lines.is_empty());
    for line in lines {
        let scratch = Scratch::new(&[]);
        let small = line.redirected(scratch.path()).with("-size", &[SIDE, SIDE]);
        let args: Vec<&str> = small.words[1..].iter().map(String::as_str).collect();
        accepted(binary, &scratch, &args);
        let pictures = line.pictures();
        assert_eq!(scratch.content().len(), pictures.len(), "{line}");
        pictures.iter().for_each(|picture| check_tga(&scratch.file(&picture.file)));
    }
}

/// The course's TGA: 18 bytes of header, uncompressed colours of 24 bits, origin at the top.
fn check_tga(path: &Path) {
    let bytes = fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let header = [0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 40, 0, 40, 0, 24, 0x20];
    assert_eq!(bytes[..18], header, "{}", path.display());
    assert_eq!(bytes.len(), 18 + 40 * 40 * 3, "{}", path.display());
}
