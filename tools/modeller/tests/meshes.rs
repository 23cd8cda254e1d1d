//! Every mesh keeps its promises, the files in `scenes/meshes` are what the modeller makes, and the
//! scenes name no others.

use modeller::catalogue::{self, Model};
use modeller::sky;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes")
}

/// Made once for all tests.
fn models() -> &'static [Model] {
    static MODELS: OnceLock<Vec<Model>> = OnceLock::new();
    MODELS.get_or_init(catalogue::all)
}

/// Counts, closedness, manifoldness, Euler characteristic, orientation, shape of triangles and box:
/// see `Model::check`.
#[test]
fn every_mesh_keeps_its_promises() {
    for model in models().iter().chain([&catalogue::fine_rabbit()]) {
        model.check().unwrap();
    }
}

/// The promises can be broken, and then `check` says so.
#[test]
fn broken_promises_are_found() {
    let gem = || catalogue::all().into_iter().find(|m| m.name == "diamond.obj").unwrap();
    let complaint = |damage: fn(&mut Model)| {
        let mut model = gem();
        damage(&mut model);
        model.check().unwrap_err()
    };
    assert!(complaint(|m| m.triangles = 111).contains("110 triangles instead of 111"));
    assert!(complaint(|m| m.mesh.triangles[7].swap(0, 1)).contains("two triangles"));
    assert!(complaint(|m| m.mesh.triangles.iter_mut().for_each(|t| t.swap(0, 1))).contains("inwards"));
    assert!(complaint(|m| m.mesh.positions[8] = m.mesh.positions[0]).contains("times as high as long"));
    assert!(
        complaint(|m| m.mesh.positions.iter_mut().for_each(|p| p.x *= 1.01)).contains("instead of Bounds")
    );
}

#[test]
fn files_on_disk_are_what_the_modeller_makes() {
    for model in models() {
        let path = scenes().join("meshes").join(model.name);
        let text = fs::read_to_string(&path).unwrap();
        assert!(
            text == model.text(),
            "{} is out of date: run `cargo run --release -p modeller`",
            path.display()
        );
    }
    assert!(
        fs::read(scenes().join("meshes").join(sky::NAME)).unwrap() == sky::bytes(),
        "the sky is out of date"
    );
}

#[test]
fn scenes_name_only_meshes_that_exist() {
    let rabbits = ["bunny_40k", "bunny_5k", "bunny_1k", "bunny_200"].map(|name| format!("meshes/{name}.obj"));
    let known: BTreeSet<String> =
        models().iter().map(|m| format!("meshes/{}", m.name)).chain(rabbits).collect();
    let mut named = BTreeSet::new();
    for entry in fs::read_dir(scenes()).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|e| e == "txt") {
            let text = fs::read_to_string(&path).unwrap();
            let words: Vec<&str> = text.split_whitespace().collect();
            named.extend(words.windows(2).filter(|w| w[0] == "obj_file").map(|w| w[1].to_owned()));
        }
    }
    let unknown: Vec<_> = named.difference(&known).collect();
    assert!(unknown.is_empty(), "no such mesh: {unknown:?}");
    assert!(named.len() >= 8, "scenes of assignments 0 to 6 name eight meshes, found {named:?}");
}

#[test]
fn usage_errors_and_help_have_their_exit_codes() {
    let run = |arguments: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_modeller")).args(arguments).output().unwrap();
        (
            output.status.code(),
            String::from_utf8(output.stdout).unwrap(),
            String::from_utf8(output.stderr).unwrap(),
        )
    };
    let (code, out, _) = run(&["--help"]);
    assert!(code == Some(0) && out.contains("Usage: modeller"));
    let (code, _, err) = run(&["--chekc"]);
    assert!(code == Some(2) && err.contains("unknown option --chekc"));
    let (code, _, err) = run(&["a", "b"]);
    assert!(code == Some(2) && err.contains("more than one folder"));
    let (code, _, err) = run(&["--rabbit"]);
    assert!(code == Some(2) && err.contains("--rabbit wants one file"));
}

/// The program itself: what it writes into an empty folder is right, and it notices a change of one
/// byte.
#[test]
fn what_is_written_passes_the_check_until_it_is_changed() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("meshes");
    fs::create_dir_all(&folder).unwrap();
    let run = |arguments: &[&str]| {
        let mut program = Command::new(env!("CARGO_BIN_EXE_modeller"));
        let output = program.args(arguments).arg(&folder).output().unwrap();
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    assert_eq!(run(&[]).0, Some(0));
    for model in models() {
        assert!(fs::read_to_string(folder.join(model.name)).unwrap() == model.text(), "{}", model.name);
    }
    assert!(fs::read(folder.join(sky::NAME)).unwrap() == sky::bytes());
    let last = folder.join("diamond.obj");
    fs::write(&last, fs::read_to_string(&last).unwrap().replacen("f 1", "f 2", 1)).unwrap();
    let (code, err) = run(&["--check"]);
    assert!(code == Some(1) && err.contains("diamond.obj differs"), "{code:?} {err}");
}
