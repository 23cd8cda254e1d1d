//! A9T4: points spread evenly over a surface.

use super::surface::Surface;
use common::math::DVec3;

/// `count` points, one in each of as many parts of equal area, in the order of the triangles. The
/// i-th one does not depend on how many threads ask.
#[derive(Clone, Copy)]
pub struct Samples<'a> {
    surface: &'a Surface,
    count: usize,
}

impl<'a> Samples<'a> {
    /// Points of a surface; none if it has no area.
    pub fn new(surface: &'a Surface, count: usize) -> Self {
        Self { surface, count: if surface.area() > 0.0 { count } else { 0 } }
    }

    /// How many points there are.
    pub fn len(&self) -> usize {
        self.count
    }

    /// The i-th point.
    ///
    /// Within its triangle it is uniform: √r₁ is the share of the way from the first corner to
    /// the opposite side (Turk, "Generating Random Points in Triangles", Graphics Gems, 1990).
    pub fn point(&self, i: usize) -> DVec3 {
        let [within, r1, r2] = [0, 1, 2].map(|k| random(3 * i as u64 + k));
        let area = (i as f64 + within) / self.count as f64 * self.surface.area();
        let triangle = self.surface.area_up_to.partition_point(|sum| *sum <= area);
        let [a, b, c] = self.surface.corners[triangle.min(self.surface.corners.len() - 1)];
        a + ((b - a) * (1.0 - r2) + (c - a) * r2) * r1.sqrt()
    }
}

/// The n-th number of a fixed sequence, in [0, 1): a counter, scrambled (Steele, Lea & Flood,
/// "Fast Splittable Pseudorandom Number Generators", 2014).
fn random(n: u64) -> f64 {
    let mut z = n.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}
