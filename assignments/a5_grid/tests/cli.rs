//! The program `a5_grid`, run as its users run it.

use std::fs;
use tests::battery::usage;
use tests::battery::{accepted, scratch};
use tests::binary::Binary;
use tests::workspace_file;

const PROGRAM: Binary = Binary { path: env!("CARGO_BIN_EXE_a5_grid"), assignment: 5 };

tests::battery!(PROGRAM);

#[test]
fn wrong_values_of_its_own_flags_are_refused() {
    usage::own_flags(
        &PROGRAM,
        &[
            ("-output o.tga -grid 0 0 0", &["0 x 0 x 0"]),
            ("-output o.tga -grid -1 5 5", &["-1 x 5 x 5"]),
            ("-output o.tga -grid 100000 100000 100000", &["100000 x 100000 x 100000", "too large"]),
            (
                "-output o.tga -grid 9223372036854775807 9223372036854775807 9223372036854775807",
                &["too large"],
            ),
            ("-output o.tga -grid 99999999999999999999 1 1", &["'99999999999999999999'", "-grid"]),
            ("-output o.tga -grid 5 5", &["-grid", "3"]),
            ("-output o.tga -grid 5 5 many", &["'many'", "-grid"]),
            ("-output o.tga -visualize_grid", &["-visualize_grid", "-grid NX NY NZ"]),
            ("-output o.tga -visualize_grid_count", &["-grid NX NY NZ"]),
            ("-output o.tga -grid 5 5 5 -grid_fit tight", &["'tight'", "bounds, exact"]),
            ("-output o.tga -gird 5 5 5", &["'-grid'"]),
        ],
    );
}

#[test]
fn help_text() {
    let help = accepted(&PROGRAM, &scratch(b""), &["-help"]).stdout;
    insta::assert_snapshot!("help", help);
}

/// Runs the program on a scene of the workspace, writing `new.tga`; returns the picture's bytes
/// and what was printed, or nothing if the machine lacks the instruction set that was asked for.
fn drawn(scene: &str, flags: &str) -> Option<(Vec<u8>, String)> {
    let scene = workspace_file(scene).display().to_string();
    let args = ["-input", &scene, "-output", "new.tga"].into_iter().chain(flags.split_whitespace());
    let scratch = scratch(b"");
    let outcome = PROGRAM.run(scratch.path(), &args.collect::<Vec<_>>());
    if outcome.stderr.contains("does not offer") {
        return None;
    }
    assert_eq!(outcome.code, Some(0), "{flags}\n{}", outcome.stderr);
    Some((fs::read(scratch.file("new.tga")).expect("it was written"), outcome.stdout))
}

/// Property 16, the part that needs a process of its own for each setting.
#[test]
fn a5t3_instruction_sets_never_change_a_picture() {
    for (scene, grid) in [
        ("scenes/scene5_07_bunny_mesh_1k.txt", ""),
        ("scenes/scene5_07_bunny_mesh_1k.txt", "-grid 15 15 12"),
        ("scenes/scene4_14_faceted_gem.txt", "-grid 9 9 9"),
        ("scenes/scene5_12_nested_transformations.txt", "-grid 5 6 7"),
    ] {
        let flags = |simd: &str| format!("-size 90 90 -shadows -bounces 3 -shade_back {grid} -simd {simd}");
        let expected = drawn(scene, &flags("baseline")).expect("every machine has it").0;
        for simd in ["auto", "sse4", "avx2", "avx512"] {
            let Some((picture, _)) = drawn(scene, &flags(simd)) else { continue };
            assert!(picture == expected, "{scene} {grid}: -simd {simd} changes the picture");
        }
    }
}

/// Times differ from run to run: everything from their first digit on becomes `#`.
fn without_times(stats: &str) -> String {
    let timed =
        |line: &str| ["total time", "rays per second", "time:"].iter().any(|name| line.contains(name));
    let name = |line: &str| line.split(|c: char| c.is_ascii_digit()).next().unwrap_or_default().to_owned();
    let mask = |line| if timed(line) { format!("{} #", name(line).trim_end()) } else { line.to_owned() };
    stats.lines().map(mask).collect::<Vec<_>>().join("\n")
}

#[test]
fn a5t4_statistics() {
    let flags = "-size 60 60 -shadows -bounces 2 -grid 8 7 6 -simd baseline -stats";
    let (_, stats) = drawn("scenes/scene4_05_transparent_bar.txt", flags).expect("every machine has it");
    insta::assert_snapshot!("stats", without_times(&stats));
}

/// The picture of cells needs no hits, and none are looked for; with a picture of normals beside
/// it they are, and the cells look the same.
#[test]
fn a5t2_the_picture_of_cells_builds_nothing_for_hits() {
    let scene = "scenes/scene5_06_bunny_mesh_200.txt";
    let cells = "-size 50 50 -grid 10 10 7 -visualize_grid -stats";
    let (alone, stats) = drawn(scene, cells).expect("no instruction set is asked for");
    assert!(stats.contains("skipped: a structure for hits"), "{stats}");
    assert!(stats.contains("num non-shadow rays        2500\n"), "{stats}");
    assert!(stats.contains("total intersections        0\n"), "{stats}");
    let (beside, stats) = drawn(scene, &format!("{cells} -normals n.tga")).expect("as before");
    assert!(!stats.contains("skipped: a structure for hits"), "{stats}");
    assert!(alone == beside);
    let (needless, stats) = drawn(scene, &format!("{cells} -noskip lazy")).expect("as before");
    assert!(stats.contains("structures built                     1\n"), "{stats}");
    assert!(alone == needless);
    let (counted, _) = drawn(scene, &cells.replace("grid -stats", "grid_count")).expect("as before");
    assert!(alone == counted);
}
