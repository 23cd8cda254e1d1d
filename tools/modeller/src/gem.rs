//! A round brilliant-cut gem: table, 8 stars, 8 kites, 16 upper girdle facets, a faceted girdle, 16
//! lower girdle facets and 8 pavilion mains, 110 triangles in all.
//!
//! Heights and radii are free within the box that the scene's camera expects; the points where
//! three facets meet are computed, so that every kite is flat: each lies on a plane through its
//! girdle corner that is perpendicular to its own azimuth.

use crate::circle;
use crate::mesh::Mesh;
use glam::{DVec2, DVec3};

/// Radius of the girdle.
const RADIUS: f64 = 2.0;
/// Height of the table, and the radius of its corners.
const TABLE: (f64, f64) = (0.998, 1.08);
/// Height of the culet, the point at the bottom.
const CULET: f64 = -1.805;
/// Heights of the girdle's lower and upper edge.
const GIRDLE: (f64, f64) = (0.02, 0.16);
/// Radius at which star, kites and upper girdle facets meet.
const STAR_TIP: f64 = 1.45;
/// Radius at which lower girdle facets and pavilion mains meet.
const LOWER_TIP: f64 = 0.5;

/// First vertex of each ring; every ring runs counter-clockwise seen from above.
const TABLE_RING: u32 = 0; // 8 at even sixteenths
const STAR_RING: u32 = 8; // 8 at odd sixteenths
const UPPER_RING: u32 = 16; // 16
const LOWER_RING: u32 = 32; // 16
const PAVILION_RING: u32 = 48; // 8 at odd sixteenths
const CULET_POINT: u32 = 56;

/// The gem, its axis along z and the table up.
pub fn gem() -> Mesh {
    let mut mesh = Mesh { positions: vertices(), triangles: Vec::new() };
    table(&mut mesh);
    for eighth in 0..8 {
        crown(&mut mesh, eighth);
        girdle(&mut mesh, eighth);
        pavilion(&mut mesh, eighth);
    }
    mesh
}

fn vertices() -> Vec<DVec3> {
    let circle = circle::points(circle::sixteenth_turn(), 16);
    let ring = |first: usize, step: usize, radius: f64, z: f64| {
        let points = circle.clone().into_iter().skip(first).step_by(step);
        points.map(move |p: DVec2| (p * radius).extend(z))
    };
    // A tip lies a sixteenth of a turn from its kite's azimuth: along the azimuth it is only this
    // far out.
    let along = circle[1].x;
    let kite = Slope::through((RADIUS, GIRDLE.1), (TABLE.1, TABLE.0));
    let main = Slope::through((RADIUS, GIRDLE.0), (0.0, CULET));
    ring(0, 2, TABLE.1, TABLE.0)
        .chain(ring(1, 2, STAR_TIP, kite.height(STAR_TIP * along)))
        .chain(ring(0, 1, RADIUS, GIRDLE.1))
        .chain(ring(0, 1, RADIUS, GIRDLE.0))
        .chain(ring(1, 2, LOWER_TIP, main.height(LOWER_TIP * along)))
        .chain([DVec3::new(0.0, 0.0, CULET)])
        .collect()
}

/// A facet's plane seen edge-on: height over distance along its azimuth.
struct Slope {
    at: (f64, f64),
    rise: f64,
}

impl Slope {
    fn through(a: (f64, f64), b: (f64, f64)) -> Self {
        Slope { at: a, rise: (b.1 - a.1) / (b.0 - a.0) }
    }

    fn height(&self, distance: f64) -> f64 {
        self.at.1 + (distance - self.at.0) * self.rise
    }
}

fn table(mesh: &mut Mesh) {
    mesh.triangles.extend((1..7).map(|i| [TABLE_RING, TABLE_RING + i, TABLE_RING + i + 1]));
}

/// One kite, one star and two upper girdle facets.
fn crown(mesh: &mut Mesh, eighth: u32) {
    let next = (eighth + 1) % 8;
    let (corner, next_corner) = (TABLE_RING + eighth, TABLE_RING + next);
    let (tip, tip_before) = (STAR_RING + eighth, STAR_RING + (eighth + 7) % 8);
    let [main, half, next_main] = [2 * eighth, 2 * eighth + 1, 2 * next].map(|i| UPPER_RING + i);
    mesh.triangles.extend([[corner, tip_before, main], [corner, main, tip]]);
    mesh.triangles.push([corner, tip, next_corner]);
    mesh.triangles.extend([[tip, main, half], [tip, half, next_main]]);
}

/// Two upright rectangles.
fn girdle(mesh: &mut Mesh, eighth: u32) {
    for i in [2 * eighth, 2 * eighth + 1] {
        let j = (i + 1) % 16;
        let [a, b, c, d] = [LOWER_RING + i, LOWER_RING + j, UPPER_RING + j, UPPER_RING + i];
        mesh.triangles.extend([[a, b, c], [a, c, d]]);
    }
}

/// One pavilion main and two lower girdle facets.
fn pavilion(mesh: &mut Mesh, eighth: u32) {
    let (tip, tip_before) = (PAVILION_RING + eighth, PAVILION_RING + (eighth + 7) % 8);
    let [main, half, next_main] = [2 * eighth, 2 * eighth + 1, (2 * eighth + 2) % 16].map(|i| LOWER_RING + i);
    mesh.triangles.extend([[CULET_POINT, main, tip_before], [CULET_POINT, tip, main]]);
    mesh.triangles.extend([[tip, half, main], [tip, next_main, half]]);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Six times the volume of the tetrahedron: zero if the four points lie on one plane.
    fn spread(mesh: &Mesh, [a, b, c, d]: [u32; 4]) -> f64 {
        let p = |v: u32| mesh.positions[v as usize];
        (p(b) - p(a)).cross(p(c) - p(a)).dot(p(d) - p(a))
    }

    #[test]
    fn kites_and_mains_are_flat() {
        let mesh = gem();
        for i in 0..8 {
            let before = (i + 7) % 8;
            let kite = [TABLE_RING + i, STAR_RING + before, UPPER_RING + 2 * i, STAR_RING + i];
            let main = [CULET_POINT, PAVILION_RING + before, LOWER_RING + 2 * i, PAVILION_RING + i];
            assert!(spread(&mesh, kite).abs() < 1e-13);
            assert!(spread(&mesh, main).abs() < 1e-13);
        }
    }

    #[test]
    fn the_gem_is_convex() {
        let mesh = gem();
        for t in 0..mesh.triangles.len() {
            let [a, b, c] = mesh.corners(t);
            let normal = (b - a).cross(c - a).normalize();
            let highest = mesh.positions.iter().map(|&p| normal.dot(p - a)).fold(f64::NEG_INFINITY, f64::max);
            assert!(highest < 1e-12, "a vertex rises {highest} above facet {t}");
        }
    }
}
