//! Wrong command lines: flags, numbers, and places to write to.

use super::{GOOD, refused, scratch};
use crate::binary::Binary;

/// Command lines after `-input good.txt`, and what must be said about them.
type Case = (&'static str, &'static [&'static str]);

const FLAGS: &[Case] = &[
    ("-outptu o.tga", &["'-outptu'", "'-output'"]),
    ("--outptu o.tga", &["'-outptu'", "'-output'"]),
    ("-output", &["'-output <PICTURE>'"]),
    ("-output o.tga extra", &["'extra'"]),
    ("-output o.tga -size 9", &["-size", "2"]),
    ("-output o.tga -size nine 9", &["'nine'", "-size"]),
    ("-output o.tga -size 9.5 9", &["'9.5'", "-size"]),
    ("-output o.tga -threads 0", &["'0'", "-threads"]),
    ("-output o.tga -threads many", &["'many'", "-threads"]),
    ("-output o.tga -tile 0", &["'0'", "-tile"]),
    ("-output o.tga -simd mmx", &["'mmx'", "baseline, sse4, avx2"]),
    ("-output o.tga -noskip sleep", &["'sleep'", "tile, behind, dark, inside, black"]),
    ("-output o.tga -quiet -verbose", &["-quiet", "-verbose"]),
    ("", &["nothing to do", "-output"]),
];

const NUMBERS: &[Case] = &[
    ("-output o.tga -size 0 0", &["0 x 0"]),
    ("-output o.tga -size -5 5", &["-5 x 5"]),
    ("-output o.tga -size 5 -0", &["5 x 0"]),
    ("-output o.tga -size 1000000000000 1", &["1000000000000 x 1", "too large"]),
    ("-output o.tga -size 99999999999999999999 1", &["99999999999999999999", "-size"]),
    ("-output o.tga -size 70000 1", &["65535"]),
    ("-output o.tga -depth 5 5 d.tga", &["-depth", "both 5"]),
    ("-output o.tga -depth near 5 d.tga", &["-depth", "`near`"]),
    ("-output o.tga -depth nan 5 d.tga", &["-depth", "`nan`"]),
    ("-output o.tga -depth 1 inf d.tga", &["-depth", "`inf`"]),
    ("-output o.tga -depth 1 2", &["-depth", "3"]),
];

const OUTPUTS: &[Case] = &[
    ("-output o.bmp", &["'o.bmp'", ".tga .png"]),
    ("-output o.tgaa", &["'.tgaa'", "did you mean .tga?"]),
    ("-output o", &["'o'", "suffix"]),
    ("-output nowhere/o.tga", &["'nowhere/o.tga'", "no folder 'nowhere'"]),
    ("-output good.txt/o.tga", &["'good.txt/o.tga'"]),
    ("-output folder.tga", &["'folder.tga'", "folder"]),
    ("-output good.txt", &["good.txt", "is the scene"]),
    ("-output same.tga -depth 1 2 same.tga", &["two pictures", "same.tga"]),
    ("-output same.tga -depth 1 2 ./same.tga", &["two pictures", "same.tga"]),
    ("-output folder.tga/../old.tga -depth 1 2 old.tga", &["two pictures", "old.tga"]),
    ("-output old.tga -depth 1 2 nowhere/d.tga", &["'nowhere/d.tga'"]),
];

fn all_refused(binary: &Binary, cases: &[Case]) {
    for (flags, needles) in cases {
        let args: Vec<&str> = ["-input", "good.txt"].into_iter().chain(flags.split_whitespace()).collect();
        refused(binary, &scratch(b""), &args, needles);
    }
}

/// Unknown flags, missing and misplaced values.
///
/// # Panics
/// If a case is not refused as it should be.
pub fn wrong_flags(binary: &Binary) {
    all_refused(binary, FLAGS);
    refused(binary, &scratch(b""), &[], &["-input"]);
    refused(binary, &scratch(b""), &["-output", "o.tga"], &["-input"]);
}

/// Sizes and ranges that make no picture.
///
/// # Panics
/// If a case is not refused as it should be.
pub fn wrong_numbers(binary: &Binary) {
    all_refused(binary, NUMBERS);
}

/// Places that a picture cannot be written to.
///
/// # Panics
/// If a case is not refused as it should be.
pub fn wrong_outputs(binary: &Binary) {
    all_refused(binary, OUTPUTS);
    // A scene may have a picture's name, and a name may be spelt in several ways.
    let scene = crate::binary::Scratch::new(&[("scene.tga", GOOD.as_bytes())]);
    for (input, output) in [("scene.tga", "./scene.tga"), ("./scene.tga", "scene.tga")] {
        refused(binary, &scene, &["-input", input, "-output", output], &["is the scene"]);
    }
    // Not even root can make files there.
    #[cfg(target_os = "linux")]
    all_refused(binary, &[("-output /proc/o.tga", &["cannot write '/proc/o.tga'"])]);
}

/// The cases of one assignment's own flags.
///
/// # Panics
/// If a case is not refused as it should be.
pub fn own_flags(binary: &Binary, cases: &[Case]) {
    all_refused(binary, cases);
}
