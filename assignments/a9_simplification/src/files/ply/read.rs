//! Reading.

use super::element::{Face, INDICES, PROPERTIES, Skipped, Vertex};
use common::math::{Vec2, Vec3};
use common::mesh::{Mesh, MeshError};
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{ElementDef, Encoding, Header, PropertyType, ScalarType};

/// Reads a file, text or binary of either order.
///
/// # Errors
/// If its header is none or promises more than the file can hold, if it ends too soon, if a number
/// is not finite or an index out of range.
pub fn parse(bytes: &[u8]) -> Result<Mesh, MeshError> {
    let mut source = Reader::new(bytes);
    let header = Parser::<Skipped>::new().read_header(&mut source).map_err(refused)?;
    check(&header, bytes.len())?;
    let mut mesh = Mesh::default();
    let mut faces = Vec::new();
    for (name, element) in &header.elements {
        let line = Some(source.line()).filter(|_| header.encoding == Encoding::Ascii);
        match name.as_str() {
            "vertex" => {
                let read = Parser::new().read_payload_for_element(&mut source, element, &header);
                fill(&mut mesh, element, &read.map_err(refused)?, line)?;
            }
            "face" => {
                let read = Parser::new().read_payload_for_element(&mut source, element, &header);
                faces.push((read.map_err(refused)?, line));
            }
            _ => {
                let skip = Parser::<Skipped>::new();
                skip.read_payload_for_element(&mut source, element, &header).map_err(refused)?;
            }
        }
    }
    // Faces may stand before the vertices that they name.
    faces.iter().try_for_each(|(faces, line)| cut(&mut mesh, faces, *line))?;
    Ok(mesh)
}

/// Refuses headers that do not describe a mesh, or claim more than the file has bytes.
fn check(header: &Header, bytes: usize) -> Result<(), MeshError> {
    let property =
        |element: &str, name: &str| Some(&header.elements.get(element)?.properties.get(name)?.data_type);
    let is_number = |name: &&str| matches!(property("vertex", name), Some(PropertyType::Scalar(_)));
    let is_list = |name: &&str| match property("face", name) {
        Some(PropertyType::List(_, of)) => !matches!(of, ScalarType::Float | ScalarType::Double),
        _ => false,
    };
    if !["x", "y", "z"].iter().all(is_number) {
        return Err(MeshError::new("this PLY file has no element `vertex` with numbers x, y and z"));
    }
    if !INDICES.iter().any(is_list) {
        let message = "this PLY file has no element `face` with a list of whole numbers `vertex_indices`";
        return Err(MeshError::new(message));
    }
    for (name, element) in &header.elements {
        // An element takes a byte at least, unless it has no property at all.
        if element.count > bytes || (element.count > 0 && element.properties.is_empty()) {
            let message = format!("{} elements `{name}` do not fit a file of {bytes} bytes", element.count);
            return Err(MeshError::new(message));
        }
    }
    Ok(())
}

/// The crate's error, on one line.
fn refused(error: ParseError) -> MeshError {
    let text = error.to_string();
    // What follows tells of the crate's grammar.
    let text = text.split("\n\tError:").next().unwrap_or_default();
    let words: Vec<&str> = text.split_whitespace().collect();
    let message = words.join(" ");
    match error.line() {
        Some(line) => {
            let own = message.strip_prefix(&format!("Line {line}: ")).unwrap_or(&message);
            MeshError::at_line(line, own)
        }
        None => MeshError::new(message),
    }
}

/// An error of the `index`-th of the elements whose first stands in `line`, if there are lines.
fn wrong(line: Option<usize>, index: usize, what: &str, message: &str) -> MeshError {
    match line {
        Some(first) => MeshError::at_line(first + index, message),
        None => MeshError::new(format!("{what} {index}: {message}")),
    }
}

fn fill(
    mesh: &mut Mesh,
    element: &ElementDef,
    vertices: &[Vertex],
    line: Option<usize>,
) -> Result<(), MeshError> {
    let given: Vec<usize> = (0..8)
        .filter(|place| PROPERTIES.iter().any(|(n, p)| p == place && element.properties.contains_key(*n)))
        .collect();
    let infinite = |v: &Vertex| given.iter().any(|&place| !v.values[place].is_finite());
    if let Some(index) = vertices.iter().position(infinite) {
        return Err(wrong(line, index, "vertex", "a number is not finite, or too large for 32 bits"));
    }
    mesh.positions = vertices.iter().map(|v| Vec3::from_slice(&v.values)).collect();
    if [3, 4, 5].iter().all(|place| given.contains(place)) {
        mesh.normals = vertices.iter().map(|v| Vec3::from_slice(&v.values[3..])).collect();
    }
    if [6, 7].iter().all(|place| given.contains(place)) {
        mesh.uvs = vertices.iter().map(|v| Vec2::from_slice(&v.values[6..])).collect();
    }
    Ok(())
}

/// Cuts faces into fans of triangles.
fn cut(mesh: &mut Mesh, faces: &[Face], line: Option<usize>) -> Result<(), MeshError> {
    let count = mesh.positions.len();
    for (index, face) in faces.iter().enumerate() {
        let out = |v: &&i32| usize::try_from(**v).map_or(true, |v| v >= count);
        if let Some(v) = face.corners.iter().find(out) {
            let message = format!("vertex index {v} is out of range: there are {count}");
            return Err(wrong(line, index, "face", &message));
        }
        let corner = |k: usize| face.corners[k] as u32;
        mesh.degenerate += usize::from(face.corners.len() < 3);
        let fan = 2..face.corners.len();
        mesh.triangles.extend(fan.map(|k| [corner(0), corner(k - 1), corner(k)]));
    }
    Ok(())
}
