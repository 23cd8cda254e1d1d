//! Streams: many rays asked at once, which go from node to node in lists, get the answers that each
//! gets alone.

mod world;

use a6_kdtree::bvh::Bvh;
use a6_kdtree::kdtree::{KdTree, Options, Rule};
use common::accel::Accel;
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::{Interval, Vec3};
use common::ray::Ray;
use rand_core::SeedableRng;
use rand_pcg::Pcg64Mcg;
use world::{bundles, geometry, lumpy_ball, ties, unit};

const INTERVALS: [Interval; 4] =
    [Interval::FORWARD, Interval::ALL, Interval { min: 0.0, max: 0.5 }, Interval { min: -0.3, max: 0.4 }];

/// Rays from one small place after another into all directions, as after a bounce; some run along an
/// axis, come from far away, have tiny or huge directions, or can hit nothing.
fn bounces(places: usize) -> Vec<Ray> {
    let mut random = Pcg64Mcg::seed_from_u64(17);
    let mut rays = Vec::new();
    for place in 0..places {
        let mut point =
            |reach: f32| Vec3::from_array(std::array::from_fn(|_| (unit(&mut random) - 0.5) * reach));
        let from = point(2.4);
        rays.extend((0..64).map(|_| Ray::new(from + point(0.02), point(2.0))));
        let axis = [Vec3::X, Vec3::NEG_Y, Vec3::Z][place % 3];
        let odd = [
            Ray::new(from, axis),
            Ray::new(from * 1e6, -from),
            Ray::new(from, point(1.0) * 1e-30),
            Ray::new(from, point(1.0) * 1e30),
            Ray::new(from, Vec3::ZERO),
            Ray::new(Vec3::splat(f32::NAN), axis),
            Ray::new(Vec3::splat(f32::INFINITY), from),
        ];
        let len = rays.len();
        rays[len - 60..len - 53].copy_from_slice(&odd);
    }
    rays
}

/// A hierarchy, and kd-trees by two rules.
fn trees(geometry: &Geometry) -> [Box<dyn Accel + '_>; 3] {
    let kdtree = |rule| Box::new(KdTree::new(geometry, Options { rule, ..Options::default() }));
    [Box::new(Bvh::new(geometry)), kdtree(Rule::Sah), kdtree(Rule::Median)]
}

/// Asks about all rays at once, and about each; returns how many hit, and what was looked at both ways.
fn agree(tree: &dyn Accel, rays: &[Ray], interval: Interval) -> (usize, [Counters; 2]) {
    let (mut together, mut alone) = (Counters::default(), Counters::default());
    let (mut hits, mut any) = (vec![None; rays.len()], vec![false; rays.len()]);
    tree.nearest_many(rays, interval, &mut hits, &mut together);
    for (ray, hit) in rays.iter().zip(&hits) {
        assert_eq!(*hit, tree.nearest(ray, interval, &mut alone), "{ray:?} {interval:?}");
    }
    tree.any_many(rays, interval, &mut any, &mut Counters::default());
    assert!(any.iter().zip(&hits).all(|(any, hit)| *any == hit.is_some()), "{interval:?}");
    (hits.iter().flatten().count(), [together, alone])
}

#[test]
fn a6t2_streams_of_rays_that_start_together_find_what_each_finds() {
    let rays = bounces(300);
    for (side, bodies) in
        [(5, ""), (40, ""), (40, "Sphere { center 0.2 0.1 0 radius 0.3 } Plane { normal 0 1 0 offset -1.2 }")]
    {
        let count = if bodies.is_empty() { 1 } else { 3 };
        let world = geometry(&format!("TriangleMesh {{ obj_file lumpy_{side} }} {bodies}"), count);
        for (number, tree) in trees(&world).iter().enumerate() {
            for interval in INTERVALS {
                let (hits, [together, alone]) = agree(&**tree, &rays, interval);
                assert!(hits > 2000, "{hits}");
                // In a stream a list's boxes are asked before any of their leaves: not the same nodes.
                // A kd-tree's are for triangles alone, and in a tiny one nothing is saved or lost.
                let shows = number == 0 || side > 5 && bodies.is_empty();
                assert!(together.cells != alone.cells || !shows, "no stream?");
                // Nor many more, though some rays in every packet are beyond what boxes are tested for.
                assert!(together.cells < alone.cells * 3 / 2, "{} {}", together.cells, alone.cells);
                assert!(together.intersections < alone.intersections * 3 / 2);
                // In another order some hits are found first that rule out others.
                let (exact, by_one) = (together.exact_tests, alone.exact_tests);
                assert!(exact.abs_diff(by_one) <= by_one / 10, "{exact} {by_one}");
            }
        }
    }
}

#[test]
fn a6t2_streams_of_rays_from_everywhere_find_what_each_finds() {
    let (squares, far) = ties();
    let ball = lumpy_ball(10);
    let mixed: Vec<Ray> = bundles(&ball, 17_000).into_iter().flatten().collect();
    assert!(mixed.len() > 1 << 18, "more than wait at a time: {}", mixed.len());
    for tree in &trees(&ball) {
        assert!(agree(&**tree, &mixed, Interval::FORWARD).0 > 1000);
        for interval in INTERVALS {
            assert!(agree(&**tree, &mixed[..1 << 15], interval).0 > 1000);
        }
    }
    for (tree, interval) in trees(&squares).iter().flat_map(|tree| INTERVALS.map(|i| (tree, i))) {
        agree(&**tree, &far, interval);
    }
}

#[test]
fn a6t2_streams_get_through_trees_without_order() {
    // Balls in one place cannot be told apart by any tree.
    let balls = "Sphere { center 0.1 0 0 radius 0.5 } ".repeat(3000);
    let world = geometry(&balls, 3000);
    let (hits, _) = agree(&Bvh::new(&world), &bounces(70), Interval::FORWARD);
    assert!(hits > 100, "{hits}");
}
