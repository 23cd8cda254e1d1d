//! The scene format through its public door: what a text means, what is wrong with one, and
//! that no text brings the parser down.

mod errors_meaning;
mod errors_numbers;
mod errors_objects;
mod errors_syntax;
mod files;
mod hostile;
mod materials;
mod meaning;

use common::mesh::{Mesh, MeshError};
use common::scene::{MeshSource, Scene, SceneError, parse_str};
use std::sync::Arc;

/// A camera and two materials, on lines 1 and 2.
const PRELUDE: &str = "\
PerspectiveCamera { center 0 0 5 direction 0 0 -1 up 0 1 0 angle 40 }
Materials { numMaterials 2 Material { } Material { } }
";

/// Knows one mesh, `one.obj`.
struct OneMesh(Arc<Mesh>);

impl Default for OneMesh {
    fn default() -> Self {
        let text = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
        Self(Arc::new(common::mesh::parse_obj("one.obj", text).expect("a good mesh")))
    }
}

impl MeshSource for OneMesh {
    fn mesh(&mut self, name: &str) -> Result<Arc<Mesh>, MeshError> {
        match name {
            "one.obj" => Ok(Arc::clone(&self.0)),
            _ => Err(MeshError::new(format!("there is no file `{name}`"))),
        }
    }
}

fn parse(text: &str) -> Result<Scene, SceneError> {
    parse_str("scene.txt", text, &mut OneMesh::default())
}

/// A good scene: the prelude and this.
fn scene(text: &str) -> Scene {
    parse(&format!("{PRELUDE}{text}")).unwrap_or_else(|error| panic!("{error}"))
}

/// The report on a bad scene text.
fn report(text: &str) -> String {
    parse(text).expect_err("an error").to_string()
}

/// The report on a text that is wrong behind the prelude, from line 3 on.
fn behind_prelude(text: &str) -> String {
    report(&format!("{PRELUDE}{text}"))
}
