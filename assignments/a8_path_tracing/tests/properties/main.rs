//! What must hold whatever the scene: properties 13, 14 and 16 of accuracy.md, and the skips.

mod bsdf;
mod chi;
mod determinism;
mod energy;
mod lights;
mod skips;
mod slope;
mod stage;
mod unbiased;
