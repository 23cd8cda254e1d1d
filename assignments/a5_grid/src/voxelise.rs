//! A5T1: which cells does a primitive belong to?

use crate::cells::{Cells, for_each_cell};
use crate::overlap::{TriangleOverlap, sphere_meets_box};
use common::geometry::{Geometry, Solid, SolidShape};
use common::math::{Bounds, DVec3, Vec3};

/// How closely cells follow a primitive.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Fit {
    /// The course's rule: a triangle and a transformed sphere fill their box, an untransformed
    /// sphere every cell whose centre is within radius + half the cell's diagonal
    Bounds,
    /// Only cells that the surface passes through
    Exact,
}

/// Rounding of a few operations on coordinates of this size, generously.
fn slack(reach: f64) -> f64 {
    reach * 2f64.powi(-40)
}

/// Calls `visit` with every cell of a triangle.
pub fn triangle_cells(cells: &Cells, vertices: &[Vec3; 3], fit: Fit, mut visit: impl FnMut([usize; 3])) {
    let bounds = Bounds::of_points(*vertices);
    let (min, max) = (bounds.min.as_dvec3(), bounds.max.as_dvec3());
    let spans = cells.spans(min, max);
    // A triangle is in one piece: if its box is cut along one axis only, it reaches every part.
    let cuts = spans.iter().filter(|(first, last)| first < last).count();
    if fit == Fit::Bounds || cuts < 2 {
        return for_each_cell(spans, visit);
    }
    let reach = min.abs().max(max.abs()).max_element();
    let overlap = TriangleOverlap::new(vertices.map(|v| v.as_dvec3()), slack(reach));
    for_each_cell(spans, |cell| {
        let (low, high) = cells.corners(cell);
        if overlap.meets_box(low, high) {
            visit(cell);
        }
    });
}

/// Calls `visit` with every cell of a sphere or ellipsoid.
pub fn solid_cells(cells: &Cells, solid: &Solid, fit: Fit, mut visit: impl FnMut([usize; 3])) {
    let (min, max) = (solid.bounds.min.as_dvec3(), solid.bounds.max.as_dvec3());
    match (&solid.shape, fit) {
        (SolidShape::Sphere(s), Fit::Bounds) if !solid.transformed => {
            let reach = s.radius + cells.half_diagonal();
            let around = DVec3::splat(reach + cells.half_diagonal());
            for_each_cell(cells.spans(s.center - around, s.center + around), |cell| {
                let (low, high) = cells.corners(cell);
                if ((low + high) / 2.0 - s.center).length() <= reach {
                    visit(cell);
                }
            });
        }
        (SolidShape::Sphere(s), Fit::Exact) => {
            let slack = slack(s.center.abs().max_element() + s.radius);
            let around = DVec3::splat(s.radius + slack);
            for_each_cell(cells.spans(s.center - around, s.center + around), |cell| {
                let (low, high) = cells.corners(cell);
                if sphere_meets_box(s.center, s.radius, low, high, slack) {
                    visit(cell);
                }
            });
        }
        (SolidShape::Ellipsoid(e), Fit::Exact) => {
            let around = e.half_extent() + DVec3::splat(slack(e.center().abs().max_element()));
            let (low, high) = (e.center() - around, e.center() + around);
            for_each_cell(cells.spans(low.max(min), high.min(max)), visit);
        }
        _ => for_each_cell(cells.spans(min, max), visit),
    }
}

/// How many primitives each cell holds, counting to 255.
pub fn count(cells: &Cells, geometry: &Geometry, fit: Fit) -> Vec<u8> {
    let mut counts = vec![0u8; cells.len()];
    let mut add = |cell| {
        let n = &mut counts[cells.index(cell)];
        *n = n.saturating_add(1);
    };
    geometry.triangles().iter().for_each(|t| triangle_cells(cells, t, fit, &mut add));
    geometry.solids().iter().for_each(|s| solid_cells(cells, s, fit, &mut add));
    counts
}
