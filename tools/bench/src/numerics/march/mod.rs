//! Marches through a grid: cells that a ray truly passes through and that are skipped, cells that
//! it does not pass through, and what a cell costs.

mod marches;
mod oracle;

use super::Effort;
use super::draw::Draw;
use super::timing::{Work, interleave};
use crate::report::{Better, Cell, Table};
use a5_grid::Cells;
use common::cli::AppError;
use common::math::{Bounds, DVec3, Vec3};
use common::ray::Ray;
use marches::{Field, WAYS};
use oracle::{Lattice, Line, PARTS, STEPS};
use std::hint::black_box;

/// Cells along each axis.
const COUNTS: [usize; 3] = [10, 100, 1000];
/// Rays that are timed.
const TIMED: usize = 256;

fn field(count: usize, sevenths: i128) -> Field {
    let side = sevenths as f64 / 7.0;
    let bounds = Bounds { min: Vec3::ZERO, max: Vec3::splat((sevenths * count as i128) as f32 / 7.0) };
    let mut cells = Cells::new([count as u32; 3], &bounds);
    // The planes themselves, rounded once each.
    let plane = |k: usize| (sevenths * k as i128) as f64 / 7.0;
    cells.planes = std::array::from_fn(|_| (0..=count).map(plane).collect());
    Field { side: side as f32, exact_side: side, count, cells }
}

/// A ray in numbers that single precision and the oracle hold: anywhere from outside the box, or
/// (1) along its cells' edges and through their corners.
fn aimed(field: &Field, aim: usize, draw: &mut Draw) -> Ray {
    let size = field.exact_side * field.count as f64;
    let whole = |v: DVec3, unit: f64| (v * unit).round() / unit;
    let middle = DVec3::splat(size / 2.0);
    if aim == 1 {
        // From a corner of the lattice through other corners: two or three planes at a time.
        let corner = |draw: &mut Draw, span: f64| (draw.cube() * span).round();
        let from = (middle + corner(draw, 1.2 * field.count as f64)).round();
        let steps = [1.0, 2.0, 4.0].map(|s| DVec3::new(s, 1.0, 2.0))[draw.below(3)];
        let signs = DVec3::ONE.copysign(middle - from);
        return Ray::new(from.as_vec3(), (steps * signs / 4.0).as_vec3());
    }
    loop {
        let origin = whole(middle + draw.direction() * size * draw.between(0.9, 1.2), 4096.0);
        let target = middle + draw.cube() * size / 2.0;
        let direction = whole((target - origin).normalize(), STEPS as f64);
        // The oracle wants to move along every axis.
        if direction.abs().min_element() > 0.0 && (origin.as_vec3().as_dvec3() == origin) {
            return Ray::new(origin.as_vec3(), direction.as_vec3());
        }
    }
}

fn truth(field: &Field, sevenths: i128, ray: &Ray) -> Vec<[usize; 3]> {
    let whole = |v: Vec3, parts: i128| v.as_dvec3().to_array().map(|x| (x * parts as f64) as i128);
    let lattice = Lattice { side: sevenths * PARTS / 7, count: field.count as i128 };
    oracle::cells(
        &lattice,
        &Line { origin: whole(ray.origin, PARTS), direction: whole(ray.direction, STEPS) },
    )
}

/// What was wrong with one march, in rays.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Verdict {
    /// Rays that skip a cell which they pass through.
    skipping: u64,
    /// Rays that visit a cell which they do not pass through, or one twice.
    straying: u64,
}

fn judge(field: &Field, sevenths: i128, aim: usize, rays: usize) -> [Verdict; WAYS.len()] {
    let mut draw = Draw::new(1987);
    let mut verdicts = [Verdict::default(); WAYS.len()];
    let mut visited: Vec<[usize; 3]> = Vec::new();
    for _ in 0..rays {
        let (ray, mut true_cells) = through(field, sevenths, aim, &mut draw);
        true_cells.sort_unstable();
        for (way, verdict) in WAYS.iter().zip(&mut verdicts) {
            visited.clear();
            (way.walk)(field, &ray, &mut |cell| visited.push(cell));
            let visits = visited.len();
            visited.sort_unstable();
            visited.dedup();
            let strays = lacks(&true_cells, &visited) || visited.len() < visits;
            verdict.skipping += u64::from(lacks(&visited, &true_cells));
            verdict.straying += u64::from(strays);
        }
    }
    verdicts
}

/// A ray that passes through at least one cell, and the cells.
fn through(field: &Field, sevenths: i128, aim: usize, draw: &mut Draw) -> (Ray, Vec<[usize; 3]>) {
    loop {
        let ray = aimed(field, aim, draw);
        let cells = truth(field, sevenths, &ray);
        if !cells.is_empty() {
            return (ray, cells);
        }
    }
}

