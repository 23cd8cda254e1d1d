//! The program `a6_kdtree`, run as its users run it.

use tests::battery::usage;
use tests::battery::{accepted, scratch};
use tests::binary::Binary;

const PROGRAM: Binary = Binary { path: env!("CARGO_BIN_EXE_a6_kdtree"), assignment: 6 };

tests::battery!(PROGRAM);

#[test]
fn wrong_values_of_its_own_flags_are_refused() {
    usage::own_flags(
        &PROGRAM,
        &[
            ("-output o.tga -accel grid", &["-accel grid needs -grid NX NY NZ"]),
            ("-output o.tga -accel tree", &["'tree'", "auto, list, grid, kdtree, bvh"]),
            ("-output o.tga -kdtree middle", &["'middle'", "median, objects, sah"]),
            ("-output o.tga -kdtree -kd_max_depth 61", &["61", "-kd_max_depth"]),
            ("-output o.tga -kdtree -kd_leaf -1", &["-1", "-kd_leaf"]),
            ("-output o.tga -visualize_kdtree -visualize_grid -grid 2 2 2", &["give one of them"]),
            ("-visualize_kdtree", &["nothing to do"]),
            ("-output o.tga -heat", &["-heat"]),
            ("-heat h.png 0", &["HOTTEST", "above 0, not `0`"]),
            ("-heat h.png -3", &["above 0, not `-3`"]),
            ("-heat h.png many", &["above 0, not `many`"]),
            ("-heat h.png 1 2", &["'2'"]),
            ("-heat h.doc", &["h.doc"]),
            ("-heat o.tga -output ./o.tga", &["two pictures"]),
            ("-heat good.txt", &["good.txt"]),
            ("-output o.tga -visualise_kdtree", &["'-visualize_kdtree'"]),
        ],
    );
}

/// What has no effect is warned of, and done without.
#[test]
fn flags_without_effect_are_warned_of() {
    for (flags, warning) in [
        ("-accel list -visualize_kdtree", "-accel has no effect with -visualize_kdtree"),
        ("-visualize_kdtree -shadows", "-shadows, -bounces and -trace have no effect"),
        ("-kdtree -accel bvh", "-kdtree has no effect with this -accel"),
        ("-kd_leaf 4", "-kd_max_depth and -kd_leaf have no effect without a kd-tree"),
        ("-visualize_kdtree -grid 2 2 2", "-grid has no effect"),
    ] {
        let words = format!("-input good.txt -output new.tga -size 20 20 {flags}");
        let scratch = scratch(b"");
        let outcome = accepted(&PROGRAM, &scratch, &words.split_whitespace().collect::<Vec<_>>());
        assert!(outcome.stderr.contains(warning), "{flags}: {}", outcome.stderr);
        assert!(scratch.file("new.tga").exists(), "{flags}");
    }
}

#[test]
fn help_text() {
    let help = accepted(&PROGRAM, &scratch(b""), &["-help"]).stdout;
    insta::assert_snapshot!("help", help);
}
