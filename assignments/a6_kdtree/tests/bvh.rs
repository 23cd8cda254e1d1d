//! The hierarchy against the list: same primitive, same bits of t, on every scene and on
//! inputs made to break it.

mod world;

use a6_kdtree::bvh::Bvh;
use common::accel::{Accel, List};
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::{Interval, Vec3};
use common::ray::Ray;
use world::{geometry, scene, scenes};

fn agree(geometry: &Geometry, n: usize) -> usize {
    world::agree(&Bvh::new(geometry), n)
}

#[test]
fn a6t2_equals_the_list_on_every_scene() {
    let hits: usize = scenes().map(|g| agree(&g, if g.len() > 10_000 { 60 } else { 500 })).sum();
    assert!(hits > 10_000, "the rays should meet something: {hits}");
}

#[test]
fn a6t2_coincident_concentric_flat_and_single() {
    let equal = "Sphere { center 1 2 3 radius 0.5 } ".repeat(20_000);
    assert!(agree(&geometry(&equal, 20_000), 20) > 0);
    let concentric: String = (1..=20).map(|i| format!("Sphere {{ center 0 0 0 radius {i} }} ")).collect();
    assert!(agree(&geometry(&concentric, 20), 2000) > 0);
    let flat: String = (0..100)
        .map(|i| format!("Triangle {{ vertex0 {i} 0 0 vertex1 {i} 1 0 vertex2 {}.5 0 0 }} ", i))
        .collect();
    assert!(agree(&geometry(&flat, 100), 3000) > 0);
    assert!(agree(&geometry("Sphere { center 0 0 0 radius 1 }", 1), 500) > 0);
    let mixed = "Plane { normal 0 1 0 offset -1 } Sphere { center 0 0 0 radius 1 } \
                 Triangle { vertex0 -2 0 0 vertex1 2 0 0 vertex2 0 2 0 }";
    assert!(agree(&geometry(mixed, 3), 3000) > 0);
}

/// Rays so slow that they need t = 2⁹⁹, along the sides of boxes as small as they are: the inverse
/// of a zero is not enough there.
#[test]
fn a6t2_long_ways_along_the_sides_of_boxes() {
    let mut hits = 0;
    for (tip, zero) in [-0.01, 0.01].into_iter().flat_map(|tip| [(tip, 0.0), (tip, -0.0)]) {
        let strip: String = (0..64)
            .map(|i| [i, i + 1, i].map(|k| f64::from(k) / 64.0))
            .map(|[a, b, c]| format!("Triangle {{ vertex0 1 0 {a} vertex1 1 0 {b} vertex2 1 {tip} {c} }} "))
            .collect();
        let geometry = geometry(&strip, 64);
        let (bvh, list) = (Bvh::new(&geometry), List::new(&geometry));
        for i in 0..64 {
            let origin = Vec3::new(0.0, 0.0, (i as f32 + 0.3) / 64.0);
            let ray = Ray::new(origin, Vec3::new(2f32.powi(-99), zero, zero));
            hits += world::agree_on(&bvh, &list, &ray);
        }
    }
    assert!(hits >= 4 * 64, "an edge belongs to one side of it: {hits}");
}

/// Sizes that halve for ever make the deepest trees.
#[test]
fn a6t2_geometric_series_stays_shallow_enough() {
    let series: String = (0..120)
        .map(|i| format!("Sphere {{ center {:e} 0 0 radius {:e} }} ", 2f64.powi(60 - i), 2f64.powi(58 - i)))
        .collect();
    let geometry = geometry(&series, 120);
    let bvh = Bvh::new(&geometry);
    assert!(bvh.counts().2 <= 92, "depth {}", bvh.counts().2);
    world::agree(&bvh, 2000);
}

#[test]
fn a6t2_nothing_and_planes_only() {
    let planes = geometry("Plane { normal 0 1 0 offset -1 }", 1);
    let (bvh, mut c) = (Bvh::new(&planes), Counters::default());
    bvh.validate().unwrap();
    let down = Ray::new(Vec3::ZERO, Vec3::NEG_Y);
    assert_eq!(bvh.nearest(&down, Interval::FORWARD, &mut c).map(|h| h.t), Some(1.0));
    let nan = Ray::new(Vec3::NAN, Vec3::NEG_Y);
    assert!(bvh.nearest(&nan, Interval::FORWARD, &mut c).is_none() && !bvh.any(&nan, Interval::ALL, &mut c));
}

#[test]
fn a6t2_the_tree_does_not_depend_on_threads() {
    let geometry = scene("scene5_09_bunny_mesh_40k.txt");
    let build = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| Bvh::new(&geometry).fingerprint())
    };
    let one = build(1);
    assert!([2, 3, 7].into_iter().all(|n| build(n) == one));
}

#[test]
fn a6t2_ties_and_neighbours_in_different_leaves() {
    let (geometry, rays) = world::ties();
    let (bvh, list) = (Bvh::new(&geometry), List::new(&geometry));
    let hits: usize = rays.iter().map(|ray| world::agree_on(&bvh, &list, ray)).sum();
    assert!(hits > 10_000, "{hits}");
}

#[test]
fn a6t2_many_rays_get_the_answers_of_each() {
    let together =
        |g: Geometry| world::agree_together(&Bvh::new(&g), if g.len() > 10_000 { 50 } else { 200 });
    let hits: usize = scenes().map(together).sum();
    assert!(hits > 20_000, "{hits}");
    let mixed = "Plane { normal 0 1 0 offset -1 } Sphere { center 0 0 0 radius 1 } \
                 Triangle { vertex0 -2 0 0 vertex1 2 0 0 vertex2 0 2 0 }";
    assert!(together(geometry(mixed, 3)) > 1000);
}
