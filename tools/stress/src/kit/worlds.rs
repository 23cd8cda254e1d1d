//! Geometry to trace: from a mesh, from a text, from the repository's scenes.

use common::geometry::Geometry;
use common::math::Vec3;
use common::mesh::{Mesh, MeshError};
use common::scene::{MeshSource, Scene, load, parse_str};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The folder of the workspace.
pub fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Every name stands for the same mesh.
struct TheMesh(Arc<Mesh>);

impl MeshSource for TheMesh {
    fn mesh(&mut self, _: &str) -> Result<Arc<Mesh>, MeshError> {
        Ok(Arc::clone(&self.0))
    }
}

const PRELUDE: &str = "
    PerspectiveCamera { center 0 0 5 direction 0 0 -1 up 0 1 0 angle 40 }
    Materials { numMaterials 1 Material { } } ";

/// The scene of one object, given in the words of the format; every mesh it names is `mesh`.
///
/// # Panics
/// If it is no scene.
pub fn scene_of(object: &str, mesh: Mesh) -> Scene {
    let text = format!("{PRELUDE} Group {{ numObjects 1 MaterialIndex 0 {object} }}");
    parse_str("property.txt", &text, &mut TheMesh(Arc::new(mesh))).unwrap_or_else(|e| panic!("{e}"))
}

/// As [`scene_of`], prepared for tracing.
///
/// # Panics
/// If it cannot be.
pub fn build(object: &str, mesh: Mesh) -> Geometry {
    Geometry::build(&scene_of(object, mesh)).unwrap_or_else(|e| panic!("{e}"))
}

/// The geometry of triangles as they are.
pub fn geometry_of(triangles: &[[Vec3; 3]]) -> Geometry {
    let positions: Vec<Vec3> = triangles.iter().flatten().copied().collect();
    let triangles = (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    build("TriangleMesh { obj_file it }", Mesh { positions, triangles, ..Mesh::default() })
}

/// Every ray-traced scene of the repository with its name, in order.
///
/// # Panics
/// If one cannot be read.
pub fn committed_scenes() -> Vec<(String, Scene)> {
    let folder = repository().join("scenes");
    let entries = std::fs::read_dir(&folder).expect("the scenes of the repository");
    let mut paths: Vec<PathBuf> = entries.map(|e| e.expect("a folder entry").path()).collect();
    paths.retain(|p| p.file_name().is_some_and(|n| n.to_string_lossy().starts_with("scene")));
    paths.sort();
    let read = |p: &PathBuf| (p.file_stem().expect("a name").to_string_lossy().into_owned(), load(p));
    paths.iter().map(read).map(|(name, s)| (name, s.unwrap_or_else(|e| panic!("{e}")))).collect()
}
