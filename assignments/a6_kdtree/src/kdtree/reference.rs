//! What nodes hold while the tree is built: primitives, with the box of the part that reaches
//! into the node.

use super::clip::{common_part, halves, split_triangle};
use super::sah::Split;
use a5_grid::overlap::sphere_meets_box;
use common::geometry::{Geometry, Solid, SolidShape};
use common::math::{Bounds, Vec3};

/// A primitive in a node.
#[derive(Clone, Copy, Debug)]
pub struct Reference {
    /// The box of all of it that lies in the node.
    pub bounds: Bounds,
    /// A triangle's position in [`Geometry::triangles`]; a solid's in [`Geometry::solids`]
    /// counts on from there.
    pub primitive: u32,
}

/// The box of a solid, widened by more than the test of the solid is off (a few units of 2⁻⁵²
/// of its distance from the ray's origin): a line that runs beside the true solid and is said
/// to hit it must still pass the box.
pub fn padded(solid: &Solid) -> Bounds {
    let pad = solid.bounds.reach_from(Vec3::ZERO) * 2f32.powi(-22) + f32::MIN_POSITIVE;
    let limit = Vec3::splat(f32::MAX);
    Bounds {
        min: (solid.bounds.min - Vec3::splat(pad)).max(-limit),
        max: (solid.bounds.max + Vec3::splat(pad)).min(limit),
    }
}

/// All finite primitives, each with its whole box.
pub fn all(geometry: &Geometry) -> Vec<Reference> {
    let triangles = geometry.triangles().iter().map(|t| Bounds::of_points(*t));
    let boxes = triangles.chain(geometry.solids().iter().map(padded));
    boxes.enumerate().map(|(i, bounds)| Reference { bounds, primitive: i as u32 }).collect()
}

/// The solid behind a reference's number; `None` if it is a triangle.
#[inline]
pub fn solid_index(geometry: &Geometry, primitive: u32) -> Option<usize> {
    (primitive as usize).checked_sub(geometry.triangles().len())
}

impl Reference {
    /// The one child, 0 or 1, that it belongs to; 2 if it reaches into both.
    #[inline]
    pub fn side(&self, split: &Split) -> usize {
        let (low, high) = (self.bounds.min[split.axis], self.bounds.max[split.axis]);
        let planar = low == high && low == split.at;
        // Without a jump: the side cannot be predicted.
        let (below, above) = (high <= split.at, low >= split.at);
        let whole = if below { 0 } else { 2 - usize::from(above) };
        if planar { usize::from(!split.planar_left) } else { whole }
    }

    /// The boxes of its parts in both children, `None` where it does not reach.
    pub fn parts(&self, geometry: &Geometry, split: &Split) -> [Option<Bounds>; 2] {
        let Some(index) = solid_index(geometry, self.primitive) else {
            let vertices = &geometry.triangles()[self.primitive as usize];
            return split_triangle(vertices, &self.bounds, split.axis, split.at);
        };
        let solid = &geometry.solids()[index];
        halves(&self.bounds, split.axis, split.at)
            .map(|half| common_part(&half, &self.bounds).filter(|part| reaches(solid, part)))
    }
}

/// Whether the surface of a solid may reach into a box within its own: the inside of a sphere
/// is empty, and so are the corners around it.
pub fn reaches(solid: &Solid, part: &Bounds) -> bool {
    match &solid.shape {
        SolidShape::Sphere(s) => {
            let slack = f64::from(solid.bounds.reach_from(Vec3::ZERO)) * 2f64.powi(-21);
            sphere_meets_box(s.center, s.radius, part.min.as_dvec3(), part.max.as_dvec3(), slack)
        }
        SolidShape::Ellipsoid(_) => true,
    }
}
