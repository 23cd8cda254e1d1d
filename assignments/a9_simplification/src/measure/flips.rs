//! A9T5: triangles that face the wrong way.

use super::surface::Surface;
use common::math::DVec3;
use rayon::prelude::*;

/// Triangles of a simplified mesh that look against the original.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Flips {
    /// How many look against what is nearest: their normals point away from those of all triangles
    /// of the original that are nearest to their centroids. (There are several where that is on
    /// an edge.) Where the original is rougher than a triangle is large, or nearly folded, that
    /// may be so although nothing was turned over.
    pub faces: usize,
    /// The share of those in the simplified mesh's area, in [0, 1].
    pub area: f64,
    /// How many of those also look against the mean normal of the original around them, as far as
    /// they are large: turned over beyond doubt.
    pub turned: usize,
}

impl Flips {
    /// Counts the triangles of `simplified` that look against `original`.
    pub fn between(original: &Surface, simplified: &Surface) -> Self {
        let flipped = |t| is_flipped(original, simplified, t);
        let count = simplified.corners.len();
        let found: Vec<(usize, bool)> =
            (0..count).into_par_iter().filter_map(|t| Some((t, flipped(t)?))).collect();
        let area = found.iter().fold(0.0, |sum, (t, _)| sum + simplified.area_of(*t));
        let whole = simplified.area();
        Self {
            faces: found.len(),
            area: if whole > 0.0 { area / whole } else { 0.0 },
            turned: found.iter().filter(|(_, turned)| *turned).count(),
        }
    }
}

/// Whether a triangle that looks against what is nearest is turned over; `None` if it does not.
fn is_flipped(original: &Surface, simplified: &Surface, triangle: usize) -> Option<bool> {
    let [a, b, c] = simplified.corners[triangle];
    let (centroid, normal) = ((a + b + c) / 3.0, simplified.normals[triangle]);
    let against = |t: u32| normal.dot(original.normals[t as usize]) < 0.0;
    let nearest = original.tree.nearest(centroid, None)?;
    // Most faces agree with the first that is found; the others are asked only about the rest.
    // Distances are no better than coordinates.
    let reach = nearest.distance() + 8.0 * f64::EPSILON * centroid.abs().max_element();
    let flipped =
        against(nearest.triangle) && !original.tree.any_within(centroid, reach * reach, |t| !against(t));
    // The square over a triangle is about as wide as the triangle; a few times its distance away
    // from the original it must look further.
    let reach = simplified.area_of(triangle).max(9.0 * nearest.squared);
    flipped.then(|| normal.dot(mean_normal(original, centroid, reach)) < 0.0)
}

/// Sum of the normals of all triangles within √`reach` of a point, each by its area, but by no
/// more than `reach`.
fn mean_normal(original: &Surface, point: DVec3, reach: f64) -> DVec3 {
    let mut sum = DVec3::ZERO;
    original.tree.any_within(point, reach, |t| {
        sum += original.normals[t as usize] * original.area_of(t as usize).min(reach);
        false
    });
    sum
}
