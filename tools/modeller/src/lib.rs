//! The modeller: makes the meshes of `scenes/meshes`, and a sky, from formulas.
//!
//! Everything is computed in `f64` with `+ - * /`, `sqrt` and comparisons only. IEEE 754 fixes the
//! result of each of these to the last bit, so the files come out the same on every machine; `sin`,
//! `exp` and their kin would not.

pub mod catalogue;
pub mod check;
pub mod circle;
pub mod cube;
pub mod gem;
pub mod generated;
pub mod glyphs;
pub mod implicit;
pub mod logo;
pub mod mesh;
pub mod obj;
pub mod outline;
pub mod polygonise;
pub mod rabbit;
pub mod relax;
pub mod sky;
pub mod triangulate;
pub mod vase;
