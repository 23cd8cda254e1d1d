//! accuracy.md, properties 13 and 14: no light is made and none is lost, samples follow their
//! densities, and every way to find the light finds the same light.

mod bsdf;
mod chi;
mod energy;
mod lights;
mod slope;
pub mod stage;
mod unbiased;

pub(crate) use bsdf::{glass, highlights, reciprocity, samples, weights};
pub(crate) use energy::{black_box, cut_short, furnace, glossy, shells, white_sky};
pub(crate) use lights::{offers, sky_offers, trees, weighed};
pub(crate) use slope::slopes;
pub(crate) use unbiased::{bounces, direct_light, integrators, samplers};
