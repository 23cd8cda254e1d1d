//! The program `a1_ray_casting`, run as its users run it.

use tests::battery::usage;
use tests::battery::{accepted, refused, scratch};
use tests::binary::Binary;
use tests::workspace_file;

const PROGRAM: Binary = Binary { path: env!("CARGO_BIN_EXE_a1_ray_casting"), assignment: 1 };

tests::battery!(PROGRAM);

#[test]
fn wrong_values_of_its_own_flags_are_refused() {
    usage::own_flags(
        &PROGRAM,
        &[
            ("-output o.tga -depth 1 2 d.bmp", &["'d.bmp'"]),
            ("-depth 1 2 nowhere/d.tga", &["'nowhere/d.tga'"]),
            ("-depth -1e-400 0 d.tga", &["-depth"]),
        ],
    );
}

#[test]
fn help_text() {
    let help = accepted(&PROGRAM, &scratch(b""), &["-h"]).stdout;
    insta::assert_snapshot!("short_help", help);
}

#[test]
fn a1t1_one_ball_takes_one_ray_and_one_test_per_pixel() {
    let scene = workspace_file("scenes/scene1_01.txt").display().to_string();
    let args = ["-input", &scene, "-size", "200", "200", "-output", "new.tga", "-stats"];
    let stats = accepted(&PROGRAM, &scratch(b""), &args).stdout;
    for line in ["num non-shadow rays        40000", "total intersections        40000"] {
        assert!(stats.lines().any(|found| found.trim() == line), "{line}\n{stats}");
    }
}

#[test]
fn flags_of_later_assignments_are_unknown() {
    for flag in ["-normals", "-shadows", "-grid"] {
        refused(&PROGRAM, &scratch(b""), &["-input", "good.txt", "-output", "o.tga", flag], &[flag]);
    }
}
