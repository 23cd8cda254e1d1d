//! The first occupied cell along a ray.

use super::{Cell, CellGrid};
use crate::{Range, Ray};
use common::math::DVec3;

/// Where a ray enters an occupied cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellHit {
    /// The cell, from 0 along each axis.
    pub cell: [u32; 3],
    /// How many objects it holds, at least 1.
    pub count: u32,
    /// Where the ray enters; behind its origin if it starts inside the cell.
    pub t: f64,
    /// Unit outward normal of the face that it enters through.
    pub normal: DVec3,
}

impl CellGrid {
    /// The occupied cell that `ray` enters first, of those it is in anywhere inside `range`.
    ///
    /// Cells share faces. A ray inside a face belongs to the cell above it, or to the last one
    /// at the upper end of the grid; a ray that only touches an edge or a corner is not in the
    /// cell, unless the cell is flat and cannot be crossed otherwise.
    pub fn first(&self, ray: &Ray, range: Range) -> Option<CellHit> {
        let hits = self.occupied.iter().filter_map(|cell| cell.enter(ray, range));
        hits.reduce(|best, hit| if hit.t < best.t { hit } else { best })
    }
}

impl Cell {
    /// Slabs (Kay and Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986).
    fn enter(&self, ray: &Ray, range: Range) -> Option<CellHit> {
        let slabs: [(f64, f64); 3] = std::array::from_fn(|axis| self.slab(ray, axis));
        let near = DVec3::from_array(slabs.map(|(near, _)| near));
        let far = slabs.iter().map(|&(_, far)| far).fold(f64::INFINITY, f64::min);
        let axis = near.max_position();
        let t = near[axis];
        let flat = self.bounds.min.cmpeq(self.bounds.max).any();
        let crosses = t < far || (flat && t == far);
        if !crosses || far <= range.min || t >= range.max {
            return None;
        }
        let mut normal = DVec3::ZERO;
        normal[axis] = -ray.direction[axis].signum();
        Some(CellHit { cell: self.index, count: self.count, t, normal })
    }

    /// Where the line is between the two faces across `axis`; empty (∞, −∞) if it runs outside
    /// and parallel to them.
    fn slab(&self, ray: &Ray, axis: usize) -> (f64, f64) {
        let (low, high) = (self.bounds.min[axis], self.bounds.max[axis]);
        let (origin, direction) = (ray.origin[axis], ray.direction[axis]);
        if direction == 0.0 {
            let owned = low <= origin && (origin < high || (origin == high && self.last[axis]));
            let within = owned || (low == high && origin == low);
            return if within {
                (f64::NEG_INFINITY, f64::INFINITY)
            } else {
                (f64::INFINITY, f64::NEG_INFINITY)
            };
        }
        let (a, b) = ((low - origin) / direction, (high - origin) / direction);
        (a.min(b), a.max(b))
    }
}
