//! A9T5: triangles that face the wrong way.

use super::surface::Surface;
use rayon::prelude::*;

/// Triangles of a simplified mesh that look against the original.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Flips {
    /// How many.
    pub faces: usize,
    /// Their share of the simplified mesh's area, in [0, 1].
    pub area: f64,
}

impl Flips {
    /// A triangle is flipped if its normal points away from those of all triangles of the original
    /// that are nearest to its centroid. (There are several where that is on an edge.)
    pub fn between(original: &Surface, simplified: &Surface) -> Self {
        let count = simplified.corners.len();
        let flipped: Vec<usize> =
            (0..count).into_par_iter().filter(|&t| is_flipped(original, simplified, t)).collect();
        let area = flipped.iter().fold(0.0, |sum, &t| sum + simplified.area_of(t));
        let whole = simplified.area();
        Self { faces: flipped.len(), area: if whole > 0.0 { area / whole } else { 0.0 } }
    }
}

fn is_flipped(original: &Surface, simplified: &Surface, triangle: usize) -> bool {
    let [a, b, c] = simplified.corners[triangle];
    let (centroid, normal) = ((a + b + c) / 3.0, simplified.normals[triangle]);
    let against = |t: u32| normal.dot(original.normals[t as usize]) < 0.0;
    let Some(nearest) = original.tree.nearest(centroid, None) else { return false };
    // Most faces agree with the first that is found; the others are asked only about the rest.
    against(nearest.triangle) && !original.tree.any_within(centroid, nearest.squared, |t| !against(t))
}
