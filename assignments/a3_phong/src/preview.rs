//! A3T3: the scene drawn without rays.

use crate::{Canvas, Corner, Face, Tessellation, rasterise};
use common::camera::Camera;
use common::geometry::Surface;
use common::math::{DVec3, Vec3};
use common::picture::Film;

/// The sine of the angle by which a smooth normal must face the same way as its polygon does.
/// Far above what rounding could undo, far below what anyone could see.
const FACING: f64 = 1e-4;

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
            let mut color = |k: u32| {
                let known = &mut known[k as usize][usize::from(from_behind)];
                *known.get_or_insert_with(|| self.smooth_color(face, k, from_behind))
            };
            face.split(
                face.corners
                    .map(|k| Corner { color: flat.unwrap_or_else(|| color(k)), ..corners[k as usize] }),
            )
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
        self.color(face.material, self.middle(face), face.normal)
    }

    /// The colour of one corner of a polygon. Near a silhouette the smooth normal may point
    /// away although the polygon itself faces the viewer (or the other way round). The polygon
    /// decides; the normal is bent until it just agrees, else outlines would turn black.
    fn smooth_color(&self, face: &Face, vertex: u32, from_behind: bool) -> Vec3 {
        let vertex = &self.tessellation.vertices[vertex as usize];
        let sight = self.sight(vertex.point);
        let side = if from_behind { 1.0 } else { -1.0 };
        let towards = vertex.normal.dot(sight) * side;
        let missing = (FACING - towards).max(0.0);
        self.color(
            face.material,
            vertex.point,
            (vertex.normal + sight * (missing * side)).normalize_or_zero(),
        )
    }

    fn color(&self, material: u32, point: DVec3, normal: DVec3) -> Vec3 {
        let surface = Surface {
            point,
            error: DVec3::ZERO,
            normal: normal.as_vec3(),
            geometric_normal: normal,
            material,
        };
        (self.light)(&surface, self.sight(point).as_vec3())
    }
}
