//! STL files: the door to stl_io.
//!
//! The crate reads and writes triangles. What it leaves open is done here: a binary file whose
//! comment begins with "solid" is told from a text by its length, a text of several solids is
//! read to its end, errors of texts get a line, and corners at one place become one vertex.

use crate::measure::Welded;
use common::math::Vec3;
use common::mesh::{Mesh, MeshError};
use std::io::Cursor;
use stl_io::{Normal, Triangle, Vertex};

/// Bytes of a binary file before its triangles: a comment of 80, then their number.
const HEADER: usize = 84;
/// Bytes of a triangle.
const TRIANGLE: usize = 50;

/// Reads a file, text or binary.
///
/// # Errors
/// If it is neither, ends too soon, or has a corner that is not finite.
pub fn parse(bytes: &[u8]) -> Result<Mesh, MeshError> {
    let triangles = if is_text(bytes) { read_text(bytes)? } else { read_binary(bytes)? };
    let positions = triangles.iter().flat_map(|t| t.vertices.map(|v| Vec3::from_array(v.0))).collect();
    let count = u32::try_from(3 * triangles.len());
    let count = count.map_err(|_| MeshError::new(format!("{} triangles are too many", triangles.len())))?;
    let corners = (0..count / 3).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    let welded = Welded::new(&Mesh { positions, triangles: corners, ..Mesh::default() });
    Ok(Mesh { positions: welded.positions, triangles: welded.triangles, ..Mesh::default() })
}

/// Both kinds may begin with "solid", but only a binary file is as long as its number of triangles
/// demands.
fn is_text(bytes: &[u8]) -> bool {
    let binary = declared(bytes).is_some_and(|count| bytes.len() == HEADER + TRIANGLE * count);
    bytes.trim_ascii_start().starts_with(b"solid") && !binary
}

/// The number of triangles that a binary file says it has.
fn declared(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(HEADER - 4..HEADER)?;
    Some(u32::from_le_bytes(count.try_into().ok()?) as usize)
}

fn read_binary(bytes: &[u8]) -> Result<Vec<Triangle>, MeshError> {
    let count = declared(bytes).ok_or_else(|| {
        MeshError::new(format!("an STL file has at least {HEADER} bytes, or begins with `solid`"))
    })?;
    let there = (bytes.len() - HEADER) / TRIANGLE;
    if there < count {
        let message = format!("this binary STL file says {count} triangles, but ends after {there}");
        // A text without its first word says nothing that makes sense.
        let hint = if there == 0 { " (a text begins with `solid`)" } else { "" };
        return Err(MeshError::new(message + hint));
    }
    // Whatever the comment says, this is not to be taken for a text.
    let plain = [&[0; HEADER - 4], &bytes[HEADER - 4..]].concat();
    collect(&plain, |triangle| format!("triangle {triangle} of this binary STL file")).map_err(MeshError::new)
}

/// Reads a text. Its solids are made one, for the crate would stop behind the first.
fn read_text(bytes: &[u8]) -> Result<Vec<Triangle>, MeshError> {
    let text = String::from_utf8_lossy(bytes);
    let is_frame = |line: &&str| matches!(line.split_whitespace().next(), None | Some("solid" | "endsolid"));
    let numbered = text.split(['\n', '\r']).zip(1..);
    let body: Vec<(&str, usize)> = numbered.filter(|(line, _)| !is_frame(line)).collect();
    let mut plain = String::from("solid all\n");
    for (line, _) in &body {
        plain.push_str(line);
        plain.push('\n');
    }
    plain.push_str("endsolid all\n");
    collect(plain.as_bytes(), |_| String::new()).map_err(|message| {
        let line = first_wrong(&body).or(body.last().map(|(_, line)| *line)).unwrap_or(1);
        MeshError::at_line(line, message)
    })
}

/// The line from which on a text is no list of facets.
fn first_wrong(body: &[(&str, usize)]) -> Option<usize> {
    const FACET: [(&[&str], usize); 7] = [
        (&["facet", "normal"], 3),
        (&["outer", "loop"], 0),
        (&["vertex"], 3),
        (&["vertex"], 3),
        (&["vertex"], 3),
        (&["endloop"], 0),
        (&["endfacet"], 0),
    ];
    let is_good = |(line, (words, numbers)): (&str, (&[&str], usize))| {
        let found: Vec<&str> = line.split_whitespace().collect();
        let finite = |word: &&str| word.parse::<f32>().is_ok_and(f32::is_finite);
        found.len() == words.len() + numbers
            && found.starts_with(words)
            && found[words.len()..].iter().all(finite)
    };
    let mut lines = body.iter().zip(FACET.into_iter().cycle());
    lines.find(|((line, _), expected)| !is_good((line, *expected))).map(|((_, number), _)| *number)
}

/// All triangles that the crate finds; `place` names a triangle, counted from 1, in a message.
fn collect(bytes: &[u8], place: impl Fn(usize) -> String) -> Result<Vec<Triangle>, String> {
    let mut source = Cursor::new(bytes);
    let reader = stl_io::create_stl_reader(&mut source).map_err(|error| error.to_string())?;
    let mut triangles = Vec::new();
    for (number, triangle) in (1..).zip(reader) {
        let triangle = triangle.map_err(|error| format!("{} {error}", place(number)).trim().to_owned())?;
        if triangle.vertices.iter().flat_map(|v| v.0).any(|x| !x.is_finite()) {
            return Err(format!("{} has a corner that is not finite", place(number)));
        }
        triangles.push(triangle);
    }
    Ok(triangles)
}

/// The bytes of a binary file; `None` if there are 2³² triangles or more.
pub fn to_bytes(mesh: &Mesh) -> Option<Vec<u8>> {
    u32::try_from(mesh.triangles.len()).ok()?;
    let triangles = mesh.triangles.iter().map(|corners| {
        let [a, b, c] = corners.map(|v| mesh.positions[v as usize]);
        let [p, q, r] = [a, b, c].map(|p| p.as_dvec3());
        let normal = (q - p).cross(r - p).normalize_or_zero().as_vec3();
        Triangle {
            normal: Normal::new(normal.to_array()),
            vertices: [a, b, c].map(|p| Vertex::new(p.to_array())),
        }
    });
    let mut bytes = Vec::with_capacity(HEADER + TRIANGLE * mesh.triangles.len());
    stl_io::write_stl(&mut bytes, triangles).ok()?;
    Some(bytes)
}
