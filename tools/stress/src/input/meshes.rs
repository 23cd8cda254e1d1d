//! Mesh files: OBJ with and without normals, PLY and STL as text and as bytes.

use super::family::{Sample, refusal};
use super::scenes::texts;
use crate::kit::{lumpy_sphere, repository};
use a9_simplification::files::Kind;
use common::math::{Vec2, Vec3};
use common::mesh::Mesh;
use std::path::Path;

/// One with normals and texture coordinates.
fn dressed() -> Mesh {
    let mesh = lumpy_sphere(1, 3);
    let normals: Vec<Vec3> = mesh.positions.iter().map(|p| p.normalize()).collect();
    let uvs = normals.iter().map(|n| Vec2::new(n.x, n.y)).collect();
    Mesh { normals, uvs, ..mesh }
}

fn as_kind(kind: Kind, mesh: &Mesh, name: &str) -> Sample {
    let bytes = kind.bytes(mesh).unwrap_or_else(|error| panic!("{name}: {error}"));
    Sample { name: format!("{name}.{}", kind.suffix()), bytes }
}

/// Files that promise more than they hold, and files as text that we do not write ourselves.
const SPOKEN: [(&str, &str); 7] = [
    (
        "promise.ply",
        "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n",
    ),
    (
        "promise_faces.ply",
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 18446744073709551615\nproperty list uint int vertex_indices\nend_header\n",
    ),
    (
        "promise_list.ply",
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty list uint float x\nend_header\n4294967295 1 2 3\n",
    ),
    (
        "promise.stl",
        "eighty bytes of whatever one likes to write into the header of such a file, or not\u{ff}\u{ff}\u{ff}\u{7f}",
    ),
    (
        "text.ply",
        "ply\nformat ascii 1.0\ncomment a triangle\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
    ),
    (
        "text.stl",
        "solid it\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid it\n",
    ),
    (
        "all.obj",
        "# all\nmtllib a.mtl\no it\ng it\nv 0 0 0\nv 1 0 0 1\nv 0 1 0\nv 1 1 1\nvt 0 0\nvn 0 0 1\nusemtl a\ns 1\nf 1/1/1 2/1/1 -2/1/1\nf 1 2 3 4\nf 1//1 2//1 3//1\n",
    ),
];

/// The repository's, the small ones in every kind.
pub fn samples() -> Vec<Sample> {
    let mut all = texts(&repository().join("scenes/meshes"), |name| name.ends_with(".obj"));
    let small: Vec<Mesh> = all
        .iter()
        .filter(|sample| sample.bytes.len() < 20_000)
        .map(|s| Kind::Obj.parse(&s.name, &s.bytes).unwrap_or_else(|error| panic!("{error}")))
        .collect();
    for (number, mesh) in small.iter().chain([&dressed()]).enumerate() {
        all.extend(Kind::ALL.map(|kind| as_kind(kind, mesh, &format!("small {number}"))));
    }
    let spoken = SPOKEN.map(|(name, text)| Sample { name: name.to_owned(), bytes: text.as_bytes().to_vec() });
    all.into_iter().chain(spoken).collect()
}

/// A mesh, or a refusal that names the file.
pub fn read(name: &str, bytes: &[u8]) -> Result<(), String> {
    let kind = Kind::of_path(Path::new(name)).ok_or_else(|| format!("{name} has no suffix"))?;
    match kind.parse(name, bytes) {
        Ok(mesh) if mesh.positions.iter().any(|p| !p.is_finite()) => Err("a vertex is not finite".to_owned()),
        Ok(mesh) => match mesh.triangles.as_flattened().iter().max() {
            Some(&most) if most as usize >= mesh.positions.len() => Err(format!("no vertex {most}")),
            None => Err("a mesh without triangles".to_owned()),
            _ => Ok(()),
        },
        Err(error) if !error.to_string().contains(name) => Err(format!("which file? {error}")),
        Err(error) => refusal(&error.to_string()),
    }
}
