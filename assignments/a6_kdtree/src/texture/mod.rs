//! A6T3, A6T4: textures: materials that are not the same all over.
//!
//! A *solid texture* fills space with a pattern ([`Pattern`]) and blends two other materials by
//! it; a *picture* lies on the surface and replaces the diffuse colour ([`Image`]). Textures blend
//! textures; [`TexturedScene`] works out which plain materials are left of it all at a point, and
//! how much of each.

mod image;
mod noise;
mod solid;
mod world;

pub use image::Image;
pub use noise::{fractal_noise, noise};
pub use solid::Pattern;
pub use world::{TextureError, TexturedScene};
