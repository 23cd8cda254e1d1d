//! From the world into the space of a mesh, and how far off that may be.
//!
//! Let M p + T be the placement in exact arithmetic on its `f64` entries, I the inverse that
//! [`Affine`] has, and u = 2⁻²⁴. A corner p of the mesh is baked to w, which is M p + T but for
//! the roundings of `f64` and one of `f32`:
//!
//! > |w − (M p + T)| ≤ u|w| + 2⁻¹⁴⁹ + 2⁻⁵⁰(|M||p| + |T|), axis by axis.
//!
//! Let f ≥ ‖I M − 1‖ (greatest row sum). Since M⁻¹ = (I M)⁻¹ I, for any x
//!
//! > ‖M⁻¹x‖ ≤ ‖I x‖ / (1 − f), and ‖M⁻¹x − I x‖ ≤ f/(1 − f) ‖I x‖.
//!
//! So the corner that really is tested, taken back exactly, M⁻¹(w − T), is no farther from p along
//! any axis than *corner* = (1 + 2f) · ‖|I| |w − (M p + T)|‖.

use common::geometry::PlacedMesh;
use common::math::{Affine, Bounds, DMat3, DVec3, UNIT_ROUNDOFF};

/// The way from the world into the space of a mesh.
#[derive(Clone, Copy, Debug)]
pub struct Placement {
    /// Position of the use's first triangle in the geometry.
    pub start: usize,
    /// Number of that triangle.
    pub first: u32,
    /// I, the inverse of the linear part.
    pub inverse: DMat3,
    /// T.
    pub translation: DVec3,
    /// Greatest row sum of |I|.
    pub stretch: f64,
    /// f.
    pub residual: f64,
    /// How far a corner of the world, taken back exactly, may be from the mesh's own.
    pub corner: f64,
}

/// Several roundings of `f64`.
pub const DOUBLE: f64 = 1.0 / (1u64 << 50) as f64;

/// Half the smallest `f32` above zero, and more.
pub const UNDERFLOW: f64 = f32::MIN_POSITIVE as f64 / (1u64 << 23) as f64;

/// Entries of maps that are trusted lie between this and its inverse, far from underflow.
const ORDINARY: f64 = 1e-60;

/// Maps whose inverse is worse get a tree in the world.
const WORST: f64 = 1.0 / (1u64 << 20) as f64;

impl Placement {
    /// How rays get from the world into the mesh's space, for a use whose triangles lie within
    /// `world`. `None` if the inverse of the map is not good enough to say.
    pub fn new(placed: &PlacedMesh, world: &Bounds) -> Option<Self> {
        let Affine { linear, translation, inverse, .. } = placed.to_world;
        let (abs_linear, abs_inverse) = (abs(&linear), abs(&inverse));
        let stretch = row_sum(&abs_inverse);
        let ordinary = |x: f64| (ORDINARY..1.0 / ORDINARY).contains(&x);
        if !ordinary(stretch) || !ordinary(row_sum(&abs_linear)) {
            return None;
        }
        let residual = row_sum(&abs(&(inverse * linear - DMat3::IDENTITY)))
            + DOUBLE * row_sum(&(abs_inverse * abs_linear));
        let object = size_of(&Bounds::of_points(placed.mesh.positions.iter().copied()));
        let baked = size_of(world) * (UNIT_ROUNDOFF * 1.001)
            + DVec3::splat(UNDERFLOW)
            + (abs_linear * object + translation.abs()) * DOUBLE;
        let corner = (abs_inverse * baked).max_element() * (1.0 + 2.0 * residual) * 1.001;
        let (start, first) = (placed.start, placed.first);
        (residual <= WORST).then_some(Self { start, first, inverse, translation, stretch, residual, corner })
    }

    /// Whether `corner` is at most `coarsest` of a triangle's size, which is estimated as that of
    /// n equal ones over the mesh's box.
    pub fn is_fine(&self, placed: &PlacedMesh, coarsest: f64) -> bool {
        let extent = Bounds::of_points(placed.mesh.positions.iter().copied()).size().max_element();
        self.corner <= coarsest * f64::from(extent) / (placed.mesh.triangles.len() as f64).sqrt()
    }
}

/// Largest magnitude along each axis.
fn size_of(bounds: &Bounds) -> DVec3 {
    bounds.min.abs().max(bounds.max.abs()).as_dvec3()
}

fn abs(m: &DMat3) -> DMat3 {
    DMat3::from_cols(m.x_axis.abs(), m.y_axis.abs(), m.z_axis.abs())
}

/// Greatest row sum of a matrix without negative entries.
fn row_sum(m: &DMat3) -> f64 {
    (m.x_axis + m.y_axis + m.z_axis).max_element()
}
