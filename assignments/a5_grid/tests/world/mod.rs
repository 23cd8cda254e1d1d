//! Geometry from a few words of the scene format.

use common::geometry::Geometry;
use common::mesh::{Mesh, MeshError};
use common::scene::{MeshSource, parse_str};
use std::sync::Arc;

struct NoMesh;

impl MeshSource for NoMesh {
    fn mesh(&mut self, name: &str) -> Result<Arc<Mesh>, MeshError> {
        Err(MeshError::new(format!("no mesh `{name}` here")))
    }
}

/// The geometry of one object.
pub fn geometry(object: &str) -> Geometry {
    let text = format!(
        "PerspectiveCamera {{ center 0 0 5 direction 0 0 -1 up 0 1 0 angle 40 }}
         Materials {{ numMaterials 1 Material {{ }} }}
         Group {{ numObjects 1 MaterialIndex 0 {object} }}"
    );
    let scene = parse_str("world.txt", &text, &mut NoMesh).unwrap_or_else(|e| panic!("{e}"));
    Geometry::build(&scene).unwrap_or_else(|e| panic!("{e}"))
}
