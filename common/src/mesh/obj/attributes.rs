//! Meshes with texture coordinates or normals: the door to tobj.
//!
//! tobj unites the index triples of the corners into vertices. It is handed only the four kinds
//! of statement that matter, already checked, without comments and continued lines, which it
//! does not know; so its own errors, which have no line, do not come up.

use super::super::{Mesh, MeshError};
use super::tokens::Tokens;
use crate::math::{Vec2, Vec3};

/// Reads a file that has passed [`super::reader::read`], which found `degenerate` faces of
/// fewer than three vertices.
pub(super) fn read(bytes: &[u8], degenerate: usize) -> Result<Mesh, MeshError> {
    let options =
        tobj::LoadOptions { triangulate: true, single_index: true, ignore_points: true, ignore_lines: true };
    let text = essential_statements(bytes);
    let no_materials = |_: &std::path::Path| Ok(Default::default());
    let (models, _) = tobj::load_obj_buf(&mut text.as_slice(), &options, no_materials)
        .map_err(|error| MeshError::new(error.to_string()))?;
    let mesh = models.into_iter().next().map(|model| model.mesh);
    let mesh = mesh.map(convert).unwrap_or_default();
    Ok(Mesh { degenerate, ..mesh })
}

/// The statements `v`, `vt`, `vn` and `f`, one per line, words separated by single blanks.
fn essential_statements(bytes: &[u8]) -> Vec<u8> {
    let mut tokens = Tokens::new(bytes);
    let mut text = Vec::new();
    while let Some(keyword) = tokens.keyword() {
        if matches!(keyword, b"v" | b"vt" | b"vn" | b"f") {
            text.extend_from_slice(keyword);
            copy_values(&mut tokens, keyword, &mut text);
            text.push(b'\n');
        } else {
            tokens.skip_statement();
        }
    }
    text
}

fn copy_values(tokens: &mut Tokens, keyword: &[u8], text: &mut Vec<u8>) {
    let mut words: Vec<&[u8]> = std::iter::from_fn(|| tokens.word()).collect();
    match keyword {
        // Behind the third number stands w, which counts, or a colour, which does not.
        b"v" if words.len() > 4 => words.truncate(3),
        b"vt" => words.truncate(2),
        b"vn" => words.truncate(3),
        _ => {}
    }
    for word in words {
        text.push(b' ');
        text.extend_from_slice(word);
    }
}

fn convert(mesh: tobj::Mesh) -> Mesh {
    let vertices = mesh.positions.len() / 3;
    let normals = mesh.normals.chunks_exact(3).map(Vec3::from_slice);
    let uvs = mesh.texcoords.chunks_exact(2).map(Vec2::from_slice);
    Mesh {
        positions: mesh.positions.chunks_exact(3).map(Vec3::from_slice).collect(),
        triangles: mesh.indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
        // tobj pushes an attribute for the vertices that have it: aligned only if all have.
        normals: if normals.len() == vertices { normals.collect() } else { Vec::new() },
        uvs: if uvs.len() == vertices { uvs.collect() } else { Vec::new() },
        degenerate: 0,
    }
}
