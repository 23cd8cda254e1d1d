//! Scene files.

use super::family::{Sample, refusal};
use crate::kit::repository;
use common::mesh::{Mesh, MeshError};
use common::scene::{MeshSource, parse_str};
use std::path::Path;
use std::sync::Arc;

/// Any name is the same small mesh: reading files is not what is tested here.
struct AnyMesh(Arc<Mesh>);

impl MeshSource for AnyMesh {
    fn mesh(&mut self, _: &str) -> Result<Arc<Mesh>, MeshError> {
        Ok(Arc::clone(&self.0))
    }
}

/// All text files of a folder, in order.
pub fn texts(folder: &Path, wanted: impl Fn(&str) -> bool) -> Vec<Sample> {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let paths = entries.map(|entry| entry.expect("a folder entry").path());
    let named = paths.filter_map(|path| Some((path.file_name()?.to_string_lossy().into_owned(), path)));
    let mut samples: Vec<Sample> = named
        .filter(|(name, _)| wanted(name))
        .map(|(name, path)| Sample { name, bytes: std::fs::read(path).expect("a file of the repository") })
        .collect();
    samples.sort_by(|a, b| a.name.cmp(&b.name));
    samples
}

/// The repository's scenes, and some whose counts promise more than any memory holds.
pub fn samples() -> Vec<Sample> {
    let mut all = texts(&repository().join("scenes"), |name| name.starts_with("scene"));
    assert!(all.len() > 50, "the scenes of the repository");
    let camera = "PerspectiveCamera { center 0 0 5 direction 0 0 -1 up 0 1 0 angle 40 }";
    let promises = [
        format!("{camera} Lights {{ numLights 4000000000 PointLight {{ position 0 0 0 color 1 1 1 }} }}"),
        format!("{camera} Materials {{ numMaterials 2000000000 Material {{ }} }} Group {{ numObjects 0 }}"),
        format!("{camera} Materials {{ numMaterials 1 Material {{ }} }} Group {{ numObjects 4294967295 }}"),
        format!("{camera} Group {{ numObjects 18446744073709551615 }}"),
    ];
    let named =
        |(i, text): (usize, String)| Sample { name: format!("promise {i}"), bytes: text.into_bytes() };
    all.extend(promises.into_iter().enumerate().map(named));
    all
}

/// A scene, or an error with a place in the text.
pub fn read(_: &str, bytes: &[u8]) -> Result<(), String> {
    let text = String::from_utf8_lossy(bytes);
    let Err(error) = parse_str("hostile.txt", &text, &mut AnyMesh(Arc::default())) else { return Ok(()) };
    let lines = text.bytes().filter(|b| matches!(b, b'\n' | b'\r')).count() as u32 + 1;
    let located = error.position().is_some_and(|at| (1..=lines).contains(&at.line) && at.column >= 1);
    refusal(error.message())?;
    if !located {
        return Err(format!("a refusal without a place: {error}"));
    }
    // To draw the excerpt takes ten times as long as to find the mistake.
    if bytes.len().is_multiple_of(16) { refusal(&error.to_string()) } else { Ok(()) }
}
