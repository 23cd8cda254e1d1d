//! The course's own command lines, through the real program.

use super::accepted;
use crate::CommandLine;
use crate::binary::{Binary, Scratch};
use std::fs;
use std::path::Path;

/// Side of the pictures, in place of the course's.
const SIDE: u16 = 40;

/// Runs every command line of the program's assignment, with smaller pictures; each must write
/// its pictures, and nothing else.
///
/// # Panics
/// If one fails.
pub fn command_lines(binary: &Binary) {
    let lines = CommandLine::of_assignment(binary.assignment);
    assert!(!lines.is_empty());
    let side = SIDE.to_string();
    for line in lines {
        let scratch = Scratch::new(&[]);
        let small = line.redirected(scratch.path()).with("-size", &[&side, &side]);
        let args: Vec<&str> = small.words[1..].iter().map(String::as_str).collect();
        accepted(binary, &scratch, &args);
        let pictures = line.pictures();
        assert_eq!(scratch.content().len(), pictures.len(), "{line}");
        pictures
            .iter()
            .for_each(|picture| check_tga(&scratch.file(&picture.file), side_of(&line, &picture.file)));
    }
}

/// Side of a picture: those of samples and filters are enlarged, the latter with a line more.
fn side_of(line: &CommandLine, file: &str) -> u16 {
    let after = |flag: &str| {
        let at = line.words.iter().position(|word| word == flag)?;
        let zoom: u16 = line.words.get(at + 2)?.parse().ok()?;
        (line.words[at + 1] == file).then_some(SIDE * zoom)
    };
    after("-render_samples").or_else(|| Some(after("-render_filter")? + 1)).unwrap_or(SIDE)
}

/// The course's TGA: 18 bytes of header, uncompressed colours of 24 bits, origin at the top.
fn check_tga(path: &Path, side: u16) {
    let bytes = fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let [low, high] = side.to_le_bytes();
    let header = [0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, low, high, low, high, 24, 0x20];
    assert_eq!(bytes[..18], header, "{}", path.display());
    assert_eq!(bytes.len(), 18 + 3 * usize::from(side).pow(2), "{}", path.display());
}
