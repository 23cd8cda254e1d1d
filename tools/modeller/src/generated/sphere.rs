//! A ball with hills: an icosahedron cut fine, blown up and displaced.

use super::Generated;
use super::refine::refine;
use super::wave::{cosine, sine};
use crate::mesh::Mesh;
use glam::DVec3;

/// A closed surface about the origin, star-shaped, radius between 0.6 and 1.4, with 20 n²
/// triangles for the n that comes nearest to the number wanted. The surface does not depend on
/// that number, only how finely it is cut.
pub fn sphere(triangles: usize) -> Generated {
    let parts = (1..).find(|n| 20 * n * (n + 1) + 10 > triangles).expect("some number is large enough");
    refine(&icosahedron(), parts, |p| {
        let unit = p / p.length();
        unit * (1.0 + relief(unit))
    })
}

/// Six octaves of waves, each half as high and twice as fine as the one before.
fn relief(p: DVec3) -> f64 {
    let (mut height, mut frequency, mut sum) = (0.2, 0.55, 0.0);
    for octave in 0..6 {
        let (q, shift) = (p * frequency, 0.17 * f64::from(octave));
        sum += height
            * sine(q.x + 0.3 * q.z + shift)
            * cosine(1.1 * q.y - shift)
            * sine(0.9 * q.z + 0.2 * q.y + 0.1);
        height *= 0.5;
        frequency *= 2.0;
    }
    sum
}

/// Twenty triangles that face outwards.
fn icosahedron() -> Mesh {
    let golden = (1.0 + 5f64.sqrt()) / 2.0;
    let mut positions = Vec::new();
    for (a, b) in [(-1.0, golden), (1.0, golden), (-1.0, -golden), (1.0, -golden)] {
        positions.push(DVec3::new(a, b, 0.0));
        positions.push(DVec3::new(0.0, a, b));
        positions.push(DVec3::new(b, 0.0, a));
    }
    let mut triangles = Vec::new();
    let near = |a: usize, b: usize| positions[a].distance_squared(positions[b]) < 4.5;
    for a in 0..12 {
        for b in a + 1..12 {
            for c in (b + 1..12).filter(|&c| near(a, b) && near(b, c) && near(c, a)) {
                let [p, q, r] = [a, b, c].map(|v: usize| positions[v]);
                let outwards = (q - p).cross(r - p).dot(p) > 0.0;
                triangles.push(if outwards { [a, b, c] } else { [a, c, b] }.map(|v| v as u32));
            }
        }
    }
    Mesh { positions, triangles }
}
