//! A2T3: normals as colours.

use a1_ray_casting::{Layer, Sight};
use common::counters::Counters;
use common::math::Vec3;

/// |x|, |y|, |z| of the world-space unit normal as red, green, blue; what is missed is black.
/// Two-sided lighting does not touch it, since the sign does not show.
pub struct Normals;

impl Layer for Normals {
    fn value(&self, sight: &Sight, _: &mut Counters) -> Vec3 {
        sight.surface().map_or(Vec3::ZERO, |s| s.normal.abs())
    }
}
