//! How the cost of a ray grows with the number of triangles: the same surface, cut ever finer.

pub mod fit;
pub mod plot;

use crate::clock;
use crate::rays::{RaySet, make};
use crate::sample::Sample;
use crate::truth::Tree;
use crate::world::World;
use a6_kdtree::bvh::Bvh;
use a6_kdtree::kdtree::{KdTree, Options as TreeOptions};
use common::accel::Accel;
use common::cli::{AppError, note, say};
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::Interval;
use fit::fit;
use plot::{Curve, Upward};
use std::hint::black_box;
use std::path::PathBuf;

/// What to measure.
#[derive(clap::Args)]
pub struct Options {
    /// Meshes, coarse to fine
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "sphere1k,sphere3k,sphere10k,sphere30k,sphere100k,sphere300k,sphere1m,sphere3m,sphere10m"
    )]
    meshes: Vec<String>,
    /// Camera rays in a row and rows of them; the other sets are as large
    #[arg(long, default_value_t = 512, value_parser = clap::value_parser!(u16).range(1..))]
    side: u16,
    /// Rounds; every round asks both structures everything once
    #[arg(long, default_value_t = 5)]
    rounds: usize,
    /// The plot
    #[arg(long, value_name = "FILE", default_value = "docs/growth.svg")]
    svg: PathBuf,
}

const SETS: [&str; 3] = ["primary", "bounce", "random"];
const STRUCTURES: [&str; 2] = ["bvh", "kd SAH"];

/// What a ray of one set costs through one structure over one mesh.
#[derive(Clone, Debug)]
struct Point {
    series: usize,
    triangles: usize,
    /// Nanoseconds of processor time, the median of the rounds.
    time: f64,
    /// Nodes stepped through.
    nodes: f64,
    /// Triangles tested.
    tests: f64,
}

/// Measures all meshes, prints the table and the fits, draws the plot.
///
/// # Errors
/// If a mesh is unknown, or the plot cannot be written.
pub fn run(options: &Options) -> Result<(), AppError> {
    let mut points = Vec::new();
    say("a ray of one thread: processor time, nodes, tested triangles");
    say(&format!("{:<16} {:>10} {:>10} {:>8} {:>8}", "", "triangles", "ns", "nodes", "tests"));
    for mesh in &options.meshes {
        note(&format!("{mesh} ..."));
        let new = measure(&World::named(mesh)?, options);
        for p in &new {
            let (name, n) = (series(p.series), p.triangles);
            say(&format!("{name:<16} {n:>10} {:>10.1} {:>8.2} {:>8.2}", p.time, p.nodes, p.tests));
        }
        points.extend(new);
    }
    print_fits(&points);
    let curves: Vec<Curve> = (0..SETS.len() * STRUCTURES.len())
        .map(|s| Curve { name: series(s), points: curve(&points, s, |p| (p.triangles as f64, p.time)) })
        .collect();
    let words = ["Cost of a ray on ever finer meshes", "triangles", "ns per ray"];
    plot::draw(&options.svg, words, Upward::Linear, &curves)?;
    say(&format!("plot: {}", options.svg.display()));
    Ok(())
}

fn series(number: usize) -> String {
    format!("{}, {}", STRUCTURES[number / SETS.len()], SETS[number % SETS.len()])
}

fn curve(points: &[Point], series: usize, of: impl Fn(&Point) -> (f64, f64)) -> Vec<(f64, f64)> {
    points.iter().filter(|p| p.series == series).map(of).collect()
}

fn print_fits(points: &[Point]) {
    say("\nfits a + b log2 n, and the share of the variance that they explain");
    for s in 0..SETS.len() * STRUCTURES.len() {
        let line = |what: &str, of: &dyn Fn(&Point) -> f64| {
            let f = fit(&curve(points, s, |p| ((p.triangles as f64).log2(), of(p))));
            format!("{what} {:>8.2} {:>+7.2} log2 n ({:.3})", f.a, f.b, f.explained)
        };
        let parts = [line("ns", &|p| p.time), line("nodes", &|p| p.nodes), line("tests", &|p| p.tests)];
        say(&format!("{:<16} {}", series(s), parts.join("   ")));
    }
}

fn measure(world: &World, options: &Options) -> Vec<Point> {
    let names = SETS.map(str::to_owned);
    let sets = make(world, &Tree::new(&world.mesh), usize::from(options.side), &names);
    let built = [build(0, &world.geometry), build(1, &world.geometry)];
    let mut times = vec![Sample::default(); SETS.len() * STRUCTURES.len()];
    let mut work = vec![Counters::default(); times.len()];
    for round in 0..=options.rounds.max(1) {
        for (s, time) in times.iter_mut().enumerate() {
            let (accel, set) = (&*built[s / SETS.len()], &sets[s % SETS.len()]);
            let (nanoseconds, counted) = shoot(accel, set);
            work[s] = counted;
            // The first round warms up.
            if round > 0 {
                time.add(nanoseconds);
            }
        }
    }
    let rays = |s: usize| sets[s % SETS.len()].rays.len().max(1) as f64;
    let point = |s: usize| Point {
        series: s,
        triangles: world.triangles(),
        time: times[s].median() / rays(s),
        nodes: work[s].cells as f64 / rays(s),
        tests: work[s].intersections as f64 / rays(s),
    };
    (0..times.len()).map(point).collect()
}

fn build(structure: usize, geometry: &Geometry) -> Box<dyn Accel + '_> {
    match structure {
        0 => Box::new(Bvh::new(geometry)),
        _ => Box::new(KdTree::new(geometry, TreeOptions::default())),
    }
}

/// Nanoseconds of processor time and what was done for all rays of a set.
fn shoot(accel: &dyn Accel, set: &RaySet) -> (f64, Counters) {
    let mut counters = Counters::default();
    let before = clock::thread_time();
    for ray in &set.rays {
        black_box(accel.nearest(ray, Interval::up_to(set.reach), &mut counters));
    }
    ((clock::thread_time() - before) as f64, counters)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Counters do not depend on the machine: sixteen times the triangles must cost every set
    /// more nodes, but far from sixteen times as many.
    #[test]
    fn nodes_grow_with_the_logarithm() {
        let options = Options { meshes: Vec::new(), side: 32, rounds: 1, svg: PathBuf::new() };
        let [small, large] =
            ["sphere2k", "sphere32k"].map(|name| measure(&World::named(name).unwrap(), &options));
        for (a, b) in small.iter().zip(&large) {
            assert!(b.nodes > a.nodes && b.nodes < 3.0 * a.nodes, "{a:?} {b:?}");
            assert!(a.time > 0.0 && a.tests > 0.0);
        }
    }
}
