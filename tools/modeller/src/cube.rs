//! The cube with corners at ±1.

use crate::mesh::Mesh;
use glam::DVec3;

/// Twelve triangles, two for each face.
pub fn cube() -> Mesh {
    let mut mesh = Mesh::default();
    for corner in 0..8 {
        let side = |axis: u32| if corner >> axis & 1 == 1 { 1.0 } else { -1.0 };
        mesh.positions.push(DVec3::new(side(0), side(1), side(2)));
    }
    for axis in 0..3 {
        for face in [0, 1] {
            add_face(&mut mesh, axis, face);
        }
    }
    mesh
}

/// Adds the face on which bit `axis` of the corner number equals `face`.
fn add_face(mesh: &mut Mesh, axis: u32, face: u32) {
    let (u, v) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
    let base = face << axis;
    // u, v and the axis are right-handed: base → u → v turns left as seen from the face where the
    // bit is set.
    let [a, b, c, d] =
        if face == 1 { [0, u, u + v, v] } else { [0, v, u + v, u] }.map(|corner| base + corner);
    mesh.triangles.extend([[a, b, c], [a, c, d]]);
}
