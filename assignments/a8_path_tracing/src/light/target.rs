//! Points of flat lights, for surfaces that ask for them by way of something else.

use super::{Lights, Receiver};
use common::geometry::Surface;
use common::math::{DVec3, Vec3};

/// A point of a flat light, chosen evenly over its area.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// The point.
    pub surface: Surface,
    /// Radiance that it gives off.
    pub radiance: Vec3,
    /// The light's area over the probability of choosing it.
    pub area_per_chance: f64,
}

impl Lights<'_> {
    /// A point of a flat light for a point of the unit square, for whoever is interested in what
    /// light reaches `from`.
    pub fn target(&self, from: DVec3, [u, v]: [f64; 2]) -> Option<Target> {
        let at = Receiver { point: from.as_vec3(), normal: Vec3::ZERO };
        let (light, chance, u) = self.tree.choose(&at, u)?;
        let area = self.areas.get(light as usize)?;
        let surface = area.flat_point(self.geometry, [u, v])?;
        let area_per_chance = area.area() / f64::from(chance);
        Some(Target { surface, radiance: self.emitted(&surface), area_per_chance })
    }

    /// [`Target::area_per_chance`] of this shining primitive for whoever is interested in what light
    /// reaches `from`; `None` if [`Lights::target`] never chooses it.
    pub fn area_per_chance(&self, from: DVec3, primitive: u32) -> Option<f64> {
        let index = self.light_of(primitive)?;
        let area = &self.areas[index as usize];
        area.facing()?;
        let at = Receiver { point: from.as_vec3(), normal: Vec3::ZERO };
        let chance = f64::from(self.tree.probability(&at, index));
        (chance > 0.0).then(|| area.area() / chance)
    }

    /// Whether [`Lights::target`] may find anything.
    pub fn any_flat(&self) -> bool {
        self.areas.iter().any(|area| area.facing().is_some())
    }
}
