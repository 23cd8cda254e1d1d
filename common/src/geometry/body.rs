//! Bodies that nothing leaves without passing their surface.

use super::{Geometry, RunKind, SolidShape};
use crate::math::{Bounds, DVec3, Vec3};
use std::collections::HashMap;

/// Meshes of more triangles are not looked at: the test takes triangles times corners.
const MOST_TRIANGLES: usize = 512;
/// How far a corner may stand out of another triangle's plane, relative to the size of the
/// coordinates: what rounding to five decimals does to facets that were cut in two.
const FLAT: f64 = 2e-5;
/// Greatest cosine between the outward normals of one triangle and the opposite of its neighbour's:
/// in a sharper wedge a ray's start could lie beside the other wall.
const BLUNT: f64 = 0.98;
/// Least height of a triangle, relative to the size of the coordinates.
const HIGH: f64 = 1e-4;

/// A closed convex body. A ray that starts inside and leaves the box has passed the surface.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    /// Its box.
    pub bounds: Bounds,
    /// Number of the first primitive of its surface …
    pub first: u32,
    /// … and the one after the last.
    pub end: u32,
}

impl Body {
    /// Whether a primitive is part of its surface.
    #[inline(always)]
    pub fn is_bounded_by(&self, primitive: u32) -> bool {
        (self.first..self.end).contains(&primitive)
    }
}

impl Geometry {
    /// The closed convex body that a primitive bounds, by itself or together with the other
    /// triangles of its mesh. `None` if there is no such body, or none that is blunt enough to be
    /// sure of where rays start.
    pub fn convex_body(&self, primitive: u32) -> Option<Body> {
        let (run, index) = self.locate(primitive);
        let (bounds, count) = match run.kind {
            RunKind::Sheet => return None,
            RunKind::Solid => match &self.solids[index].shape {
                SolidShape::Sphere(_) => (self.solids[index].bounds, 1),
                SolidShape::Ellipsoid(_) => return None,
            },
            RunKind::Triangle => {
                let triangles = run.placed.as_deref()?.triangles();
                let count = triangles.len() as u32;
                ((*run.body.get_or_init(|| convex_mesh(&self.triangles[triangles])))?, count)
            }
        };
        Some(Body { bounds, first: run.first, end: run.first + count })
    }
}

/// The box of triangles that close up to a convex body.
fn convex_mesh(triangles: &[[Vec3; 3]]) -> Option<Bounds> {
    if triangles.len() > MOST_TRIANGLES || triangles.len() < 4 {
        return None;
    }
    let corners = triangles.as_flattened();
    let bounds = Bounds::of_points(corners.iter().copied());
    let size = f64::from(bounds.min.abs().max(bounds.max.abs()).max_element());
    let walls: Vec<Wall> = triangles.iter().map(Wall::new).collect();
    let stands_out =
        |wall: &Wall| corners.iter().any(|c| wall.normal.dot(c.as_dvec3() - wall.corner) > FLAT * size);
    let sound = |wall: &Wall| wall.height > HIGH * size && !stands_out(wall);
    (walls.iter().all(sound) && closes(triangles, &walls)).then_some(bounds)
}

/// The plane of a triangle.
struct Wall {
    corner: DVec3,
    normal: DVec3,
    /// Twice the area over the longest side.
    height: f64,
}

impl Wall {
    fn new(corners: &[Vec3; 3]) -> Self {
        let [a, b, c] = corners.map(|corner| corner.as_dvec3());
        let across = (b - a).cross(c - a);
        let longest = (b - a).length().max((c - b).length()).max((a - c).length());
        Self { corner: a, normal: across.normalize_or_zero(), height: across.length() / longest }
    }
}

/// Whether every side of a triangle is that of exactly one other, run through the other way, and
/// no two walls meet in a sharp wedge.
fn closes(triangles: &[[Vec3; 3]], walls: &[Wall]) -> bool {
    // Adding 0 makes −0 and 0 one.
    let name = |corner: Vec3| (corner + Vec3::ZERO).to_array().map(f32::to_bits);
    let mut sides = HashMap::new();
    for (corners, wall) in triangles.iter().zip(walls) {
        for i in 0..3 {
            if sides.insert((name(corners[i]), name(corners[(i + 1) % 3])), wall).is_some() {
                return false;
            }
        }
    }
    sides.iter().all(|(&(from, to), wall)| {
        sides.get(&(to, from)).is_some_and(|other| -wall.normal.dot(other.normal) < BLUNT)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pyramid over a square, its top at this height.
    fn pyramid(height: f32) -> Vec<[Vec3; 3]> {
        let base = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)].map(|(x, y)| Vec3::new(x, y, 0.0));
        let top = Vec3::new(0.0, 0.0, height);
        let mut all: Vec<_> = (0..4).map(|i| [base[i], base[(i + 1) % 4], top]).collect();
        all.extend([[base[0], base[2], base[1]], [base[0], base[3], base[2]]]);
        all
    }

    #[test]
    fn a_pyramid_is_a_body_and_a_dent_is_none() {
        let bounds = Bounds { min: Vec3::new(-1.0, -1.0, 0.0), max: Vec3::new(1.0, 1.0, 1.0) };
        assert_eq!(convex_mesh(&pyramid(1.0)), Some(bounds));
        assert_eq!(convex_mesh(&pyramid(-1.0)), None, "inside out");
        assert_eq!(convex_mesh(&pyramid(0.02)), None, "walls meet at a sharp edge");
        assert_eq!(convex_mesh(&pyramid(1.0)[1..]), None, "a wall is missing");
        let mut turned = pyramid(1.0);
        turned[0].swap(0, 1);
        assert_eq!(convex_mesh(&turned), None, "a wall faces inwards");
        let mut dented = pyramid(1.0);
        let [a, b, top] = dented[0];
        let dent = (a + b + top) / 3.0 - Vec3::new(0.0, 0.2, 0.2);
        dented.splice(0..1, [[a, b, dent], [b, top, dent], [top, a, dent]]);
        assert_eq!(convex_mesh(&dented), None);
        let far =
            pyramid(1.0).into_iter().chain(pyramid(1.0).into_iter().map(|t| t.map(|c| c + Vec3::X * 5.0)));
        assert_eq!(convex_mesh(&far.collect::<Vec<_>>()), None, "two bodies");
    }
}
