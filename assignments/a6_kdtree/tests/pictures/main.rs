//! A6T5: pictures of structures and of their work, what `-stats` says, and structures that are
//! built when a ray asks.

mod boxes;
mod heat;
mod lazy;
mod stats;
#[path = "../world/mod.rs"]
mod world;

use a1_ray_casting::Studio;
use a6_kdtree::{AccelArgs, Program};
use common::camera::Camera;
use common::geometry::Geometry;
use common::mesh::{Mesh, MeshError};
use common::picture::{Film, Size, Transfer, read};
use common::scene::{MeshSource, load, parse_str};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;

/// Flags as typed; the scene is called `none`.
fn args(flags: &str) -> AccelArgs {
    let words = format!("a6_kdtree -input none {flags}");
    let parsed = common::cli::try_parse_from::<Program>(words.split_whitespace());
    parsed.unwrap_or_else(|stop| panic!("{}", stop.text)).options.args
}

/// Where a scene of the workspace lies.
fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(name)
}

/// A scene of the workspace, ready for pictures of that size.
fn studio(name: &str, width: i64, height: i64) -> Studio {
    prepared(load(&file(name)).unwrap_or_else(|e| panic!("{e}")), width, height)
}

struct NoMeshes;

impl MeshSource for NoMeshes {
    fn mesh(&mut self, name: &str) -> Result<Arc<Mesh>, MeshError> {
        Err(MeshError::new(name))
    }
}

/// A scene from its text.
fn studio_of(text: &str, width: i64, height: i64) -> Studio {
    prepared(parse_str("test", text, &mut NoMeshes).unwrap_or_else(|e| panic!("{e}")), width, height)
}

fn prepared(scene: common::scene::Scene, width: i64, height: i64) -> Studio {
    let geometry = Geometry::build(&scene).expect("test scenes are sound");
    let camera = Camera::new(&scene.camera);
    Studio { scene, geometry, camera, size: Size::new(width, height).unwrap() }
}

/// Forty balls in a row behind the camera of the text's beginning, which sees none of them.
fn out_of_sight() -> String {
    let balls: String = (0..40).map(|i| format!("Sphere {{ center {i} 0 90 radius 0.4 }} ")).collect();
    format!(
        "PerspectiveCamera {{ center 0 0 5 direction 0 0 -1 up 0 1 0 angle 40 }}
         Background {{ color 0.25 0.5 0.75 }}
         Materials {{ numMaterials 1 Material {{ }} }}
         Group {{ numObjects 40 MaterialIndex 0 {balls} }}"
    )
}

/// Runs the program, which must succeed, and returns what it printed; `@` in the flags stands for
/// the folder.
fn printed(folder: &Path, flags: &str) -> String {
    let flags = flags.replace('@', &folder.display().to_string());
    let mut program = Command::new(env!("CARGO_BIN_EXE_a6_kdtree"));
    let output = program.args(flags.split_whitespace()).output().unwrap();
    assert!(output.status.success(), "{flags}\n{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// The first number after a name in what was printed.
fn number(text: &str, name: &str) -> f64 {
    let at = text.find(name).unwrap_or_else(|| panic!("no `{name}` in\n{text}"));
    let rest = text[at + name.len()..].trim_start_matches([' ', ':', ',']);
    let end = rest.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(rest.len());
    rest[..end].trim_end_matches('.').parse().unwrap_or_else(|_| panic!("no number after `{name}`: {rest}"))
}

fn picture(folder: &Path, name: &str) -> Film {
    read(&folder.join(name), Transfer::Linear).unwrap()
}
