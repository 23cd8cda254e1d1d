//! Odd input that is good all the same.

use super::{GOOD, accepted, flags, scratch};
use crate::binary::{Binary, Scratch};
use common::picture::{Film, Transfer, read};
use std::fs;
use std::process::Stdio;

const SIZE: [&str; 3] = ["-size", "24", "16"];

/// The picture that a scratch folder holds after a run.
fn picture(scratch: &Scratch, name: &str) -> Film {
    read(&scratch.file(name), Transfer::Linear).unwrap_or_else(|error| panic!("{error}"))
}

/// The good scene, drawn plainly.
fn expected(binary: &Binary) -> Vec<u8> {
    let scratch = scratch(b"");
    accepted(binary, &scratch, &["-input", "good.txt", "-size", "24", "16", "-output", "old.tga"]);
    fs::read(scratch.file("old.tga")).expect("the picture was written")
}

/// Other spellings of flags and numbers give the same picture.
///
/// # Panics
/// If one does not.
pub fn spellings(binary: &Binary) {
    let expected = expected(binary);
    for line in [
        "--input good.txt --size 24 16 --output old.tga",
        "-input=good.txt -size 24 16 -output=old.tga",
        "-output old.tga -input good.txt -size 24 16",
        "-size 24 +16 -input ./good.txt -output ./old.tga",
        "-input good.txt -size 8 8 -size 24 16 -output old.tga",
        "-input good.txt -size 24 16 -output old.tga -threads 3 -tile 5 -quiet",
    ] {
        let scratch = scratch(b"");
        accepted(binary, &scratch, &line.split_whitespace().collect::<Vec<_>>());
        assert!(fs::read(scratch.file("old.tga")).ok() == Some(expected.clone()), "{line}");
    }
}

/// Other spellings of the scene give the same picture.
///
/// # Panics
/// If one does not.
pub fn scenes(binary: &Binary) {
    let expected = expected(binary);
    let spaced = GOOD.replace('{', " {\n").replace('}', "\n}\n").replace(' ', "\t ");
    let tight = GOOD.replace(" {", "{").replace(" }", "}");
    let commented = GOOD.replace('\n', " # a comment { } 7\n// another\n");
    let texts = [GOOD.replace('\n', "\r\n"), format!("\u{feff}{GOOD}"), spaced, tight, commented];
    for text in texts {
        let scratch = scratch(text.as_bytes());
        let args = ["-input", "scene.txt", "-size", "24", "16", "-output", "old.tga"];
        accepted(binary, &scratch, &args);
        assert!(fs::read(scratch.file("old.tga")).ok() == Some(expected.clone()), "{text}");
    }
}

/// Every kind of picture can be written, and read back as the picture that it is.
///
/// # Panics
/// If one cannot.
pub fn kinds_of_pictures(binary: &Binary) {
    let scratch = scratch(b"");
    let draw = |name: &str| {
        let args = ["-input", "good.txt", "-output", name];
        accepted(binary, &scratch, &[&args[..], &SIZE[..]].concat());
        picture(&scratch, name)
    };
    let linear = draw("o.pfm");
    assert_eq!(linear, draw("o.exr"), "both hold 32-bit floats");
    let levels = draw("o.tga");
    assert_eq!(levels, draw("o.png"));
    assert_eq!(levels, draw("O.PPM"));
    let same_levels = |a: &Film, b: &Film, off: i32| {
        let of =
            |film: &Film| film.pixels().iter().flat_map(|c| Transfer::Linear.levels(*c)).collect::<Vec<_>>();
        of(a).iter().zip(of(b)).all(|(a, b)| (i32::from(*a) - i32::from(b)).abs() <= off)
    };
    assert!(same_levels(&linear, &levels, 0), "trunc(255 c)");
    // Eight bits with a shared exponent: a channel of half the size of the largest has seven.
    assert!(same_levels(&linear, &draw("o.hdr"), 4), "radiance");
}

/// A reader that goes away early is no error, and the picture is still written.
///
/// # Panics
/// If the program fails, or does not write the picture.
pub fn closed_stdout(binary: &Binary) {
    let scratch = scratch(b"");
    let args = ["-input", "good.txt", "-output", "new.tga", "-stats"];
    let mut command = binary.command(scratch.path(), &args);
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("it can be started");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("it ends");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!((output.status.code(), &*stderr), (Some(0), ""));
    assert_eq!(picture(&scratch, "new.tga").width(), 100);
}

/// `-h`, `-help`, `--help`, `-V` print to stdout and succeed; the help names every flag of this
/// assignment and those below, and `-help` says more about them than `-h`.
///
/// # Panics
/// If they do not.
pub fn help(binary: &Binary) {
    let scratch = scratch(b"");
    let [short, long, dashed] =
        ["-h", "-help", "--help"].map(|flag| accepted(binary, &scratch, &[flag]).stdout);
    assert!(long == dashed && short.len() < long.len());
    for flag in flags::up_to(binary.assignment) {
        let lists = |text: &str| text.lines().any(|line| line.trim_start().split(' ').next() == Some(flag));
        assert!(lists(&short) && lists(&long), "{flag} is not listed");
    }
    assert!(accepted(binary, &scratch, &["-V"]).stdout.contains(env!("CARGO_PKG_VERSION")));
}
