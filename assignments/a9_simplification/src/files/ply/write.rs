//! Writing.

use super::element::{Face, INDICES, Vertex};
use common::math::{Vec2, Vec3};
use common::mesh::Mesh;
use ply_rs_bw::ply::{Addable, ElementDef, Encoding, Ply, PropertyDef, PropertyType, ScalarType};
use ply_rs_bw::writer::Writer;

/// The bytes of a binary file, lowest byte first; `None` if a number of a vertex is too large for
/// the format.
pub fn to_bytes(mesh: &Mesh) -> Option<Vec<u8>> {
    i32::try_from(mesh.positions.len()).ok()?;
    let mut ply = Ply::<Vertex>::new();
    ply.header.encoding = Encoding::BinaryLittleEndian;
    let (vertex, face) = definitions(mesh);
    ply.header.elements.add(vertex.clone());
    ply.header.elements.add(face.clone());
    let mut bytes = Vec::with_capacity(512 + 32 * mesh.positions.len() + 13 * mesh.triangles.len());
    let writer = Writer::<Vertex>::new();
    writer.write_header(&mut bytes, &ply.header).ok()?;
    for v in 0..mesh.positions.len() {
        writer.write_little_endian_element(&mut bytes, &vertex_at(mesh, v), &vertex).ok()?;
    }
    let writer = Writer::<Face>::new();
    for triangle in &mesh.triangles {
        let corners = triangle.map(|v| v as i32).to_vec();
        writer.write_little_endian_element(&mut bytes, &Face { corners }, &face).ok()?;
    }
    Some(bytes)
}

fn vertex_at(mesh: &Mesh, v: usize) -> Vertex {
    let mut values = [0.0; 8];
    mesh.positions[v].write_to_slice(&mut values);
    mesh.normals.get(v).unwrap_or(&Vec3::ZERO).write_to_slice(&mut values[3..]);
    mesh.uvs.get(v).unwrap_or(&Vec2::ZERO).write_to_slice(&mut values[6..]);
    Vertex { values }
}

/// What a vertex and a face of this mesh are made of.
fn definitions(mesh: &Mesh) -> (ElementDef, ElementDef) {
    let mut names = vec!["x", "y", "z"];
    names.extend(["nx", "ny", "nz"].iter().filter(|_| !mesh.normals.is_empty()));
    names.extend(["s", "t"].iter().filter(|_| !mesh.uvs.is_empty()));
    let element = |name: &str, count: usize| ElementDef { count, ..ElementDef::new(name.to_owned()) };
    let mut vertex = element("vertex", mesh.positions.len());
    let float = PropertyType::Scalar(ScalarType::Float);
    for name in names {
        vertex.properties.add(PropertyDef::new(name.to_owned(), float.clone()));
    }
    let mut face = element("face", mesh.triangles.len());
    let list = PropertyType::List(ScalarType::UChar, ScalarType::Int);
    face.properties.add(PropertyDef::new(INDICES[0].to_owned(), list));
    (vertex, face)
}
