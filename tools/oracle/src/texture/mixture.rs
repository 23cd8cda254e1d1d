//! Weighted plain surfaces.

use crate::Surface;
use crate::optics::transmittance;
use common::math::DVec3;

/// The plain surfaces that a material is made of at a point. Weights are above zero and sum to
/// 1. What a mixture looks like is the weighted sum of what its parts look like.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mixture {
    parts: Vec<(f64, Surface)>,
}

/// The transparent parts of a mixture that bend light alike.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Glass {
    /// The index of refraction that they share.
    pub index: f64,
    /// Sum of their weights.
    pub share: f64,
    /// Weighted sum of their transparent colours.
    pub transparent: DVec3,
}

/// What a ray travels in: weights and Beer–Lambert coefficients of the mixed materials, none in
/// vacuum.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Medium(Vec<(f64, DVec3)>);

impl Mixture {
    pub(crate) fn add(&mut self, weight: f64, surface: Surface) {
        self.parts.push((weight, surface));
    }

    /// Weights and surfaces.
    pub fn parts(&self) -> impl Iterator<Item = (f64, &Surface)> {
        self.parts.iter().map(|(weight, surface)| (*weight, surface))
    }

    /// The weighted sum of a property.
    pub fn sum(&self, of: impl Fn(&Surface) -> DVec3) -> DVec3 {
        self.parts().map(|(weight, surface)| weight * of(surface)).sum()
    }

    /// What a ray travels in that has entered here.
    pub(crate) fn inside(&self) -> Medium {
        Medium(self.parts().map(|(weight, surface)| (weight, surface.absorption)).collect())
    }

    /// The transparent parts, those of one index of refraction together.
    pub(crate) fn glasses(&self) -> Vec<Glass> {
        let mut glasses: Vec<Glass> = Vec::new();
        for (weight, surface) in self.parts().filter(|(_, surface)| surface.is_transparent()) {
            let index = surface.index_of_refraction;
            let known = glasses.iter().position(|glass| glass.index == index);
            let at = known.unwrap_or_else(|| {
                glasses.push(Glass { index, share: 0.0, transparent: DVec3::ZERO });
                glasses.len() - 1
            });
            let glass = &mut glasses[at];
            glass.share += weight;
            glass.transparent += weight * surface.transparent;
        }
        glasses
    }
}

impl Medium {
    /// What is left of light after `distance`, which may be infinite: the weighted mean of
    /// exp(−absorption·distance).
    pub fn transmittance(&self, distance: f64) -> DVec3 {
        if self.0.is_empty() {
            return DVec3::ONE;
        }
        let left = |&(weight, absorption): &(f64, DVec3)| weight * transmittance(absorption, distance);
        self.0.iter().map(left).sum()
    }
}
