//! The program `a7_sampling`, run as its users run it.

use common::picture::{Transfer, read};
use tests::battery::usage;
use tests::battery::{accepted, scratch};
use tests::binary::Binary;

const PROGRAM: Binary = Binary { path: env!("CARGO_BIN_EXE_a7_sampling"), assignment: 7 };

tests::battery!(PROGRAM);

#[test]
fn wrong_patterns_and_filters_are_refused() {
    usage::own_flags(
        &PROGRAM,
        &[
            ("-output o.tga -jittered_samples 8", &["-jittered_samples", "4 or 9, not 8"]),
            ("-output o.tga -uniform_samples 2", &["-uniform_samples", "1 or 4, not 2"]),
            ("-output o.tga -random_samples 0", &["'0'", "-random_samples"]),
            ("-output o.tga -random_samples 4 -jittered_samples 4", &["-random_samples", "cannot"]),
            ("-output o.tga -random_samples 4 -samples 4", &["-samples", "cannot"]),
            ("-output o.tga -sampler sobel", &["'sobel'", "sobol"]),
            ("-output o.tga -samples many", &["'many'", "-samples"]),
            ("-output o.tga -seed -1", &["'-1'", "-seed"]),
            ("-render_samples s.tga 0", &["-render_samples", "ZOOM", "`0`"]),
            ("-render_samples s.tga", &["-render_samples", "2"]),
            ("-render_samples o.tga 4 -output o.tga", &["two pictures"]),
            ("-render_samples s.tga 4096 -size 9999 9", &["too large"]),
            ("-output o.tga -box_filter 0", &["radius", "above 0"]),
            ("-output o.tga -tent_filter 17", &["at most 16.5"]),
            ("-output o.tga -gaussian_filter nan", &["radius", "NaN"]),
            ("-output o.tga -box_filter 1 -tent_filter 1", &["-box_filter", "cannot"]),
            ("-output o.tga -filter sinc 1", &["`sinc`", "mitchell"]),
            ("-output o.tga -filter lanczos wide", &["RADIUS", "`wide`"]),
            ("-render_filter f.tga 10", &["-render_filter needs a filter"]),
            ("-render_filter f.doc 10 -box_filter 1", &["f.doc"]),
        ],
    );
}

#[test]
fn wrong_values_of_the_other_flags_are_refused() {
    usage::own_flags(
        &PROGRAM,
        &[
            ("-output o.tga -adaptive 0", &["-adaptive wants a number above 0, not 0"]),
            ("-output o.tga -adaptive nan", &["-adaptive", "NaN"]),
            ("-output o.tga -adaptive 0.1 -sampler jittered", &["can go on", "sobol"]),
            ("-output o.tga -adaptive 0.1 -jittered_samples 4", &["-adaptive", "cannot"]),
            ("-output o.tga -samples_image s.tga", &["-adaptive"]),
            ("-samples_image o.tga -adaptive 0.1 -output o.tga", &["two pictures"]),
            ("-samples_image s.doc -adaptive 0.1", &["s.doc"]),
            ("-output o.tga -adaptive 0.1 -size 16384 16384 -filter lanczos 3", &["GiB", "at most 8"]),
            ("-output o.tga -aperture -1 -samples 4", &["-aperture", "at least 0"]),
            ("-output o.tga -aperture 1 -samples 4", &["no lens", "-focal_distance"]),
            ("-output o.tga -focal_distance 0 -aperture 1", &["-focal_distance", "above 0"]),
            ("-output o.tga -blades 2", &["-blades", "2"]),
            ("-output o.tga -blades 5", &["no lens", "-aperture"]),
            ("-output o.tga -light_samples 0", &["-light_samples", "'0'"]),
            ("-output o.tga -light_samples 4 -hard_lights", &["-light_samples", "cannot"]),
            ("-output o.tga -smooth -smooth_edges 0.1", &["-smooth", "cannot"]),
            ("-output o.tga -smooth_edges -1", &["-smooth_edges", "at least 0"]),
            ("-output o.tga -zoom 0", &["-zoom", "above 0, not 0"]),
            ("-output o.tga -orbit 10", &["-orbit", "2"]),
            ("-output o.tga -shift 0 0 inf", &["-shift", "inf"]),
        ],
    );
}

#[test]
fn a7t6_statistics_and_the_picture_of_the_samples_agree() {
    let scratch = scratch(b"");
    let args = "-input good.txt -size 41 31 -samples_image counts.pfm -adaptive 0.005 -samples 64 -stats";
    let outcome = accepted(&PROGRAM, &scratch, &args.split(' ').collect::<Vec<_>>());
    let note = outcome.stdout.lines().find(|line| line.contains("samples taken")).expect("a note");
    assert!(note.contains("Sobol, error 0.005") && note.contains("least 8, most 64"), "{note}");
    let film = read(&scratch.file("counts.pfm"), Transfer::Linear).unwrap();
    // Dark grey for 8, white for 64, equal steps between.
    let count = |grey: f32| 8.0 * 2f32.powf((grey - 0.1) / 0.9 * 3.0).round();
    let total: f32 = film.pixels().iter().map(|pixel| count(pixel.x)).sum();
    assert!(note.contains(&format!("samples taken: {total};")), "{note} {total}");
    assert!(!scratch.file("o.tga").exists());
}

#[test]
fn help_text() {
    let help = accepted(&PROGRAM, &scratch(b""), &["-help"]).stdout;
    insta::assert_snapshot!("help", help);
}
