//! Vertices and faces as the crate hands them over, property by property.

use ply_rs_bw::ply::{Property, PropertyAccess, PropertyAccessResult};

/// Names of the properties of a vertex that count, with their places in [`Vertex::values`].
pub const PROPERTIES: [(&str, usize); 12] = [
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
pub const INDICES: [&str; 2] = ["vertex_indices", "vertex_index"];

/// Position, normal, texture coordinates.
pub struct Vertex {
    /// By the places of [`PROPERTIES`]; 0 where the file gives nothing.
    pub values: [f32; 8],
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
pub struct Face {
    /// From 0; what cannot be one is −1.
    pub corners: Vec<i32>,
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
pub struct Skipped;

impl PropertyAccess for Skipped {
    fn new() -> Self {
        Self
    }
}
