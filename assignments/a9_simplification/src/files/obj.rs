//! Writing OBJ files. Reading them is [`common::mesh::parse_obj`]'s business.

use common::mesh::Mesh;
use std::fmt::Write;

/// The text of an OBJ file: every number in the fewest digits that read back as the same bits.
pub fn to_text(mesh: &Mesh) -> String {
    let mut text = String::with_capacity(32 * mesh.positions.len() + 24 * mesh.triangles.len());
    let mut line = |words: std::fmt::Arguments| text.write_fmt(words).unwrap_or(());
    for p in &mesh.positions {
        line(format_args!("v {} {} {}\n", p.x, p.y, p.z));
    }
    for uv in &mesh.uvs {
        line(format_args!("vt {} {}\n", uv.x, uv.y));
    }
    for n in &mesh.normals {
        line(format_args!("vn {} {} {}\n", n.x, n.y, n.z));
    }
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|v| u64::from(v) + 1);
        match (mesh.uvs.is_empty(), mesh.normals.is_empty()) {
            (true, true) => line(format_args!("f {a} {b} {c}\n")),
            (false, true) => line(format_args!("f {a}/{a} {b}/{b} {c}/{c}\n")),
            (true, false) => line(format_args!("f {a}//{a} {b}//{b} {c}//{c}\n")),
            (false, false) => line(format_args!("f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}\n")),
        }
    }
    text
}
