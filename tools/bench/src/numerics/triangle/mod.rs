//! Tests of ray against triangle, side by side: what leaks, what is hit twice, how far t is off,
//! and what a test costs.

mod baldwin_weber;
mod cramer;
mod kernel;
mod lanes;
mod meshes;
mod moller_trumbore;
mod ours;
mod verdict;
mod woop;

use super::Effort;
use super::draw::Draw;
use super::timing::{Work, interleave};
use crate::report::{Better, Cell, Table};
use crate::sample::Sample;
use common::cli::AppError;
use common::ray::Ray;
use kernel::{Contender, Soup};
use meshes::{Body, CLASSES, bodies};
use std::hint::black_box;
use verdict::{Verdict, judge};

/// Rays of each class that are timed against every triangle.
const TIMED: usize = 256;

/// All tests, ready for one body.
fn contenders(body: &Body) -> Vec<Box<dyn Contender + '_>> {
    let triangles = body.world.geometry.triangles();
    vec![
        Box::new(Soup::<cramer::Cramer>::new(triangles)),
        Box::new(Soup::<moller_trumbore::MollerTrumbore<f32>>::new(triangles)),
        Box::new(lanes::Lanes::new(triangles)),
        Box::new(Soup::<moller_trumbore::MollerTrumbore<f64>>::new(triangles)),
        Box::new(Soup::<baldwin_weber::BaldwinWeber>::new(triangles)),
        Box::new(Soup::<woop::Woop<false>>::new(triangles)),
        Box::new(Soup::<woop::Woop<true>>::new(triangles)),
        Box::new(Soup::<ours::Exact>::new(triangles)),
        Box::new(ours::Filtered::new(&body.world.geometry)),
    ]
}

/// Judges on every body, times on the first.
///
/// # Errors
/// If two tests disagree where nothing is difficult.
pub fn measure(effort: &Effort) -> Result<Vec<Table>, AppError> {
    let bodies = bodies()?;
    let mut tables = Vec::new();
    agree(&bodies[0], &contenders(&bodies[0]))?;
    for body in &bodies {
        let contenders = contenders(body);
        // Every body gets about as many tests.
        let rays = (effort.trials * 448 / body.world.triangles()).max(1);
        tables.push(table(body, rays, &contenders, &judge(body, &contenders, rays)));
    }
    tables.push(costs(&bodies[0], effort.rounds));
    Ok(tables)
}

/// All must find the same walls in the middle of triangles near the origin, but for a few that
/// are seen past another's edge.
fn agree(body: &Body, contenders: &[Box<dyn Contender + '_>]) -> Result<(), AppError> {
    const RAYS: usize = 200;
    let mut draw = Draw::new(1);
    let rays: Vec<Ray> = (0..RAYS).map(|_| body.ray(2, &mut draw)).collect();
    let reference = contenders.last().expect("there are contenders");
    for contender in contenders {
        let same = |ray: &&Ray| {
            let (t, truth) = (contender.nearest(ray), reference.nearest(ray));
            (t - truth).abs() <= 1e-2 * truth
        };
        let right = rays.iter().filter(same).count();
        if right < RAYS * 99 / 100 {
            let (name, body) = (contender.name(), &body.world.name);
            return Err(AppError::CheckFailed(format!("{name} finds {right} of {RAYS} walls of {body}")));
        }
    }
    Ok(())
}

fn table(body: &Body, rays: usize, contenders: &[Box<dyn Contender + '_>], verdicts: &[Verdict]) -> Table {
    let names: Vec<String> = ["missed", "even"]
        .iter()
        .flat_map(|what| CLASSES.iter().map(move |class| format!("{what}: {class}")))
        .chain(["astray", "t error, median (eps)", "t error, worst (eps)"].map(str::to_owned))
        .collect();
    let columns: Vec<(&str, Better)> = names.iter().map(|name| (name.as_str(), Better::Less)).collect();
    let (name, triangles) = (&body.world.name, body.world.triangles());
    let title = format!("triangles, {name}: {triangles}, {rays} rays of each kind");
    let mut table = Table::new(title, "test", &columns);
    for (contender, v) in contenders.iter().zip(verdicts) {
        let counts = v.missed.iter().chain(&v.even).chain([&v.astray]).map(|&count| Cell::from(count));
        let errors = [0.5, 1.0].map(|share| Cell::from(v.error.quantile(share)));
        table.row(contender.name(), counts.chain(errors));
    }
    table
}

fn costs(body: &Body, rounds: usize) -> Table {
    let mut draw = Draw::new(3);
    let rays: Vec<Ray> = (0..CLASSES.len() * TIMED).map(|i| body.ray(i % CLASSES.len(), &mut draw)).collect();
    let contenders = contenders(body);
    let mut works: Vec<Work> = contenders
        .iter()
        .map(|contender| Work {
            units: (rays.len() * body.world.triangles()) as f64,
            run: Box::new(|| {
                rays.iter().for_each(|ray| {
                    black_box(contender.nearest(ray));
                })
            }),
        })
        .collect();
    let samples: Vec<Sample> = interleave(rounds, &mut works);
    drop(works);
    let mut table = Table::new("triangles: cost", "test", &[("ns per test", Better::Less)]);
    for (contender, sample) in contenders.iter().zip(&samples) {
        table.row(contender.name(), [Cell::from(sample)]);
    }
    table
}

#[cfg(test)]
mod tests;
