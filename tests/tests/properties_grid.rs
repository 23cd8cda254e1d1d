//! accuracy.md, property 11: the march visits the cells of exact arithmetic, in order, each
//! once, and no cell that a shape touches is without it.

use a5_grid::voxelise::{solid_cells, triangle_cells};
use a5_grid::{Cells, Fit, March};
use common::geometry::{Solid, SolidShape};
use common::math::{Bounds, DVec3, Interval, Vec3};
use common::ray::Ray;
use common::shape::sphere::Sphere;
use std::collections::HashSet;
use tests::property::{Draw, cells_crossed, ray_bits, run};

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

fn check(cells: &Cells, ray: &Ray, forward: bool) -> Result<f64, String> {
    let interval = if forward { Interval::FORWARD } else { Interval::ALL };
    let steps: Vec<_> = March::new(cells, ray, interval).into_iter().flatten().collect();
    let visited: Vec<_> = steps.iter().map(|s| s.cell).collect();
    let crossed = cells_crossed(&cells.planes, ray, forward);
    // A ray that only touches the box may name the cell that it touches.
    let touches = crossed.is_empty() && visited.len() <= 1;
    let ordered =
        steps.iter().all(|s| s.enter <= s.exit) && steps.windows(2).all(|w| w[0].exit == w[1].enter);
    if (visited == crossed || touches) && ordered {
        return Ok(crossed.len() as f64);
    }
    let different = visited.iter().zip(&crossed).position(|(a, b)| a != b);
    let at = different.unwrap_or(visited.len().min(crossed.len()));
    Err(format!(
        "{:?} cells in {:?} .. {:?}, step {at}: visited {:?}, crossed {:?}, {} and {} cells\n{}",
        cells.count,
        cells.corners([0; 3]).0,
        cells.planes.each_ref().map(|p| p[p.len() - 1]),
        visited.get(at),
        crossed.get(at),
        visited.len(),
        crossed.len(),
        ray_bits(ray)
    ))
}

#[test]
fn p11_the_march_visits_the_cells_of_exact_arithmetic() {
    let longest = run("p11 march, random rays, up to 1024 cells an axis", 1101, 100_000, |draw| {
        let cells = any_cells(draw, 1024);
        random_ray(draw, &cells).and_then(|(ray, forward)| check(&cells, &ray, forward))
    });
    assert!(longest > 1000.0, "the longest way had only {longest} cells");
    run("p11 march, random rays, up to 40 cells an axis", 1102, 900_000, |draw| {
        let cells = any_cells(draw, 40);
        random_ray(draw, &cells).and_then(|(ray, forward)| check(&cells, &ray, forward))
    });
}

fn random_ray(draw: &mut Draw, cells: &Cells) -> Result<(Ray, bool), String> {
    let (min, max) = ends(cells);
    let size = max - min;
    let origin = if draw.chance(0.5) { draw.point(min, max) } else { draw.point(min - size, max + size) };
    let direction = if draw.chance(0.7) { draw.point(min, max) - origin } else { draw.direction().as_vec3() };
    Ok((Ray::new(origin, direction), draw.chance(0.7)))
}

fn ends(cells: &Cells) -> (Vec3, Vec3) {
    let last = |a: usize| cells.planes[a][cells.count[a]] as f32;
    (cells.corners([0; 3]).0.as_vec3(), Vec3::new(last(0), last(1), last(2)))
}

/// Along edges, through corners, within faces; from outside, inside and on the box.
#[test]
fn p11_the_march_along_edges_corners_and_faces() {
    run("p11 march, special rays", 1103, 200_000, |draw| {
        let cells = any_cells(draw, 64);
        let (min, max) = ends(&cells);
        let start = lattice_point(draw, &cells);
        let target = if draw.chance(0.5) { lattice_point(draw, &cells) } else { draw.point(min, max) };
        let mut direction = target - start;
        for a in 0..3 {
            if draw.chance(0.3) {
                direction[a] = draw.pick(&[0.0, -0.0]);
            }
        }
        if direction == Vec3::ZERO {
            direction = draw.pick(&[Vec3::X, Vec3::Y, Vec3::Z, Vec3::ONE, -Vec3::X]);
        }
        let back = draw.pick(&[0.0f32, 0.0, 1.0, 2.0]);
        let ray = Ray::new(start - direction * back, direction);
        check(&cells, &ray, draw.chance(0.7))
    });
}

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
#[test]
fn p11_no_cell_of_a_triangle_is_missing() {
    run("p11 voxelised triangles (50 pairs each)", 1104, 20_000, |draw| {
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

#[test]
fn p11_no_cell_of_a_sphere_is_missing() {
    run("p11 voxelised spheres (50 pairs each)", 1105, 20_000, |draw| {
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
