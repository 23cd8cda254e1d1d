//! A9T5: how well shaped triangles are.

use common::math::DVec3;

/// Bins of the histogram.
pub const BINS: usize = 10;

/// Shapes of all triangles by q = 4√3·area / (a² + b² + c²): 1 for equal sides, towards 0 for
/// needles and caps (Bank & Smith, "Mesh Smoothing Using A Posteriori Error Estimates", 1997).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Quality {
    /// The worst.
    pub min: f64,
    /// The first percentile, between the two triangles that it falls between.
    pub percentile: f64,
    /// The mean.
    pub mean: f64,
    /// Triangles with q in [0, 0.1), [0.1, 0.2), … [0.9, 1].
    pub histogram: [usize; BINS],
}

impl Quality {
    /// Of some triangles; all zero if there are none.
    pub fn of(triangles: &[[DVec3; 3]]) -> Self {
        let mut shapes: Vec<f64> = triangles.iter().map(shape).collect();
        let Some(last) = shapes.len().checked_sub(1) else { return Self::default() };
        let mut histogram = [0; BINS];
        shapes.iter().for_each(|q| histogram[((q * BINS as f64) as usize).min(BINS - 1)] += 1);
        let mean = shapes.iter().sum::<f64>() / shapes.len() as f64;
        shapes.sort_unstable_by(f64::total_cmp);
        let (place, share) = (last / 100, (last % 100) as f64 / 100.0);
        let percentile = shapes[place] + share * (shapes[last.min(place + 1)] - shapes[place]);
        Self { min: shapes[0], percentile, mean, histogram }
    }
}

/// Shape of one triangle in [0, 1]; 0 for a point.
fn shape(&[a, b, c]: &[DVec3; 3]) -> f64 {
    let squares = a.distance_squared(b) + b.distance_squared(c) + c.distance_squared(a);
    let q = 2.0 * 3f64.sqrt() * (b - a).cross(c - a).length() / squares;
    // A point is 0 / 0.
    if q > 0.0 { q.min(1.0) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a9t5_known_shapes() {
        let (o, x) = (DVec3::ZERO, DVec3::X);
        let equal = [o, x, DVec3::new(0.5, 0.75f64.sqrt(), 0.0)];
        let right = [o, x, DVec3::Y];
        let needle = [o, x, DVec3::new(1.0, 1e-3, 0.0)];
        let q = Quality::of(&[equal, right, needle, [x; 3]]);
        let of_right = 4.0 * 3f64.sqrt() * 0.5 / 4.0;
        assert_eq!(q.histogram, [2, 0, 0, 0, 0, 0, 0, 0, 1, 1]);
        assert!((q.mean * 4.0 - 1.0 - of_right - 3f64.sqrt() * 1e-3).abs() < 1e-6, "{q:?}");
        assert_eq!((q.min, q.percentile), (0.0, 0.03 * shape(&needle)));
        assert!((Quality::of(&[equal]).min - 1.0).abs() < 1e-15);
        assert_eq!(Quality::of(&[]), Quality::default());
    }

    #[test]
    fn a9t5_one_in_a_hundred_is_worse_than_the_percentile() {
        let needle = |h: f64| [DVec3::ZERO, DVec3::X, DVec3::new(0.5, h, 0.0)];
        let triangles: Vec<_> = (1..=201).map(|i| needle(f64::from(i) * 1e-3)).collect();
        let q = Quality::of(&triangles);
        assert_eq!(q.percentile, shape(&needle(3e-3)));
        assert_eq!(q.min, shape(&needle(1e-3)));
    }
}
