//! Patterns in space (course rule §5).

use super::noise::turbulence;
use crate::transform::product;
use common::math::{DMat4, DVec3};
use common::scene::{SolidTexture, SolidTextureKind};

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

    /// The part in [0, 1] of the first child at a point of the world.
    pub fn first_part(&self, point: DVec3) -> f64 {
        let p = self.matrix.transform_point3(point);
        match self.kind {
            SolidTextureKind::Checkerboard => {
                let steps = p.floor().element_sum();
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
