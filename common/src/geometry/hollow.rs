//! Closed bodies with nothing else in them.

use super::{Body, Geometry, Sheet};
use crate::math::Bounds;

/// In scenes of more primitives nobody looks: each body would be held against all of them.
const MOST_PRIMITIVES: usize = 4096;

/// Widens boxes against the rounding of a plane's distance, relative to the coordinates.
const SLACK: f64 = 1e-12;

impl Geometry {
    /// Whether a primitive bounds a closed convex body ([`Geometry::convex_body`]) whose box nothing
    /// else reaches into. Then a ray that starts inside meets the inner side of that body next,
    /// wherever it goes.
    pub fn is_hollow(&self, primitive: u32) -> bool {
        let (run, _) = self.locate(primitive);
        *run.hollow.get_or_init(|| {
            self.len() <= MOST_PRIMITIVES
                && self.convex_body(primitive).is_some_and(|body| !self.reaches_into(&body))
        })
    }

    /// Whether anything but what bounds it reaches into a body's box.
    fn reaches_into(&self, body: &Body) -> bool {
        let boxes = self.triangles.iter().map(|corners| Bounds::of_points(*corners));
        let triangles = self.triangle_numbers.iter().copied().zip(boxes);
        let solids = self.solids.iter().map(|solid| (solid.primitive, solid.bounds));
        let mut others = triangles.chain(solids).filter(|(number, _)| !body.is_bounded_by(*number));
        others.any(|(_, bounds)| bounds.overlaps(&body.bounds))
            || self.sheets.iter().any(|sheet| cuts(sheet, &body.bounds))
    }
}

/// Whether the plane of a sheet passes through a box, or may do so.
fn cuts(sheet: &Sheet, body: &Bounds) -> bool {
    let plane = &sheet.plane;
    let (min, max) = (body.min.as_dvec3(), body.max.as_dvec3());
    let (middle, half) = ((min + max) / 2.0, (max - min) / 2.0);
    let reach = half.dot(plane.normal.abs());
    let distance = (middle.dot(plane.normal) - plane.offset).abs();
    let slack = SLACK * (min.abs().max(max.abs()).element_sum() + plane.offset.abs());
    // Written so that NaN counts as cutting.
    let beside = distance > reach + slack;
    !beside
}

#[cfg(test)]
mod tests {
    use crate::scene::{MeshSource, parse_str};
    use crate::{geometry::Geometry, mesh::Mesh, mesh::MeshError};
    use std::sync::Arc;

    struct Cube;

    impl MeshSource for Cube {
        fn mesh(&mut self, _: &str) -> Result<Arc<Mesh>, MeshError> {
            let corner = |i: u32| [i & 1, i >> 1 & 1, i >> 2].map(|bit| 2.0 * bit as f32 - 1.0);
            let positions = (0..8).map(|i| corner(i).into()).collect();
            let side = |[a, b, c, d]: [u32; 4]| [[a, b, c], [a, c, d]];
            let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
            let triangles = sides.into_iter().flat_map(side).collect();
            Ok(Arc::new(Mesh { positions, triangles, ..Mesh::default() }))
        }
    }

    /// Whether the first thing of a scene, a ball or a cube of radius 1 at the origin, is hollow
    /// beside something else.
    fn hollow(other: &str) -> [bool; 2] {
        ["Sphere { center 0 0 0  radius 1 }", "TriangleMesh { obj_file cube }"].map(|body| {
            let text = format!(
                "PerspectiveCamera {{ center 0 0 5 direction 0 0 -1 up 0 1 0 angle 40 }}
                 Materials {{ numMaterials 1 PhongMaterial {{ }} }}
                 Group {{ numObjects 2 MaterialIndex 0 {body} {other} }}"
            );
            let scene = parse_str("test", &text, &mut Cube).unwrap_or_else(|e| panic!("{e}"));
            Geometry::build(&scene).expect("it is sound").is_hollow(0)
        })
    }

    #[test]
    fn what_reaches_into_the_box_makes_it_not_hollow() {
        assert_eq!(hollow("Sphere { center 3 0 0  radius 1.9 }"), [true; 2]);
        assert_eq!(hollow("Sphere { center 3 0 0  radius 2.1 }"), [false; 2]);
        assert_eq!(hollow("Sphere { center 0.2 0 0  radius 0.1 }"), [false; 2], "inside");
        assert_eq!(hollow("Triangle { vertex0 2 2 2  vertex1 3 2 2  vertex2 2 3 2 }"), [true; 2]);
        assert_eq!(hollow("Triangle { vertex0 9 0 0  vertex1 -9 9 0  vertex2 -9 -9 0 }"), [false; 2]);
        assert_eq!(hollow("Plane { normal 0 1 0  offset -1.001 }"), [true; 2]);
        assert_eq!(hollow("Plane { normal 0 1 0  offset -1 }"), [false; 2], "it touches");
        assert_eq!(hollow("Plane { normal 1 1 1  offset 1.7 }"), [false; 2], "a corner of the box");
        assert_eq!(hollow("Transform { Translate 2.5 0 0 TriangleMesh { obj_file cube } }"), [true; 2]);
        assert_eq!(hollow("Transform { Translate 1.5 0 0 TriangleMesh { obj_file cube } }"), [false; 2]);
    }

    #[test]
    fn what_is_no_closed_body_is_not_hollow() {
        let text = "PerspectiveCamera { center 0 0 5 direction 0 0 -1 up 0 1 0 angle 40 }
            Materials { numMaterials 1 PhongMaterial { } }
            Group { numObjects 2 MaterialIndex 0
                Plane { normal 0 1 0 offset 0 } Triangle { vertex0 0 1 0 vertex1 1 1 0 vertex2 0 2 0 } }";
        let scene = parse_str("test", text, &mut Cube).unwrap_or_else(|e| panic!("{e}"));
        let geometry = Geometry::build(&scene).expect("it is sound");
        assert_eq!([0, 1].map(|primitive| geometry.is_hollow(primitive)), [false; 2]);
    }
}
