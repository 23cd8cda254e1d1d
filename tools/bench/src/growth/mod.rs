//! How the cost of a ray grows with the number of triangles: the same surface, cut ever finer.

mod table;

use crate::clock;
use crate::rays::{RaySet, make};
use crate::report::Section;
use crate::sample::Sample;
use crate::scaling::Scaling;
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
/// Builds that take longer, in milliseconds, are not repeated.
const AGAIN: f64 = 300.0;
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
    let (mut points, mut building) = (Vec::new(), Scaling::new("Building", &STRUCTURES));
    for mesh in &options.meshes {
        note(&format!("{mesh} ..."));
        let world = World::named(mesh)?;
        let (new, builds) = on_mesh(&world, options)?;
        building.add(mesh, world.triangles(), &builds);
        points.extend(new);
    }
    let mut section = table::section(&points);
    building.show(&mut section);
    Ok(section)
}

/// Draws the plot of the cost of a ray.
///
/// # Errors
/// If it cannot be written.
pub fn draw(options: &Options, section: &Section) -> Result<(), AppError> {
    section.figures.first().map_or(Ok(()), |figure| figure.draw(&options.svg))?;
    note(&format!("plot: {}", options.svg.display()));
    Ok(())
}

/// What rays cost through each structure, and the milliseconds that each took to build.
fn on_mesh(world: &World, options: &Options) -> Result<(Vec<Point>, Vec<Sample>), AppError> {
    let names = SETS.map(str::to_owned);
    let sets = make(world, &Tree::new(&world.mesh), usize::from(options.side), &names);
    let (mut built, mut builds) = (Vec::new(), Vec::new());
    for structure in 0..STRUCTURES.len() {
        let (accel, time) = build_timed(structure, &world.geometry, options.rounds)?;
        built.push(accel);
        builds.push(time);
    }
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
    Ok(((0..times.len()).map(point).collect(), builds))
}

/// A structure, and milliseconds of processor time; what is quick to build is built again.
fn build_timed(
    structure: usize,
    geometry: &Geometry,
    rounds: usize,
) -> Result<(Box<dyn Accel + '_>, Sample), AppError> {
    let (accel, span) = clock::time(|| build(structure, geometry))?;
    let mut times: Sample = [span.cpu].into_iter().collect();
    if span.cpu < AGAIN {
        for _ in 1..rounds {
            times.add(clock::time(|| drop(black_box(build(structure, geometry))))?.1.cpu);
        }
    }
    Ok((accel, times))
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
            ["sphere2k", "sphere32k"].map(|name| on_mesh(&World::named(name).unwrap(), &options).unwrap().0);
        for (a, b) in small.iter().zip(&large) {
            assert!(b.nodes > a.nodes && b.nodes < 3.0 * a.nodes, "{a:?} {b:?}");
            assert!(a.time.median() > 0.0 && a.tests > 0.0);
        }
    }
}
