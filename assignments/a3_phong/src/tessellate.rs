//! A3T2: polygons for everything that a ray can hit.
//!
//! A rasteriser only knows polygons. Spheres become a net of parallels and meridians, planes a
//! net that reaches far beyond what anyone can tell from infinity, triangles stay themselves.
//! All of it is in world space and knows no camera, so a window tessellates once and draws often.

mod mesh;
mod round;
mod sheet;

use common::geometry::Geometry;
use common::math::{Bounds, DVec3};

/// How finely round things are cut: the values of `-tessellation`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Resolution {
    /// Polygons around the axis, at least 3.
    pub theta: u32,
    /// Polygons from pole to pole, at least 2.
    pub phi: u32,
}

impl Default for Resolution {
    fn default() -> Self {
        Self { theta: 10, phi: 5 }
    }
}

/// A corner of polygons.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Where it is, in world space.
    pub point: DVec3,
    /// Unit normal of the surface that the polygons stand for, for smooth shading.
    pub normal: DVec3,
}

/// A flat polygon with three or four corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Face {
    /// Indices into [`Tessellation::vertices`], counter-clockwise seen from the front; a
    /// triangle names its last corner twice.
    pub corners: [u32; 4],
    /// Unit normal of its front.
    pub normal: DVec3,
    /// Number of the primitive that it is a part of.
    pub primitive: u32,
    /// Index into the scene's materials.
    pub material: u32,
}

impl Face {
    /// Its one or two triangles, made of what the caller knows of its corners.
    pub fn split<T: Copy>(&self, [a, b, c, d]: [T; 4]) -> impl Iterator<Item = [T; 3]> + use<T> {
        let is_triangle = self.corners[2] == self.corners[3];
        std::iter::once([a, b, c]).chain((!is_triangle).then_some([a, c, d]))
    }
}

/// A scene as polygons, in the order of its primitives.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tessellation {
    /// Corners, shared by the polygons of one round shape.
    pub vertices: Vec<Vertex>,
    /// Polygons.
    pub faces: Vec<Face>,
}

/// What polygons are made of, and for whom.
#[derive(Clone, Copy, Debug)]
pub struct Tessellator<'a> {
    /// The shapes.
    pub geometry: &'a Geometry,
    /// Fineness of round shapes.
    pub resolution: Resolution,
    /// Whether vertex normals of meshes will be looked at; if not, they are those of the faces.
    pub smooth: bool,
    /// Where the camera is. Planes reach far beyond both it and the finite objects.
    pub viewpoint: DVec3,
}

impl Tessellator<'_> {
    /// Polygons for the whole scene.
    pub fn run(&self) -> Tessellation {
        let mut out = Tessellation::default();
        let geometry = self.geometry;
        for solid in geometry.solids() {
            let material = geometry.material(solid.primitive);
            out.add_solid(&solid.shape, self.resolution, Label { primitive: solid.primitive, material });
        }
        for sheet in geometry.sheets() {
            let label = Label { primitive: sheet.primitive, material: geometry.material(sheet.primitive) };
            match sheet.plane.disc {
                Some((center, radius)) => {
                    out.add_disc(sheet.plane.normal, center, radius, self.resolution, label);
                }
                None => out.add_plane(&sheet.plane, self.surroundings(), label),
            }
        }
        out.add_triangles(geometry, self.smooth);
        // Stable, so that what lies at equal depth is drawn in the order in which rays find it.
        out.faces.sort_by_key(|f| f.primitive);
        out
    }

    /// At least as many polygons as there will be.
    pub fn most_faces(&self) -> u64 {
        let (round, sheets) = (self.geometry.solids().len() as u64, self.geometry.sheets().len() as u64);
        let net = u64::from(self.resolution.theta) * u64::from(self.resolution.phi);
        self.geometry.triangles().len() as u64 + round * net + sheets * net.max(sheet::PLANE_FACES)
    }

    /// The middle of the finite objects, and a distance from it that nothing which is finite
    /// exceeds, the camera included.
    fn surroundings(&self) -> (DVec3, f64) {
        let middle = |b: Bounds| (b.min.as_dvec3() + b.max.as_dvec3()) / 2.0;
        let bounds = self.geometry.bounds();
        let center = bounds.map_or(self.viewpoint, middle);
        let radius = bounds.map_or(0.0, |b| b.size().as_dvec3().length() / 2.0);
        (center, radius.max(center.distance(self.viewpoint)))
    }
}

/// What all polygons of a primitive have in common.
#[derive(Clone, Copy)]
struct Label {
    primitive: u32,
    material: u32,
}

impl Tessellation {
    /// Adds a polygon unless it has no area.
    fn add_face(&mut self, corners: [u32; 4], label: Label) {
        let [a, b, c, d] = corners.map(|k| self.vertices[k as usize].point);
        // The diagonals of a flat quadrilateral; for a triangle two of its sides.
        let normal = (c - a).cross(d - b).normalize_or_zero();
        if normal != DVec3::ZERO {
            self.faces.push(Face { corners, normal, primitive: label.primitive, material: label.material });
        }
    }

    /// Adds the cells between the rows of a net: cell (i, j) lies between columns i, i+1 and
    /// rows j, j+1, and sees its corners counter-clockwise in that order of axes. `vertex` tells
    /// where a corner is.
    fn add_net(&mut self, columns: u32, rows: u32, label: Label, vertex: impl Fn(u32, u32) -> u32) {
        for (i, j) in (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j))) {
            let around = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
            self.add_face(without_repetition(around), label);
        }
    }
}

/// At a pole the first or the last two corners are one: moves the repetition to the end.
fn without_repetition([a, b, c, d]: [u32; 4]) -> [u32; 4] {
    if a == b { [b, c, d, d] } else { [a, b, c, d] }
}
