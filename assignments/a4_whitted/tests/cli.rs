//! The program `a4_whitted`, run as its users run it.

use tests::battery::{accepted, scratch, usage};
use tests::binary::Binary;
use tests::workspace_file;

const PROGRAM: Binary = Binary { path: env!("CARGO_BIN_EXE_a4_whitted"), assignment: 4 };

tests::battery!(PROGRAM);

#[test]
fn wrong_values_of_its_own_flags_are_refused() {
    usage::own_flags(
        &PROGRAM,
        &[
            ("-output o.tga -bounces -1", &["'-1'", "-bounces"]),
            ("-output o.tga -bounces 1.5", &["'1.5'", "-bounces"]),
            ("-output o.tga -bounces 99999999999", &["'99999999999'", "-bounces"]),
            ("-output o.tga -bounces 1 -weight nan", &["-weight"]),
            ("-output o.tga -bounces 1 -weight -0.1", &["-weight"]),
            ("-output o.tga -bounces 1 -weight light", &["'light'", "-weight"]),
            ("-output o.tga -shadow", &["'-shadows'"]),
            ("-trace 100 5", &["-trace", "pixel 100 5", "100 x 100"]),
            ("-trace 5", &["-trace", "2"]),
            ("-trace -1 5", &["'-1'", "-trace"]),
        ],
    );
}

/// A pixel's ray tree: mirrors, and glass with light that is caught inside.
#[test]
fn a4t4_ray_trees() {
    for (name, scene, flags) in [
        ("mirrors", "scenes/scene4_04_reflective_sphere.txt", "-shadows -bounces 3 -trace 84 78"),
        (
            "glass",
            "scenes/scene4_09_transparent_sphere_2.0.txt",
            "-shadows -bounces 2 -shade_back -trace 88 120",
        ),
        (
            "coloured_shadows",
            "scenes/scene4_07_transparent_sphere_1.0.txt",
            "-shadows -transparent_shadows -trace 85 5",
        ),
    ] {
        let scene = workspace_file(scene).display().to_string();
        let flags = flags.split_whitespace();
        let args: Vec<&str> = ["-input", &scene, "-size", "200", "200"].into_iter().chain(flags).collect();
        let tree = accepted(&PROGRAM, &scratch(b""), &args).stdout;
        insta::assert_snapshot!(name, tree);
    }
}
