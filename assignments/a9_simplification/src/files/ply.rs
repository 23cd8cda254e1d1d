//! PLY files: the door to ply-rs-bw.
//!
//! ```text
//! ply
//! format ascii 1.0
//! element vertex 3
//! property float x
//! property float y
//! property float z
//! element face 1
//! property list uchar int vertex_indices
//! end_header
//! 0 0 0
//! 1 0 0
//! 0 1 0
//! 3 0 1 2
//! ```
//!
//! Of vertices x y z are read, nx ny nz, and texture coordinates by any of their usual names; of
//! faces the list of vertices, as a fan of triangles. All else is skipped.

use common::math::{Vec2, Vec3};
use common::mesh::{Mesh, MeshError};
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{
    Addable, ElementDef, Encoding, Header, Ply, Property, PropertyAccess, PropertyAccessResult, PropertyDef,
    PropertyType, ScalarType,
};
use ply_rs_bw::writer::Writer;

/// Names of the properties of a vertex that count, with their places in [`Vertex::values`].
const PROPERTIES: [(&str, usize); 12] = [
    ("x", 0),
    ("y", 1),
    ("z", 2),
    ("nx", 3),
    ("ny", 4),
    ("nz", 5),
    ("s", 6),
    ("t", 7),
    ("u", 6),
    ("v", 7),
    ("texture_u", 6),
    ("texture_v", 7),
];
/// What the list of a face's vertices is called, and used to be.
const INDICES: [&str; 2] = ["vertex_indices", "vertex_index"];

/// Position, normal, texture coordinates.
struct Vertex {
    values: [f32; 8],
}

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self { values: [0.0; 8] }
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let place = PROPERTIES.iter().find(|(known, _)| *known == name);
        match (place, property.to_f32_lossy()) {
            (Some((_, place)), Some(value)) => self.values[*place] = value,
            (Some(_), None) => return PropertyAccessResult::UnsupportedType,
            (None, _) => return PropertyAccessResult::Ignored,
        }
        PropertyAccessResult::Set
    }

    fn get_float(&self, name: &str) -> Option<f32> {
        let (_, place) = PROPERTIES.iter().find(|(known, _)| *known == name)?;
        Some(self.values[*place])
    }
}

/// Indices of a face's vertices, as they are written.
#[derive(Default)]
struct Face {
    corners: Vec<i32>,
}

impl PropertyAccess for Face {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        if !INDICES.contains(&name) {
            return PropertyAccessResult::Ignored;
        }
        // What is negative or too large for a sign is out of range in any case.
        let small = |index: u32| i32::try_from(index).unwrap_or(-1);
        self.corners = match property {
            Property::ListInt(list) => list,
            other => match other.to_u32_list() {
                Some(list) => list.into_iter().map(small).collect(),
                None => return PropertyAccessResult::UnsupportedType,
            },
        };
        PropertyAccessResult::Set
    }

    fn get_list_int(&self, name: &str) -> Option<&[i32]> {
        INDICES.contains(&name).then_some(&self.corners)
    }
}

/// An element that nobody asked for: it is read over and takes no memory.
struct Skipped;

impl PropertyAccess for Skipped {
    fn new() -> Self {
        Self
    }
}

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
