//! Ways to go from cell to cell.
//!
//! All but ours follow Amanatides & Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing"
//! (1987), on equal cells: the ray enters the box by the slab test, the first cell is the rounded
//! down position there, and the axis whose next plane is nearest is stepped along. They differ in
//! precision, and in whether the next crossing is the last one plus a constant or is worked out
//! anew from the plane.

use crate::numerics::real::Real;
use a5_grid::{Cells, March};
use common::math::Interval;
use common::ray::Ray;

/// Equal cells, the first corner at 0.
pub struct Field {
    /// Side of a cell, rounded to single precision.
    pub side: f32,
    /// The same, rounded to double precision.
    pub exact_side: f64,
    /// Cells along each axis.
    pub count: usize,
    /// The same in the form that ours takes.
    pub cells: Cells,
}

/// Takes note of every cell, in order.
pub type Walk = fn(&Field, &Ray, &mut dyn FnMut([usize; 3]));

/// What is compared.
pub struct Way {
    /// What it is called in tables.
    pub name: &'static str,
    /// The march.
    pub walk: Walk,
}

/// All ways.
pub const WAYS: [Way; 5] = [
    Way { name: "Amanatides–Woo, f32", walk: |f, ray, visit| walk::<f32, true>(f, f.side, ray, visit) },
    Way { name: "recomputing, f32", walk: |f, ray, visit| walk::<f32, false>(f, f.side, ray, visit) },
    Way {
        name: "Amanatides–Woo, f64", walk: |f, ray, visit| walk::<f64, true>(f, f.exact_side, ray, visit)
    },
    Way { name: "recomputing, f64", walk: |f, ray, visit| walk::<f64, false>(f, f.exact_side, ray, visit) },
    Way { name: "ours", walk: ours },
];

fn ours(field: &Field, ray: &Ray, visit: &mut dyn FnMut([usize; 3])) {
    if let Some(march) = March::new(&field.cells, ray, Interval::FORWARD) {
        march.for_each(|step| visit(step.cell));
    }
}

/// A whole number in the precision of the march; exact, for cells are fewer than 2²⁴.
fn number<T: Real>(n: usize) -> T {
    T::from(n as f32)
}

#[inline(always)]
fn walk<T: Real, const ADDING: bool>(field: &Field, side: T, ray: &Ray, visit: &mut dyn FnMut([usize; 3])) {
    let (zero, n) = (T::from(0.0), field.count);
    let origin = ray.origin.to_array().map(T::from);
    let direction = ray.direction.to_array().map(T::from);
    let far = number::<T>(n) * side;
    let (mut enter, mut leave) = (zero, T::from(f32::INFINITY));
    for axis in 0..3 {
        let [a, b] = [zero, far].map(|plane| (plane - origin[axis]) / direction[axis]);
        let (first, last) = if a < b { (a, b) } else { (b, a) };
        enter = if first > enter { first } else { enter };
        leave = if last < leave { last } else { leave };
    }
    if enter > leave {
        return;
    }
    let mut cell: [usize; 3] = std::array::from_fn(|axis| {
        let place: f64 = ((origin[axis] + direction[axis] * enter) / side).into();
        (place.max(0.0) as usize).min(n - 1)
    });
    let forward = direction.map(|d| d > zero);
    let crossing = |axis: usize, cell: usize| {
        let plane = number::<T>(cell + usize::from(forward[axis])) * side;
        (plane - origin[axis]) / direction[axis]
    };
    let mut next: [T; 3] = std::array::from_fn(|axis| crossing(axis, cell[axis]));
    let step: [T; 3] = std::array::from_fn(|axis| {
        let whole = side / direction[axis];
        if forward[axis] { whole } else { -whole }
    });
    loop {
        visit(cell);
        let low = if next[0] < next[1] { 0 } else { 1 };
        let axis = if next[low] < next[2] { low } else { 2 };
        if cell[axis] == if forward[axis] { n - 1 } else { 0 } {
            return;
        }
        cell[axis] = if forward[axis] { cell[axis] + 1 } else { cell[axis] - 1 };
        next[axis] = if ADDING { next[axis] + step[axis] } else { crossing(axis, cell[axis]) };
    }
}
