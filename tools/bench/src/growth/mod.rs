//! How the cost of a ray grows with the number of triangles: the same surface, cut ever finer.

use crate::clock;
use crate::fit::fit;
use crate::rays::{RaySet, make};
use crate::report::{Better, Cell, Curve, Figure, Section, Table, Upward};
use crate::sample::Sample;
use crate::truth::Tree;
use crate::world::World;
use a6_kdtree::bvh::Bvh;
use a6_kdtree::kdtree::{KdTree, Options as TreeOptions};
use common::accel::Accel;
use common::cli::{AppError, note};
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::Interval;
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
/// Each structure with each set.
const SERIES: usize = SETS.len() * STRUCTURES.len();

/// What a ray of one set costs through one structure over one mesh.
#[derive(Clone, Debug)]
struct Point {
    series: usize,
    triangles: usize,
    /// Nanoseconds of processor time.
    time: Sample,
    /// Nodes stepped through.
    nodes: f64,
    /// Triangles tested.
    tests: f64,
}

/// Measures all meshes.
///
/// # Errors
/// If a mesh is unknown.
pub fn measure(options: &Options) -> Result<Section, AppError> {
    let mut points = Vec::new();
    for mesh in &options.meshes {
        note(&format!("{mesh} ..."));
        points.extend(on_mesh(&World::named(mesh)?, options));
    }
    Ok(Section {
        part: "growth",
        title: "Cost of a ray from a thousand to ten million triangles".to_owned(),
        remarks: vec![
            "a ray of one thread: processor time, median (quartiles); nodes; tested triangles".to_owned(),
            "fits: a + b log2 n, and the share of the variance that they explain".to_owned(),
        ],
        tables: vec![table(&points), fits(&points)],
        figures: vec![figure(&points)],
        ..Section::default()
    })
}

/// Draws the plot that was asked for.
///
/// # Errors
/// If it cannot be written.
pub fn draw(options: &Options, section: &Section) -> Result<(), AppError> {
    section.figures.iter().try_for_each(|figure| figure.draw(&options.svg))?;
    note(&format!("plot: {}", options.svg.display()));
    Ok(())
}

fn table(points: &[Point]) -> Table {
    let columns = ["ns", "nodes", "tests"].map(|name| (name, Better::Less));
    let mut table = Table::new("cost of a ray", "structure, rays, triangles", &columns);
    for p in points {
        let cells = [Cell::from(&p.time), p.nodes.into(), p.tests.into()];
        table.row(format!("{}, {}", series(p.series), p.triangles), cells);
    }
    table
}

fn figure(points: &[Point]) -> Figure {
    let time = |p: &Point| (p.triangles as f64, p.time.median());
    let curves: Vec<Curve> = (0..SERIES).map(|s| Curve::new(series(s), curve(points, s, time))).collect();
    let line = |c: &Curve| {
        let f = fit(&c.points.iter().map(|(n, ns)| (n.log2(), *ns)).collect::<Vec<_>>());
        let ends = [c.points.first(), c.points.last()];
        Curve::new("", ends.into_iter().flatten().map(|(n, _)| (*n, (f.a + f.b * n.log2()).max(0.0))))
    };
    let fits = if points.len() > SERIES { curves.iter().map(line).collect() } else { Vec::new() };
    let figure = Figure::new("Cost of a ray on ever finer meshes", "triangles", "ns per ray", curves);
    Figure { upward: Upward::Linear, fits, ..figure }
}

fn series(number: usize) -> String {
    format!("{}, {}", STRUCTURES[number / SETS.len()], SETS[number % SETS.len()])
}

fn curve(points: &[Point], series: usize, of: impl Fn(&Point) -> (f64, f64)) -> Vec<(f64, f64)> {
    points.iter().filter(|p| p.series == series).map(of).collect()
}

fn fits(points: &[Point]) -> Table {
    let names: Vec<String> = ["ns", "nodes", "tests"]
        .iter()
        .flat_map(|what| ["a", "b", "explained"].map(|number| format!("{what}: {number}")))
        .collect();
    let columns: Vec<_> = names.iter().map(|name| (name.as_str(), Better::Neither)).collect();
    let mut table = Table::new("fits", "structure, rays", &columns);
    for s in 0..SERIES {
        let line = |of: fn(&Point) -> f64| {
            let f = fit(&curve(points, s, |p| ((p.triangles as f64).log2(), of(p))));
            [f.a, f.b, f.explained]
        };
        let times = line(|p| p.time.median()).map(Cell::derived);
        let work = [line(|p| p.nodes), line(|p| p.tests)].concat();
        table.row(series(s), times.into_iter().chain(work.into_iter().map(Cell::from)));
    }
    table
}

fn on_mesh(world: &World, options: &Options) -> Vec<Point> {
    let names = SETS.map(str::to_owned);
    let sets = make(world, &Tree::new(&world.mesh), usize::from(options.side), &names);
    let built = [build(0, &world.geometry), build(1, &world.geometry)];
    let mut times = vec![Sample::default(); SERIES];
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
        time: times[s].map(|ns| ns / rays(s)),
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
            ["sphere2k", "sphere32k"].map(|name| on_mesh(&World::named(name).unwrap(), &options));
        for (a, b) in small.iter().zip(&large) {
            assert!(b.nodes > a.nodes && b.nodes < 3.0 * a.nodes, "{a:?} {b:?}");
            assert!(a.time.median() > 0.0 && a.tests > 0.0);
        }
    }
}
