//! A gyroid cut off by a ball: marching tetrahedra on a coarse lattice, then cut fine and pulled
//! onto the surface.

use super::Generated;
use super::refine::refine;
use super::wave::{cosine, sine};
use crate::mesh::{Bounds, Mesh};
use crate::polygonise::polygonise;
use glam::DVec3;

/// Triangles of the coarse mesh from which on it is cut finer instead of made finer.
const COARSE: usize = 40_000;
/// Lattices are this wide; the ball has radius 1.
const WIDTH: f64 = 2.2;
/// Turns per unit of length.
const FREQUENCY: f64 = 1.25;

/// A closed surface of high genus in the unit ball: the side of the gyroid
/// sin x cos y + sin y cos z + sin z cos x = 0 (A. Schoen, 1970) that is negative, 2.5 periods
/// across, its rim rounded off by the ball. The number of triangles is that of a coarse mesh
/// times a square, and within a few percent of the number wanted.
pub fn gyroid(triangles: usize) -> Generated {
    let parts = (1..).find(|n| triangles / (n * n) <= COARSE).expect("some number is large enough");
    let base = coarse(triangles / (parts * parts));
    let step = if parts == 1 { 0 } else { 4 };
    refine(&base, parts, |p| (0..step).fold(p, |p, _| pulled(p)))
}

/// The lattice whose mesh comes nearest to the number wanted: triangles grow as the square of
/// its cells, roughly, so several lattices about that are tried.
fn coarse(wanted: usize) -> Mesh {
    let mesh = |cells: f64| {
        let half = DVec3::splat(WIDTH / 2.0);
        polygonise(|p| level(p).0, Bounds { min: -half, max: half }, WIDTH / cells)
    };
    let off = |mesh: &Mesh| mesh.triangles.len().abs_diff(wanted);
    let guess = 24.0 * (wanted as f64 / mesh(24.0).triangles.len() as f64).sqrt();
    let tried = (0..24).map(|k| guess * (0.85 + f64::from(k) / 80.0)).map(|cells| mesh(cells.max(4.0)));
    tried.min_by_key(off).expect("some meshes to choose from")
}

/// One Newton step towards the surface, of at most 0.05.
fn pulled(p: DVec3) -> DVec3 {
    let (value, gradient) = level(p);
    let step = gradient * (value / gradient.length_squared().max(1e-3));
    let length = step.length();
    p - if length > 0.05 { step * (0.05 / length) } else { step }
}

/// The function whose zeros are the surface, negative inside, and its gradient.
pub fn level(p: DVec3) -> (f64, DVec3) {
    let q = p * FREQUENCY;
    let [sx, sy, sz] = q.to_array().map(sine);
    let [cx, cy, cz] = q.to_array().map(cosine);
    let slope = 2.0 * std::f64::consts::PI * FREQUENCY;
    let gyroid = sx * cy + sy * cz + sz * cx;
    let gyroid_gradient = DVec3::new(cx * cy - sz * sx, cy * cz - sx * sy, cz * cx - sy * sz) * slope;
    // The ball has the same slope at its rim as the gyroid has on average.
    let ball = 5.0 * (p.length_squared() - 1.0);
    let ball_gradient = 10.0 * p;
    // A rounded maximum: the hyperbola that has both as asymptotes.
    let apart = gyroid - ball;
    let root = (apart * apart + 0.04).sqrt();
    let share = 0.5 + 0.5 * apart / root;
    (0.5 * (gyroid + ball + root), gyroid_gradient * share + ball_gradient * (1.0 - share))
}
