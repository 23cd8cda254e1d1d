//! Planes: nets that are fine near the scene and coarse far away.

use super::{Label, Tessellation, Vertex};
use common::math::DVec3;
use common::shape::plane::{Plane, reproject};

/// Cells of equal size on each side of the middle.
const NEAR_CELLS: i32 = 8;
/// Farther out, each cell is this much larger than the one before, so that all look about
/// equally large from the middle.
const GROWTH: f64 = 1.5;
/// How many times farther than the whole scene a plane reaches. An eye at height h ≤ s above it
/// sees its edge at most 10⁻⁵ rad below the true horizon: a tenth of a pixel in a picture
/// that is 10 000 pixels wide and a right angle across.
const FAR: f64 = 1e5;
/// Polygons of one plane, at most.
pub(super) const PLANE_FACES: u64 = 6000;

impl Tessellation {
    /// A plane as a very large square around the middle of the scene. Cells near the scene are
    /// an eighth of its radius wide, so that a lamp's pool of light shows; a single polygon
    /// would have one colour to the horizon.
    pub(super) fn add_plane(&mut self, plane: &Plane, (middle, radius): (DVec3, f64), label: Label) {
        let lines = lines(if radius > 0.0 { radius } else { 1.0 });
        let (first, count) = (self.vertices.len() as u32, lines.len() as u32);
        let foot = reproject(plane, middle);
        let x = plane.normal.any_orthonormal_vector();
        let y = plane.normal.cross(x);
        for &t in &lines {
            let point = |&s: &f64| Vertex { point: foot + x * s + y * t, normal: plane.normal };
            self.vertices.extend(lines.iter().map(point));
        }
        self.add_net(count - 1, count - 1, label, |i, j| first + j * count + i);
    }
}

/// Distances of the net's lines from the middle, increasing.
fn lines(radius: f64) -> Vec<f64> {
    let far = std::iter::successors(Some(GROWTH), |x| Some(x * GROWTH)).take_while(|&x| x < FAR * GROWTH);
    let mut lines: Vec<f64> = far.map(|x| x * radius).collect();
    let near = (-NEAR_CELLS..=NEAR_CELLS).map(|i| radius * f64::from(i) / f64::from(NEAR_CELLS));
    let mirrored: Vec<f64> = lines.iter().rev().map(|x| -x).chain(near).collect();
    lines.splice(0..0, mirrored);
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a3t2_lines_of_a_plane_increase_and_are_symmetrical() {
        let lines = lines(2.0);
        assert!(lines.is_sorted_by(|a, b| a < b));
        assert!(lines.iter().zip(lines.iter().rev()).all(|(a, b)| *a == -b));
        assert!(lines[lines.len() - 1] >= 2.0 * FAR);
        assert!((lines.len() as u64 - 1).pow(2) <= PLANE_FACES);
    }
}
