//! accuracy.md, property 12: structures can be built for anything, and are valid.

use crate::kit::{Draw, Named, agree, build, geometry_of, structures};
use crate::{Stress, Trials};
use a5_grid::Fit;
use common::accel::{Accel, List};
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::{Interval, Vec3};
use common::mesh::Mesh;
use common::ray::Ray;

/// Worlds that break structures: nothing, one thing, everything in one place, no volume.
fn odd_worlds() -> Vec<(&'static str, Geometry)> {
    let point = [Vec3::ONE; 3];
    let flat = |i: usize| [Vec3::X * i as f32, Vec3::X * (i + 1) as f32, Vec3::Y + Vec3::X * i as f32];
    let one = [Vec3::ZERO, Vec3::X, Vec3::Y];
    vec![
        ("nothing", build("Group { numObjects 0 }", Mesh::default())),
        ("one sphere", build("Sphere { center 1 2 3 radius 4 }", Mesh::default())),
        ("one triangle", geometry_of(&[one])),
        ("a point", geometry_of(&[point])),
        ("coincident", geometry_of(&[one; 17])),
        ("flat", geometry_of(&(0..100).map(flat).collect::<Vec<_>>())),
        ("20000 equal", geometry_of(&[one; 20_000])),
        (
            "only planes",
            build(
                "Group { numObjects 2 Plane { normal 0 1 0 offset 0 } Plane { normal 1 0 0 offset 2 } }",
                Mesh::default(),
            ),
        ),
        (
            "huge and tiny",
            build(
                "Group { numObjects 2 Sphere { center 0 0 0 radius 1e30 } Sphere { center 1e-30 0 0 radius 1e-30 } }",
                Mesh::default(),
            ),
        ),
    ]
}

/// Structures are built, valid and right for odd worlds.
pub fn odd(stress: &Stress) {
    for (name, geometry) in odd_worlds() {
        let list = List::new(&geometry);
        list.validate().unwrap_or_else(|e| panic!("{name}: {e}"));
        let others = structures(&geometry, &[[1, 1, 1], [5, 6, 7]].map(|n| (n, Fit::Exact)));
        stress.run(format!("p12 {name}"), 1201, 1_000, |draw| {
            let origin = (draw.cube() * 5.0).as_vec3();
            let ray = Ray::new(origin, (draw.cube() * 2.0).as_vec3() - origin);
            agree(&list, &others, &ray, Interval::ALL)
        });
    }
}

/// Of equal hits the lowest number wins, in every structure.
pub fn ties(stress: &Stress) {
    let geometry = geometry_of(&[[Vec3::ZERO, Vec3::X, Vec3::Y]; 2000]);
    let ray = Ray::new(Vec3::new(0.2, 0.2, 1.0), -Vec3::Z);
    let all = structures(&geometry, &[([3, 3, 1], Fit::Exact)]);
    stress.count("p12 ties", || {
        for Named { name, accel } in &all {
            let hit = accel.nearest(&ray, Interval::FORWARD, &mut Counters::default());
            let found = hit.map(|hit| (hit.primitive, hit.t));
            assert_eq!(found, Some((0, 1.0)), "{name}");
        }
        Ok(all.len() as u64)
    });
}

/// A hundred thousand groups or transforms inside each other are prepared and hit.
pub fn nested(stress: &Stress) {
    for open in
        ["Group { numObjects 1 ", "Transform { Translate 0 0 1e-6 ", "Transform { Rotate { 1 2 3 0.01 } "]
    {
        stress.case(format!("p12 100,000 × {}", open.trim()), || nest(open));
    }
}

/// Depth of the nest.
const DEPTH: usize = 100_000;

fn nest(open: &str) -> Result<f64, String> {
    let text = format!("{} Sphere {{ center 0 0 0 radius 1 }} {}", open.repeat(DEPTH), "}".repeat(DEPTH));
    let geometry = build(&text, Mesh::default());
    let list = List::new(&geometry);
    let others = structures(&geometry, &[([5, 5, 5], Fit::Exact)]);
    let ray = Ray::new(Vec3::Z * 5.0, -Vec3::Z);
    let hit = agree(&list, &others, &ray, Interval::FORWARD)?;
    let t = list.nearest(&ray, Interval::FORWARD, &mut Counters::default()).map(|h| h.t);
    let expected = if open.contains("Translate") { 3.9 } else { 4.0 };
    let right = hit == 1.0 && t.is_some_and(|t| (t - expected).abs() < 1e-4);
    if right { Ok(hit) } else { Err(format!("{open}: {t:?}, not {expected}")) }
}

/// Triangles of all sizes, many of them in each other's way.
fn crowd(draw: &mut Draw, count: usize) -> Vec<[Vec3; 3]> {
    (0..count)
        .map(|_| {
            let (middle, size) = (draw.cube() * 10.0, draw.magnitude(-4.0, 0.5));
            [(); 3].map(|()| (middle + draw.cube() * size).as_vec3())
        })
        .collect()
}

/// Structures over a great many boxes of all sizes are valid, and no deeper than their bound.
pub fn crowds(stress: &Stress) {
    let count = if stress.tier().is_thorough() { 1_000_000 } else { 20_000 };
    let geometry = geometry_of(&crowd(&mut stress.draw(1202), count));
    let all = structures(&geometry, &[([40, 30, 50], Fit::Exact), ([9, 8, 7], Fit::Bounds)]);
    stress.count(format!("p12 {count} boxes are built and valid"), || Ok((count * all.len()) as u64));
    let (grid, others) = all.split_first().expect("a grid");
    stress.run(format!("p12 {count} boxes"), 1203, Trials::new(5_000, 100_000), |draw| {
        let origin = (draw.cube() * 15.0).as_vec3();
        let ray = Ray::new(origin, (draw.cube() * 10.0).as_vec3() - origin);
        agree(&*grid.accel, others, &ray, Interval::ALL)
    });
}

/// What a structure answers, and how often it had to ask, by a build on some number of threads.
fn answers(geometry: &Geometry, threads: usize, rays: &[Ray]) -> Vec<String> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    let all = pool.install(|| structures(geometry, &[([17, 18, 19], Fit::Exact)]));
    let ask = |named: &Named| {
        let mut counters = Counters::default();
        for ray in rays {
            named.accel.nearest(ray, Interval::ALL, &mut counters);
        }
        format!("{}: {counters:?}", named.name)
    };
    all.iter().map(ask).collect()
}

/// Builds do not depend on the number of threads: the same work is done for each ray afterwards.
pub fn threads(stress: &Stress) {
    let mut draw = stress.draw(1204);
    let count = if stress.tier().is_thorough() { 200_000 } else { 20_000 };
    let geometry = geometry_of(&crowd(&mut draw, count));
    let ray = |draw: &mut Draw| Ray::new((draw.cube() * 15.0).as_vec3(), draw.direction().as_vec3());
    let rays: Vec<Ray> = (0..500).map(|_| ray(&mut draw)).collect();
    stress.count("p12 builds on 1, 2, 3, 7, 16 threads", || {
        let one = answers(&geometry, 1, &rays);
        for threads in [1, 2, 3, 7, 16] {
            let other = answers(&geometry, threads, &rays);
            if one != other {
                return Err(format!("{threads} threads: {other:?}, one: {one:?}"));
            }
        }
        Ok(5 * one.len() as u64)
    });
}
