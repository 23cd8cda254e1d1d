//! Reading scenes from files: names, folders, and what can be wrong with a file as a whole.

use crate::PRELUDE;
use common::scene::{Scene, SceneError, load};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// A folder with these files.
fn folder(files: &[(&str, &[u8])]) -> TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, bytes) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().expect("a parent")).expect("a folder");
        fs::write(path, bytes).expect("a file");
    }
    folder
}

fn load_from(folder: &TempDir, name: &str) -> Result<Scene, SceneError> {
    load(&folder.path().join(name))
}

/// The report without the folder's own name.
fn report(folder: &TempDir, name: &str) -> String {
    let error = load_from(folder, name).expect_err("an error");
    let prefix = format!("{}/", folder.path().display());
    error.to_string().replace(&prefix, "")
}

fn with_meshes(names: &[&str]) -> String {
    let count = names.len();
    let meshes: String = names.iter().map(|n| format!("TriangleMesh {{ obj_file {n} }}\n")).collect();
    format!("{PRELUDE}Group {{ numObjects {count} MaterialIndex 0\n{meshes}}}\n")
}

#[test]
fn a_mesh_file_is_found_beside_the_scene_and_read_once_under_all_its_names() {
    let text = with_meshes(&["meshes/a.obj", "./meshes/../meshes/a.obj", "b.obj", "meshes/a.obj"]);
    let folder = folder(&[
        ("scene.txt", text.as_bytes()),
        ("meshes/a.obj", TRIANGLE.as_bytes()),
        ("b.obj", TRIANGLE.as_bytes()),
    ]);
    let scene = load_from(&folder, "scene.txt").expect("a good scene");
    assert_eq!(scene.meshes.len(), 2);
    assert_eq!(scene.nodes.len(), 5);
}

#[test]
fn a_mesh_in_the_working_directory_is_found_too() {
    // Tests run in the folder of their package, which has this file.
    let name = "tests/scene_format/main.rs";
    assert!(Path::new(name).is_file());
    let folder = folder(&[("scene.txt", with_meshes(&[name]).as_bytes())]);
    let report = report(&folder, "scene.txt");
    assert!(report.contains("cannot use this mesh: tests/scene_format/main.rs"), "{report}");
}

#[test]
fn a_missing_mesh_is_reported_at_its_name_with_a_suggestion() {
    let folder =
        folder(&[("scene.txt", with_meshes(&["cub.obj"]).as_bytes()), ("cube.obj", TRIANGLE.as_bytes())]);
    insta::assert_snapshot!(report(&folder, "scene.txt"), @r"
    error: cannot use this mesh: there is no file `cub.obj` beside the scene or in the working directory; did you mean `cube.obj`?
     --> scene.txt:4:25
      |
    4 | TriangleMesh { obj_file cub.obj }
      |                         ^^^^^^^
    ");
}

#[test]
fn a_bad_mesh_is_reported_with_its_own_file_and_line() {
    let folder = folder(&[
        ("scene.txt", with_meshes(&["bad.obj"]).as_bytes()),
        ("bad.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"),
    ]);
    insta::assert_snapshot!(report(&folder, "scene.txt"), @r"
    error: cannot use this mesh: bad.obj:4: vertex index 4 is out of range: there are 3
     --> scene.txt:4:25
      |
    4 | TriangleMesh { obj_file bad.obj }
      |                         ^^^^^^^
    ");
}

#[test]
fn a_missing_picture_is_reported_at_its_name() {
    let text = format!("{PRELUDE}Background {{ environment sky.hdr }}");
    let folder = folder(&[("scene.txt", text.as_bytes())]);
    let error = load_from(&folder, "scene.txt").expect_err("an error");
    assert_eq!(error.position().map(|at| (at.line, at.column)), Some((3, 26)));
}

#[test]
fn a_missing_scene_is_an_error_with_a_suggestion_and_no_position() {
    let folder = folder(&[("scene1_01.txt", b"")]);
    insta::assert_snapshot!(report(&folder, "scene_1_01.txt"), @r"
    error: there is no such scene file
    --> scene_1_01.txt
     = help: did you mean `scene1_01.txt`?
    ");
    let error = load_from(&folder, "nothing").expect_err("an error");
    assert_eq!(error.position(), None);
    assert_eq!(error.message(), "there is no such scene file");
    assert!(error.file().ends_with("nothing"));
}

#[test]
fn a_folder_is_not_a_scene() {
    let folder = folder(&[]);
    let error = load(folder.path()).expect_err("an error");
    assert_eq!(error.message(), "this is a folder, not a scene file");
}

#[test]
fn bytes_that_are_not_utf_8_are_located() {
    let folder = folder(&[("scene.txt", b"# caf\xc3\xa9\nGroup { \xff }")]);
    insta::assert_snapshot!(report(&folder, "scene.txt"), @r"
    error: byte 0xff is not UTF-8 text
     --> scene.txt:2:9
      |
    2 | Group { � }
      |         ^
      |
      = help: save the file as UTF-8, or check that it is a scene file at all
    ");
}

#[test]
fn a_file_too_large_is_refused_without_reading_it_all() {
    let folder = folder(&[]);
    let path = folder.path().join("huge.txt");
    let file = fs::File::create(&path).expect("a file");
    // A hole, not bytes: costs no disk.
    file.set_len(64 << 30).expect("a sparse file");
    let error = load(&path).expect_err("an error");
    assert_eq!(error.message(), "this file is larger than 256 MiB; is it a scene?");
}
