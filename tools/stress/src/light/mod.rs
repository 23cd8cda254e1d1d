//! accuracy.md, properties 13 and 14: no light is made and none is lost, samples follow their
//! densities, and every way to find the light finds the same light.

mod bsdf;
mod chi;
mod choices;
mod energy;
pub mod everything;
mod lights;
mod sky;
mod slope;
pub mod stage;
mod unbiased;

pub(crate) use bsdf::{glass, highlights, reciprocity, samples, weights};
pub(crate) use choices::trees;
pub(crate) use energy::{absorption, black_box, cut_short, furnace, glossy, shells, white_sky};
pub(crate) use lights::{offers, weighed};
pub(crate) use sky::sky_offers;
pub(crate) use slope::slopes;
pub(crate) use unbiased::{bounces, direct_light, integrators, samplers};
