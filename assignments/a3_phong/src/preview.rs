//! A3T3: the scene drawn without rays.

use crate::{Canvas, Corner, Face, Tessellation, rasterise};
use common::camera::Camera;
use common::geometry::{Surface, facing};
use common::math::{DVec3, Vec3};
use common::picture::Film;

/// Barycentric weights of a triangle's second and third corner, at each of its corners.
const AT_CORNER: [[f32; 2]; 3] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];

/// How polygons get their colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shading {
    /// Each polygon has one, worked out at its middle with its own normal.
    #[default]
    Flat,
    /// Each corner has one, worked out with the smooth normal and blended over the polygon
    /// (Gouraud 1971).
    Gouraud,
}

/// Polygons, the camera that sees them, and their light.
pub struct Preview<'a, F> {
    /// What is drawn.
    pub tessellation: &'a Tessellation,
    /// From where.
    pub camera: &'a Camera,
    /// Flat or smooth.
    pub shading: Shading,
    /// The light that a surface point sends back against a unit direction of sight; the same
    /// function that shades ray-traced pictures.
    pub light: F,
}

impl<F: Fn(&Surface, Vec3) -> Vec3> Preview<'_, F> {
    /// Draws it. No shadows, mirrors or glass: light comes straight from the lamps.
    pub fn draw(&self, canvas: &Canvas) -> Film {
        let vertices = &self.tessellation.vertices;
        let corners: Vec<Corner> = vertices.iter().map(|v| self.corner(v.point)).collect();
        let mut known = vec![[None; 2]; vertices.len()];
        let triangles = self.tessellation.faces.iter().flat_map(|face| {
            let flat = (self.shading == Shading::Flat).then(|| self.flat_color(face));
            let from_behind = self.sight(self.middle(face)).dot(face.normal) > 0.0;
            let mut color = |i: usize| {
                let known = &mut known[face.corners[i] as usize][usize::from(from_behind)];
                *known.get_or_insert_with(|| self.smooth_color(face, i, from_behind))
            };
            face.split([0, 1, 2, 3].map(|i| Corner {
                color: flat.unwrap_or_else(|| color(i)),
                ..corners[face.corners[i] as usize]
            }))
        });
        rasterise(canvas, triangles)
    }

    fn corner(&self, point: DVec3) -> Corner {
        let seen = self.camera.project(point);
        Corner { screen: seen.screen, depth: seen.depth, color: Vec3::ZERO }
    }

    fn sight(&self, point: DVec3) -> DVec3 {
        self.camera.sight(point)
    }

    /// The average of the corners.
    fn middle(&self, face: &Face) -> DVec3 {
        let corners = if face.corners[2] == face.corners[3] { &face.corners[..3] } else { &face.corners[..] };
        let sum: DVec3 = corners.iter().map(|&k| self.tessellation.vertices[k as usize].point).sum();
        sum / corners.len() as f64
    }

    fn flat_color(&self, face: &Face) -> Vec3 {
        self.color(face, self.middle(face), [1.0 / 3.0; 2], face.normal)
    }

    /// The colour of corner `i` of a polygon. Whether it is seen from behind, the polygon
    /// decides, not the smooth normal of the corner.
    fn smooth_color(&self, face: &Face, i: usize, from_behind: bool) -> Vec3 {
        let vertex = &self.tessellation.vertices[face.corners[i] as usize];
        let normal = facing(vertex.normal, self.sight(vertex.point), from_behind);
        self.color(face, vertex.point, AT_CORNER[i.min(2)], normal)
    }

    /// The colour at a point of a polygon; its barycentric weights count if it is a triangle of
    /// the scene.
    fn color(&self, face: &Face, point: DVec3, weights: [f32; 2], normal: DVec3) -> Vec3 {
        let surface = Surface {
            point,
            error: DVec3::ZERO,
            normal: normal.as_vec3(),
            geometric_normal: normal,
            material: face.material,
            primitive: face.primitive,
            weights,
        };
        (self.light)(&surface, self.sight(point).as_vec3())
    }
}
