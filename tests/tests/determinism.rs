//! The same command gives the same picture, bit for bit, on any number of threads and with any
//! size of tiles. (Instruction sets are chosen once per process: see `a5_grid/tests/cli.rs`.)

use tests::stage::{Films, Stage};

/// A scene of glass, one of many triangles, and one under nested transforms.
const SCENES: [&str; 3] = [
    "scenes/scene4_06_transparent_bars.txt",
    "scenes/scene5_07_bunny_mesh_1k.txt",
    "scenes/scene5_12_nested_transformations.txt",
];

/// An odd size, so that tiles are cut off at both borders.
const FLAGS: &str = "-size 101 67 -shadows -bounces 3 -weight 0.01 -shade_back";

fn films(stage: &Stage) -> Films {
    let grid = stage.grid([9, 8, 7]).expect("these scenes have finite objects");
    stage.films(grid.as_accel())
}

#[test]
fn threads_and_tiles_never_change_a_picture() {
    for scene in SCENES {
        let mut stage = Stage::open(scene, FLAGS);
        let expected = films(&stage);
        for threads in [1, 2, 3, 7, 16] {
            for tile in [1, 5, 16, 64] {
                stage.general().program.threads = Some(threads);
                stage.general().tile = Some(tile);
                let actual = films(&stage);
                let what = format!("{scene}: {threads} threads, tiles of {tile}");
                assert_eq!(expected.first_difference(&actual), None, "{what}");
                let work =
                    |f: &Films| (f.counters.rays + f.counters.skipped_empty_tile, f.counters.shadow_rays);
                assert_eq!(work(&expected), work(&actual), "{what}: rays");
            }
        }
    }
}
