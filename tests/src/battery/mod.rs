//! Good and hostile input for the real programs; every assignment's `tests/cli.rs` runs it.
//!
//! A refusal has a form: exit code 2, nothing on stdout, one message on stderr that says what is
//! wrong, no trace of a panic, no file left behind and none touched.

pub mod course;
pub mod flags;
pub mod odd;
pub mod scenes;
pub mod usage;

use crate::binary::{Binary, Outcome, Scratch, workspace_bytes};

/// A small scene that every program draws: a sphere, a plane, and a mesh under a transform.
pub const GOOD: &str = "OrthographicCamera {
    center 0 0 5
    direction 0 0 -1
    up 0 1 0
    size 5
}
Background { color 0 0 0.5 }
Lights {
    numLights 1
    DirectionalLight { direction 0 -1 -1  color 1 1 1 }
}
Materials {
    numMaterials 1
    PhongMaterial { diffuseColor 1 0.5 0 }
}
Group {
    numObjects 3
    MaterialIndex 0
    Sphere { center 0 0 0  radius 1 }
    Plane { normal 0 1 0  offset -1 }
    Transform { Scale 1 2 1  TriangleMesh { obj_file cube.obj } }
}
";

/// What an old file holds, to see whether it is touched.
const OLD: &[u8] = b"an old file that nobody may touch";

/// A scratch folder with [`GOOD`] as `good.txt`, `text` as `scene.txt`, the mesh, an old
/// picture, and a folder whose name looks like a picture's.
pub fn scratch(text: &[u8]) -> Scratch {
    let mesh = workspace_bytes("scenes/meshes/cube.obj");
    let good = GOOD.as_bytes();
    let files = [("good.txt", good), ("scene.txt", text), ("cube.obj", &mesh), ("old.tga", OLD)];
    let scratch = Scratch::new(&files);
    std::fs::create_dir(scratch.file("folder.tga")).expect("there is room for temporary files");
    scratch
}

/// Runs `binary` in a scratch folder and checks the form of its refusal; `needles` are parts of
/// the message.
///
/// # Panics
/// If it is not refused in that form.
pub fn refused(binary: &Binary, scratch: &Scratch, args: &[&str], needles: &[&str]) {
    let before = scratch.content();
    let outcome = binary.run(scratch.path(), args);
    let what = format!("{} {}\n{}", binary.path, args.join(" "), outcome.stderr);
    assert_eq!(outcome.code, Some(2), "exit code of {what}");
    assert_eq!(outcome.stdout, "", "stdout of {what}");
    assert_eq!(errors(&outcome), 1, "one message, not several or none: {what}");
    let panicked = ["panicked", "RUST_BACKTRACE", "src/"].iter().any(|trace| outcome.stderr.contains(trace));
    assert!(!panicked, "trace of a panic: {what}");
    for needle in needles {
        assert!(outcome.stderr.contains(needle), "`{needle}` is not said: {what}");
    }
    assert!(before == scratch.content(), "files were left behind or touched: {what}");
}

/// Runs `binary` in a scratch folder and checks that it succeeds, without an error or a panic.
///
/// # Panics
/// If it does not.
pub fn accepted(binary: &Binary, scratch: &Scratch, args: &[&str]) -> Outcome {
    let outcome = binary.run(scratch.path(), args);
    let what = format!("{} {}\n{}", binary.path, args.join(" "), outcome.stderr);
    assert_eq!((outcome.code, errors(&outcome)), (Some(0), 0), "{what}");
    outcome
}

/// How many error messages there are.
fn errors(outcome: &Outcome) -> usize {
    outcome.stderr.lines().filter(|line| line.starts_with("error")).count()
}

/// The tests that every ray tracer must pass: takes its [`Binary`].
#[macro_export]
macro_rules! battery {
    ($program:expr) => {
        #[test]
        fn course_command_lines_run() {
            $crate::battery::course::command_lines(&$program);
        }

        #[test]
        fn classic_mistakes_in_scenes_are_refused() {
            $crate::battery::scenes::classic_mistakes(&$program);
        }

        #[test]
        fn what_is_no_scene_is_refused() {
            $crate::battery::scenes::not_a_scene(&$program);
        }

        #[test]
        fn wrong_meshes_are_refused() {
            $crate::battery::scenes::wrong_meshes(&$program);
        }

        #[test]
        fn wrong_flags_are_refused() {
            $crate::battery::usage::wrong_flags(&$program);
        }

        #[test]
        fn wrong_numbers_are_refused() {
            $crate::battery::usage::wrong_numbers(&$program);
        }

        #[test]
        fn wrong_outputs_are_refused() {
            $crate::battery::usage::wrong_outputs(&$program);
        }

        #[test]
        fn other_spellings_are_accepted() {
            $crate::battery::odd::spellings(&$program);
            $crate::battery::odd::scenes(&$program);
        }

        #[test]
        fn all_kinds_of_pictures_are_written() {
            $crate::battery::odd::kinds_of_pictures(&$program);
        }

        #[test]
        fn a_closed_stdout_is_no_error() {
            $crate::battery::odd::closed_stdout(&$program);
        }

        #[test]
        fn help_and_version() {
            $crate::battery::odd::help(&$program);
        }
    };
}
