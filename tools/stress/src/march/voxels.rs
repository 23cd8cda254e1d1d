//! Property 11: no cell of a shape is missing.

use super::{any_cells, ends, lattice_point};
use crate::Stress;
use crate::kit::Draw;
use a5_grid::voxelise::{solid_cells, triangle_cells};
use a5_grid::{Cells, Fit};
use common::geometry::{Solid, SolidShape};
use common::math::{Bounds, DVec3};
use common::shape::sphere::Sphere;
use std::collections::HashSet;

/// The cells whose interior holds a point, one if it is well inside.
fn holder(cells: &Cells, p: DVec3) -> Option<[usize; 3]> {
    let mut cell = [0; 3];
    for a in 0..3 {
        let planes = &cells.planes[a];
        let above = planes.partition_point(|plane| *plane <= p[a]);
        let margin = 1e-9 * (planes[planes.len() - 1] - planes[0]).max(p[a].abs());
        if above == 0
            || above == planes.len()
            || p[a] - planes[above - 1] < margin
            || planes[above] - p[a] < margin
        {
            return None;
        }
        cell[a] = above - 1;
    }
    Some(cell)
}

/// Points of the triangle, its corners and borders first.
fn point_of(draw: &mut Draw, [a, b, c]: [DVec3; 3], i: usize) -> DVec3 {
    let (mut u, mut v) = (draw.unit(), draw.unit());
    match i {
        0 => return a,
        1 => return b,
        2 => return c,
        3..=5 => v = 0.0,
        6..=8 => u = 0.0,
        9..=11 => v = 1.0 - u,
        _ if u + v > 1.0 => (u, v) = (1.0 - u, 1.0 - v),
        _ => {}
    }
    a + (b - a) * u + (c - a) * v
}

/// Fifty points of each of 20,000 triangles: the cell around each holds the triangle.
pub fn triangles(stress: &Stress) {
    stress.run("p11 voxelised triangles (50 pairs each)", 1104, 20_000, |draw| {
        let cells = any_cells(draw, 60);
        let (min, max) = ends(&cells);
        let reach = draw.magnitude(-2.0, 0.3);
        let middle = draw.point(min, max);
        let mut corner = || {
            let free = (middle.as_dvec3() + draw.cube() * (max - min).as_dvec3() * reach).as_vec3();
            if draw.chance(0.2) { lattice_point(draw, &cells) } else { free.clamp(min, max) }
        };
        let mut vertices = [corner(), corner(), corner()];
        if draw.chance(0.2) {
            vertices[2] = vertices[0].lerp(vertices[1], 0.37);
        }
        let mut held = HashSet::new();
        let mut twice = false;
        triangle_cells(&cells, &vertices, Fit::Exact, |c| twice |= !held.insert(c));
        let mut missing = None;
        for i in 0..50 {
            let p = point_of(draw, vertices.map(|v| v.as_dvec3()), i);
            missing = missing.or(holder(&cells, p).filter(|c| !held.contains(c)).map(|c| (c, p)));
        }
        let mut bounds = HashSet::new();
        triangle_cells(&cells, &vertices, Fit::Bounds, |c| twice |= !bounds.insert(c));
        match missing {
            None if !twice && held.is_subset(&bounds) => Ok(held.len() as f64 / bounds.len() as f64),
            _ => Err(format!("twice {twice}, missing {missing:?}\n{vertices:?} in {:?}", cells.count)),
        }
    });
}

/// The same for spheres.
pub fn spheres(stress: &Stress) {
    stress.run("p11 voxelised spheres (50 pairs each)", 1105, 20_000, |draw| {
        let cells = any_cells(draw, 40);
        let (min, max) = ends(&cells);
        let radius = f64::from((max - min).min_element()) * draw.between(0.01, 0.5);
        let center = draw.point(min, max).as_dvec3();
        let (low, high) = (center - DVec3::splat(radius), center + DVec3::splat(radius));
        let shape = SolidShape::Sphere(Sphere { center, radius });
        let solid = Solid { primitive: 0, shape, bounds: Bounds::enclosing(low, high), transformed: false };
        let (mut exact, mut bounds) = (HashSet::new(), HashSet::new());
        solid_cells(&cells, &solid, Fit::Exact, |c| {
            exact.insert(c);
        });
        solid_cells(&cells, &solid, Fit::Bounds, |c| {
            bounds.insert(c);
        });
        for _ in 0..50 {
            let p = center + draw.direction() * radius;
            if let Some(cell) = holder(&cells, p).filter(|c| !exact.contains(c) || !bounds.contains(c)) {
                return Err(format!("{cell:?} is missing of {center} radius {radius} in {:?}", cells.count));
            }
        }
        Ok(exact.len() as f64)
    });
}
