//! A vase with a wall of some thickness: a closed surface of revolution about y, 3840 triangles.

use crate::circle;
use crate::mesh::Mesh;
use glam::{DVec2, DVec3};

/// Segments round the axis. Thirty, not a multiple of four: so the box is a little shorter along z
/// than along x.
const SEGMENTS: u32 = 30;
/// Rings of vertices from the middle of the foot, up the outside, over the lip and down the inside.
const RINGS: usize = 64;
/// Height, and radius of the belly.
const SIZE: (f64, f64) = (8.125, 2.304);

/// Control points (radius, height) of the profile; it starts and ends on the axis. Twice the same
/// point makes a corner.
const PROFILE: [(f64, f64); 22] = [
    (0.0, 0.0),
    (0.95, 0.0),
    (1.12, 0.0),
    (1.12, 0.1),
    (1.0, 0.32),
    (1.12, 0.75),
    (1.75, 1.9),
    (2.28, 3.2),
    (2.1, 4.5),
    (1.25, 5.6),
    (0.86, 6.4),
    (0.98, 7.3),
    (1.5, 7.98),
    (1.55, 8.12),
    (1.4, 8.1),
    (0.84, 7.35),
    (0.7, 6.4),
    (1.08, 5.55),
    (1.9, 4.4),
    (2.06, 3.2),
    (1.5, 1.9),
    (0.0, 0.62),
];

/// The vase, standing on y = 0.
pub fn vase() -> Mesh {
    let rings = fitted(evenly_spaced(&spline(&PROFILE), RINGS + 2));
    let circle = circle::points(circle::thirtieth_turn(), SEGMENTS as usize);
    let pole = |p: DVec2| DVec3::new(0.0, p.y, 0.0);
    let mut mesh = Mesh::default();
    mesh.positions.push(pole(rings[0]));
    for ring in &rings[1..=RINGS] {
        // Counter-clockwise seen from +y is from +x towards −z.
        mesh.positions.extend(circle.iter().map(|c| DVec3::new(c.x * ring.x, ring.y, -c.y * ring.x)));
    }
    mesh.positions.push(pole(rings[RINGS + 1]));
    connect(&mut mesh);
    mesh
}

/// Two fans round the poles and a band of quadrilaterals between each ring and the next.
fn connect(mesh: &mut Mesh) {
    let last_pole = mesh.positions.len() as u32 - 1;
    let vertex = |ring: u32, segment: u32| 1 + ring * SEGMENTS + segment % SEGMENTS;
    let top_ring = RINGS as u32 - 1;
    for s in 0..SEGMENTS {
        mesh.triangles.push([0, vertex(0, s + 1), vertex(0, s)]);
        for ring in 0..top_ring {
            let [a, b] = [vertex(ring, s), vertex(ring, s + 1)];
            let [c, d] = [vertex(ring + 1, s + 1), vertex(ring + 1, s)];
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
        }
        mesh.triangles.push([last_pole, vertex(top_ring, s), vertex(top_ring, s + 1)]);
    }
}

/// A dense polyline through the control points: Catmull and Rom's cubic (1974).
fn spline(control: &[(f64, f64)]) -> Vec<DVec2> {
    const PIECES: usize = 64;
    let point = |i: isize| {
        let (r, y) = control[i.clamp(0, control.len() as isize - 1) as usize];
        DVec2::new(r, y)
    };
    let mut line = Vec::new();
    for i in 0..control.len() as isize - 1 {
        let [p, q, r, s] = [-1, 0, 1, 2].map(|k| point(i + k));
        line.extend((0..PIECES).map(|k| catmull_rom([p, q, r, s], k as f64 / PIECES as f64)));
    }
    line.push(point(control.len() as isize - 1));
    line
}

/// The cubic that leaves `q` parallel to `p`→`r` and reaches `r` parallel to `q`→`s`; `t` runs from
/// 0 to 1.
fn catmull_rom([p, q, r, s]: [DVec2; 4], t: f64) -> DVec2 {
    let linear = r - p;
    let square = 2.0 * p - 5.0 * q + 4.0 * r - s;
    let cube = 3.0 * (q - r) + s - p;
    0.5 * (2.0 * q + t * (linear + t * (square + t * cube)))
}

/// `count` points of the polyline, its ends among them, equally far apart along it.
fn evenly_spaced(line: &[DVec2], count: usize) -> Vec<DVec2> {
    let total: f64 = line.windows(2).map(|w| w[0].distance(w[1])).sum();
    let step = total / (count - 1) as f64;
    let mut points = vec![line[0]];
    let mut walked = 0.0;
    for w in line.windows(2) {
        let length = w[0].distance(w[1]);
        while points.len() < count - 1 && step * points.len() as f64 <= walked + length {
            let part = (step * points.len() as f64 - walked) / length;
            points.push(w[0].lerp(w[1], part));
        }
        walked += length;
    }
    points.push(line[line.len() - 1]);
    points
}

/// The profile scaled to the vase's height and radius, its ends exactly on the axis.
fn fitted(mut profile: Vec<DVec2>) -> Vec<DVec2> {
    let low = profile.iter().fold(f64::INFINITY, |m, p| m.min(p.y));
    let high = profile.iter().fold(f64::NEG_INFINITY, |m, p| m.max(p.y));
    let wide = profile.iter().fold(0.0_f64, |m, p| m.max(p.x));
    for p in &mut profile {
        *p = DVec2::new(p.x * (SIZE.1 / wide), (p.y - low) * (SIZE.0 / (high - low)));
    }
    profile
}
