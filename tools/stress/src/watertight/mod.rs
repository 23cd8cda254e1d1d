//! accuracy.md, properties 1 and 2: no ray slips through a closed mesh, at any place and size,
//! through any structure, with any instructions.

mod instructions;
mod passages;
mod placed;
mod whole;

pub use instructions::instructions;
pub use passages::parity;
pub use placed::{nested, places};
pub use whole::{grids, lists, trees};

use crate::kit::{Draw, aim, exact_triangle, ray_bits, triangle_bits};
use a5_grid::{Cells, Fit, Grid};
use common::accel::Accel;
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::{Interval, Vec3};
use common::ray::Ray;

/// Cells for about one triangle each.
pub(crate) fn grid(geometry: &Geometry) -> Grid<'_> {
    let side = (geometry.len() as f64).cbrt().ceil().clamp(1.0, 40.0) as u32 + 1;
    let bounds = geometry.bounds().expect("a finite mesh");
    Grid::new(geometry, Cells::new([side; 3], &bounds), Fit::Exact).expect("a grid of moderate size")
}

/// A ray from inside hits in front.
fn must_hit(accel: &dyn Accel, ray: &Ray) -> Result<f64, String> {
    let hit = accel.nearest(ray, Interval::FORWARD, &mut Counters::default());
    if hit.is_some() { Ok(0.0) } else { Err(explain(accel.geometry().triangles(), ray)) }
}

/// Rays from inside that are asked together hit in front.
fn must_hit_together(accel: &dyn Accel, rays: &[Ray]) -> Result<f64, String> {
    let mut hits = vec![None; rays.len()];
    accel.nearest_many(rays, Interval::FORWARD, &mut hits, &mut Counters::default());
    match hits.iter().position(Option::is_none) {
        None => Ok(0.0),
        Some(lost) => Err(explain(accel.geometry().triangles(), &rays[lost])),
    }
}

/// A ray that was lost, and the triangles that exact arithmetic says it passes.
fn explain(triangles: &[[Vec3; 3]], ray: &Ray) -> String {
    let passed = triangles.iter().filter(|t| exact_triangle(ray, t).is_some_and(|h| h.t > 0.0));
    let listed: Vec<String> = passed.map(triangle_bits).collect();
    format!("{}\nexactly hit: {}", ray_bits(ray), listed.join("\n"))
}

fn from_inside(draw: &mut Draw, triangles: &[[Vec3; 3]], inside: &[Vec3]) -> Ray {
    let origin = draw.pick(inside);
    aim(draw, triangles, origin)
}
