//! A height field over a square.

use super::wave::sine;
use super::{Generated, rounded};
use glam::{DVec2, DVec3};

/// An open surface y = h(x, z) over the square [−1, 1]², of as many triangles as are wanted to
/// within a row; |h| < 0.65.
pub fn terrain(triangles: usize) -> Generated {
    let squares = triangles / 2;
    let columns = ((squares as f64).sqrt().round() as usize).max(1);
    let rows = ((squares + columns / 2) / columns).max(1);
    let at = |k: usize, n: usize| 2.0 * k as f64 / n as f64 - 1.0;
    let place = |i: usize, j: usize| {
        let p = DVec2::new(at(i, columns), at(j, rows));
        rounded(DVec3::new(p.x, height(p), p.y))
    };
    let positions =
        (0..=rows).flat_map(|j| (0..=columns).map(move |i| (i, j))).map(|(i, j)| place(i, j)).collect();
    let mut triangles = Vec::with_capacity(2 * rows * columns);
    for j in 0..rows {
        for i in 0..columns {
            let a = (j * (columns + 1) + i) as u32;
            let [b, c, d] = [a + 1, a + columns as u32 + 2, a + columns as u32 + 1];
            triangles.extend([[a, c, b], [a, d, c]]);
        }
    }
    Generated { positions, triangles }
}

/// Eight octaves of waves that run in turned directions, so that no axis shows; the valleys are
/// broad and the ridges sharp.
fn height(p: DVec2) -> f64 {
    let (mut q, mut height, mut sum) = (p * 0.6, 0.16, 0.0);
    for _ in 0..8 {
        let wave = sine(q.x + 0.4 * sine(0.7 * q.y)) * sine(q.y + 0.3);
        sum += height * (2.0 * wave * wave - 0.5) * (1.0 - 0.3 * wave);
        // A turn by the angle of the 3-4-5 triangle, and twice as fine.
        q = 2.0 * DVec2::new(0.6 * q.x - 0.8 * q.y, 0.8 * q.x + 0.6 * q.y) + DVec2::splat(0.37);
        height *= 0.5;
    }
    sum
}