/// Whether a sorted list lacks an entry of another.
fn lacks(list: &[[usize; 3]], entries: &[[usize; 3]]) -> bool {
    entries.iter().any(|cell| list.binary_search(cell).is_err())
}

/// A grid and what rays are aimed at in it.
struct Case {
    name: String,
    count: usize,
    sevenths: i128,
    aim: usize,
    rays: usize,
}

/// All cases; finer grids get fewer rays, since each has more cells on its way.
fn cases(effort: &Effort) -> Vec<Case> {
    let mut cases = Vec::new();
    for (aim, sevenths) in [(0, 7), (0, 10), (1, 7)] {
        for count in COUNTS {
            let rays = (effort.trials * 100 / count).clamp(100, effort.trials.max(100));
            let name = match (aim, sevenths) {
                (0, 7) => format!("{count}³ of 1, {rays} rays"),
                (0, _) => format!("{count}³ of 10/7, {rays} rays"),
                _ => format!("{count}³ of 1, {rays} along edges"),
            };
            cases.push(Case { name, count, sevenths, aim, rays });
        }
    }
    cases
}

/// Judges all grids, times the one of 100³ cells.
///
/// # Errors
/// If two marches disagree on a grid where nothing is difficult.
pub fn measure(effort: &Effort) -> Result<Vec<Table>, AppError> {
    agree()?;
    let cases = cases(effort);
    let verdicts: Vec<[Verdict; WAYS.len()]> =
        cases.iter().map(|c| judge(&field(c.count, c.sevenths), c.sevenths, c.aim, c.rays)).collect();
    let columns: Vec<(&str, Better)> = cases.iter().map(|case| (case.name.as_str(), Better::Less)).collect();
    let mut skipped = Table::new("marches: rays that skip a cell which they pass through", "march", &columns);
    let title = "marches: rays that visit a cell which they do not pass through, or one twice";
    let mut strayed = Table::new(title, "march", &columns);
    for (w, way) in WAYS.iter().enumerate() {
        skipped.row(way.name, verdicts.iter().map(|v| Cell::from(v[w].skipping)));
        strayed.row(way.name, verdicts.iter().map(|v| Cell::from(v[w].straying)));
    }
    Ok(vec![skipped, strayed, costs(effort.rounds)])
}

/// Nearly all rays through few cells must visit the same.
fn agree() -> Result<(), AppError> {
    const RAYS: usize = 1000;
    let verdicts = judge(&field(10, 7), 7, 0, RAYS);
    let wrong = WAYS.iter().zip(verdicts).find(|(_, v)| v.skipping + v.straying > RAYS as u64 / 100);
    wrong.map_or(Ok(()), |(way, v)| {
        Err(AppError::CheckFailed(format!("{} goes astray in 10³ cells: {v:?}", way.name)))
    })
}

fn costs(rounds: usize) -> Table {
    let field = field(100, 7);
    let mut draw = Draw::new(4);
    let rays: Vec<Ray> = (0..TIMED).map(|_| aimed(&field, 0, &mut draw)).collect();
    let cells: usize = rays.iter().map(|ray| truth(&field, 7, ray).len()).sum();
    let field = &field;
    let run = |way: &'static marches::Way| Work {
        units: cells as f64,
        run: Box::new(|| {
            let mut sum = 0;
            rays.iter().for_each(|ray| (way.walk)(field, ray, &mut |[x, y, z]| sum += x ^ y ^ z));
            black_box(sum);
        }),
    };
    let samples = interleave(rounds, &mut WAYS.iter().map(run).collect::<Vec<Work>>());
    let mut table = Table::new("marches: cost", "march", &[("ns per cell", Better::Less)]);
    for (way, sample) in WAYS.iter().zip(&samples) {
        table.row(way.name, [Cell::from(sample)]);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_difficult_among_few_cells() {
        agree().unwrap();
    }

    #[test]
    fn adding_up_in_single_precision_skips_and_ours_does_not() {
        for sevenths in [7, 10] {
            let [adding, recomputing, .., ours] = judge(&field(1000, sevenths), sevenths, 0, 300);
            assert!(adding.skipping > 150 && adding.straying > 150, "{adding:?}");
            assert!(recomputing.skipping < 30, "{recomputing:?}");
            assert_eq!(ours, Verdict::default(), "1000³ cells of {sevenths}/7");
            let [.., ours] = judge(&field(100, sevenths), sevenths, 0, 2000);
            assert_eq!(ours, Verdict::default(), "100³ cells of {sevenths}/7");
        }
    }

    /// Who takes one axis at a time strays at every edge.
    #[test]
    fn ours_alone_crosses_edges_in_one_step() {
        let verdicts = judge(&field(100, 7), 7, 1, 300);
        let [others @ .., ours] = verdicts;
        assert!(others.iter().all(|v| v.straying > 100), "{verdicts:?}");
        assert_eq!(ours, Verdict::default());
    }
}
