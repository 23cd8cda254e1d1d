//! Patterns in space (course rule §5).

use super::noise::turbulence;
use crate::transform::product;
use common::math::{DMat4, DVec3};
use common::scene::{SolidTexture, SolidTextureKind};

/// Rounding of a hit point and its image, as a part of the numbers that were added up: a few
/// hundred times 2⁻⁵³, for rays that come from afar.
const ROUNDING: f64 = 1e-13;

/// A pattern and the two materials that it blends.
#[derive(Clone, Debug)]
pub(super) struct Solid {
    kind: SolidTextureKind,
    /// From the world to the pattern's space.
    matrix: DMat4,
    /// Both stand before the texture in the scene.
    pub children: [u32; 2],
}

impl Solid {
    pub fn new(texture: &SolidTexture) -> Self {
        Self { kind: texture.kind, matrix: product(&texture.transform), children: texture.children }
    }

    /// `p`, the image of `point`, with coordinates that are whole numbers but for rounding made
    /// so. Faces often lie between two layers of cubes, on the floor y = 0 for one, and would
    /// show specks of both.
    fn settled(&self, point: DVec3, p: DVec3) -> DVec3 {
        let [x, y, z, w] = [0, 1, 2, 3].map(|column| self.matrix.col(column).truncate().abs());
        // A hit point is as uncertain along each axis as its largest coordinate is.
        let sum = (x + y + z) * point.abs().max_element() + w;
        let settle = |axis: usize| {
            let whole = p[axis].round();
            if (p[axis] - whole).abs() <= ROUNDING * sum[axis] { whole } else { p[axis] }
        };
        DVec3::from_array(std::array::from_fn(settle))
    }

    /// The part in [0, 1] of the first child at a point of the world.
    pub fn first_part(&self, point: DVec3) -> f64 {
        let p = self.matrix.transform_point3(point);
        match self.kind {
            SolidTextureKind::Checkerboard => {
                let steps = self.settled(point, p).floor().element_sum();
                if steps.rem_euclid(2.0) == 0.0 { 1.0 } else { 0.0 }
            }
            SolidTextureKind::Noise { octaves } => (turbulence(p, octaves) + 0.5).clamp(0.0, 1.0),
            SolidTextureKind::Marble { octaves, frequency, amplitude } => {
                stripes(f64::from(frequency) * p.x + f64::from(amplitude) * turbulence(p, octaves))
            }
            SolidTextureKind::Wood { octaves, frequency, amplitude } => {
                let from_axis = p.x.hypot(p.z);
                stripes(f64::from(frequency) * from_axis + f64::from(amplitude) * turbulence(p, octaves))
            }
        }
    }
}

/// The sine moved into [0, 1].
fn stripes(phase: f64) -> f64 {
    (phase.sin() + 1.0) / 2.0
}
