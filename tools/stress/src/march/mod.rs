//! accuracy.md, property 11: the march visits the cells of exact arithmetic, in order, each
//! once, and no cell that a shape touches is without it.

mod rays;
mod voxels;

pub use rays::{random, special};
pub use voxels::{spheres, triangles};

use crate::kit::Draw;
use a5_grid::Cells;
use common::math::{Bounds, Vec3};

/// Boxes whose cells are whole, thirds of something, 10/7, unequal, far away.
fn any_cells(draw: &mut Draw, most: u32) -> Cells {
    let mut count = || 1 + (f64::from(most) * draw.unit().powi(4)) as u32;
    let counts = [count(), count(), count()];
    let size = draw.pick(&[
        Vec3::splat(1.0),
        Vec3::splat(10.0),
        Vec3::new(7.0, 10.0, 3.0),
        Vec3::new(1e-3, 1.0, 1e3),
    ]);
    let corner = draw.pick(&[Vec3::ZERO, Vec3::splat(-0.5), Vec3::new(-3.7, 11.3, 0.1), Vec3::splat(1e5)]);
    Cells::new(counts, &Bounds { min: corner, max: corner + size })
}

/// One of the planes across each axis, as near as `f32` can have it.
fn lattice_point(draw: &mut Draw, cells: &Cells) -> Vec3 {
    let on = |draw: &mut Draw, a: usize| draw.pick(&cells.planes[a]) as f32;
    Vec3::new(on(draw, 0), on(draw, 1), on(draw, 2))
}

/// The least and the greatest corner of the box.
fn ends(cells: &Cells) -> (Vec3, Vec3) {
    let last = |a: usize| cells.planes[a][cells.count[a]] as f32;
    (cells.corners([0; 3]).0.as_vec3(), Vec3::new(last(0), last(1), last(2)))
}
