//! Triangles as they are, and smooth normals for them.

use super::{Face, Label, Tessellation, Vertex};
use common::geometry::Geometry;
use common::math::{DVec3, Vec3};
use std::collections::HashMap;

/// Cosine of 60°: an edge at which the surface turns by more is meant to be sharp. A cube keeps
/// its edges, a coarse rabbit loses them.
const SHARP: f64 = 0.5;

/// More triangles around one corner than any sensible mesh has. Such corners stay flat shaded,
/// because comparing all with all would take for ever.
const CROWDED: usize = 1000;

impl Tessellation {
    /// All triangles, which are in world space and wound the right way already. If `smooth`,
    /// corners at the same place share their normals across edges that are not sharp.
    pub(super) fn add_triangles(&mut self, geometry: &Geometry, smooth: bool) {
        let first = self.faces.len();
        for (vertices, &primitive) in geometry.triangles().iter().zip(geometry.triangle_numbers()) {
            self.add_triangle(vertices, Label { primitive, material: geometry.material(primitive) });
        }
        if smooth {
            let normals = smooth_normals(&self.vertices, &self.faces[first..]);
            normals.into_iter().for_each(|(k, normal)| self.vertices[k as usize].normal = normal);
        }
    }

    fn add_triangle(&mut self, vertices: &[Vec3; 3], label: Label) {
        let first = self.vertices.len() as u32;
        let faces = self.faces.len();
        self.vertices.extend(vertices.map(|v| Vertex { point: v.as_dvec3(), normal: DVec3::ZERO }));
        self.add_face([first, first + 1, first + 2, first + 2], label);
        match self.faces.get(faces) {
            Some(face) => self.vertices[first as usize..].iter_mut().for_each(|v| v.normal = face.normal),
            None => self.vertices.truncate(first as usize),
        }
    }
}

/// A triangle as one of its corners sees it.
struct Wedge {
    vertex: u32,
    normal: DVec3,
    angle: f64,
}

/// Averages over the triangles around each corner, weighted by their angles there (Thürmer &
/// Wüthrich 1998), so that it does not matter how a flat region is cut into triangles.
fn smooth_normals(vertices: &[Vertex], triangles: &[Face]) -> Vec<(u32, DVec3)> {
    let mut places: HashMap<([u64; 3], u32), Vec<Wedge>> = HashMap::new();
    for face in triangles {
        for k in 0..3 {
            let corner = |i: usize| vertices[face.corners[(k + i) % 3] as usize].point;
            let angle = (corner(1) - corner(0)).angle_between(corner(2) - corner(0));
            let wedge = Wedge { vertex: face.corners[k], normal: face.normal, angle };
            // Adding zero makes −0 and 0 the same place.
            let place = (corner(0) + DVec3::ZERO).to_array().map(f64::to_bits);
            places.entry((place, face.material)).or_default().push(wedge);
        }
    }
    let groups = places.values().filter(|group| group.len() <= CROWDED);
    groups.flat_map(|group| group.iter().map(|w| (w.vertex, average(w.normal, group)))).collect()
}

fn average(own: DVec3, around: &[Wedge]) -> DVec3 {
    let same_sheet = around.iter().filter(|w| w.normal.dot(own) > SHARP);
    same_sheet.map(|w| w.normal * w.angle).sum::<DVec3>().normalize_or(own)
}
