//! Property 11: the march against an oracle that sorts all crossings exactly.

use super::{any_cells, ends, lattice_point};
use crate::kit::{Draw, cells_crossed, ray_bits};
use crate::{Stress, Trials};
use a5_grid::{Cells, March};
use common::math::{Interval, Vec3};
use common::ray::Ray;

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

/// Random rays through up to 1024 cells an axis.
pub fn random(stress: &Stress) {
    let march = |most: u32, seed: u64, trials: Trials| {
        let row = format!("p11 march, random rays, up to {most} cells an axis");
        stress.run(row, seed, trials, |draw| {
            let cells = any_cells(draw, most);
            random_ray(draw, &cells).and_then(|(ray, forward)| check(&cells, &ray, forward))
        })
    };
    let longest = march(1024, 1101, Trials::new(20_000, 1_000_000));
    stress.expect("p11 cells of the longest way", longest, |longest| longest > 1000.0);
    march(40, 1102, Trials::new(180_000, 9_000_000));
}

fn random_ray(draw: &mut Draw, cells: &Cells) -> Result<(Ray, bool), String> {
    let (min, max) = ends(cells);
    let size = max - min;
    let origin = if draw.chance(0.5) { draw.point(min, max) } else { draw.point(min - size, max + size) };
    let direction = if draw.chance(0.7) { draw.point(min, max) - origin } else { draw.direction().as_vec3() };
    Ok((Ray::new(origin, direction), draw.chance(0.7)))
}

/// Along edges, through corners, within faces; from outside, inside and on the box.
pub fn special(stress: &Stress) {
    stress.run("p11 march, special rays", 1103, 100_000, |draw| {
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
