//! Meshes of any size, made in memory for benchmarks: the same bits on every machine.
//!
//! Three kinds that are hard in different ways: a ball with hills (closed, star-shaped), a gyroid
//! (closed, deep, many walls behind each other) and a terrain (open, flat). All are computed in
//! `f64` with `+ - * /`, `sqrt` and rounding to integers only, and rounded to `f32` at the end.

mod gyroid;
mod refine;
mod sphere;
mod terrain;
pub mod wave;

pub use gyroid::{gyroid, level as gyroid_level};
pub use sphere::sphere;
pub use terrain::terrain;

use crate::mesh::Mesh;
use glam::DVec3;
use std::str::FromStr;

/// Triangles over shared vertices in single precision; corners run counter-clockwise when seen
/// from outside (from above, for a terrain).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Generated {
    /// Vertex positions; all lie within two units of the origin.
    pub positions: Vec<[f32; 3]>,
    /// Indices into `positions`, three for each triangle.
    pub triangles: Vec<[u32; 3]>,
}

/// The kinds of generated mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// See [`sphere()`].
    Sphere,
    /// See [`gyroid()`].
    Gyroid,
    /// See [`terrain()`].
    Terrain,
}

/// What to make: `sphere200k`, `gyroid1m`, `terrain5000`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Recipe {
    /// Which surface.
    pub kind: Kind,
    /// How many triangles are wanted; each kind comes as near as it can.
    pub triangles: usize,
}

/// Fewest and most triangles that a recipe may ask for.
pub const RANGE: std::ops::RangeInclusive<usize> = 100..=20_000_000;

impl Recipe {
    /// Makes the mesh.
    pub fn make(&self) -> Generated {
        match self.kind {
            Kind::Sphere => sphere(self.triangles),
            Kind::Gyroid => gyroid(self.triangles),
            Kind::Terrain => terrain(self.triangles),
        }
    }
}

impl FromStr for Recipe {
    type Err = String;

    /// Reads a kind and a count with `k` for thousands or `m` for millions.
    fn from_str(text: &str) -> Result<Self, String> {
        let complaint = || {
            let (least, most) = RANGE.into_inner();
            format!(
                "`{text}` is no mesh: want sphere, gyroid or terrain and {least} to {most}, as in sphere200k"
            )
        };
        let digits = text.find(|c: char| c.is_ascii_digit()).ok_or_else(complaint)?;
        let (name, count) = text.split_at(digits);
        let kind = match name {
            "sphere" => Kind::Sphere,
            "gyroid" => Kind::Gyroid,
            "terrain" => Kind::Terrain,
            _ => return Err(complaint()),
        };
        let (number, factor) = match count.strip_suffix(['k', 'm']) {
            Some(number) if count.ends_with('k') => (number, 1_000),
            Some(number) => (number, 1_000_000),
            None => (count, 1),
        };
        let triangles = number.parse::<usize>().ok().and_then(|n| n.checked_mul(factor));
        let triangles = triangles.filter(|n| RANGE.contains(n)).ok_or_else(complaint)?;
        Ok(Self { kind, triangles })
    }
}

impl Generated {
    /// The same mesh in double precision, as the modeller's checks want it.
    pub fn to_mesh(&self) -> Mesh {
        let positions = self.positions.iter().map(|p| DVec3::from_array(p.map(f64::from))).collect();
        Mesh { positions, triangles: self.triangles.clone() }
    }
}

/// Rounds a position to single precision.
fn rounded(p: DVec3) -> [f32; 3] {
    p.to_array().map(|x| x as f32)
}

#[cfg(test)]
mod tests;
