//! Crowds of rays that pass close by a tree, and planes and discs asked about many rays at once:
//! the same answers as the list's, and the same counts.

mod world;

use a6_kdtree::bvh::Bvh;
use common::accel::{Accel, List};
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::{Interval, Vec3};
use common::ray::Ray;
use rand_core::SeedableRng;
use rand_pcg::Pcg64Mcg;
use world::{geometry, lumpy_ball, unit};

const INTERVALS: [Interval; 4] =
    [Interval::FORWARD, Interval::ALL, Interval { min: 0.0, max: 1.0 }, Interval { min: 0.0, max: 0.999 }];

/// So many rays within `spread` of each other, past the side of the unit ball at a distance that
/// may be less than its radius; those that miss it end beside it at t = 1.
fn crowd(random: &mut Pcg64Mcg, count: usize, spread: f32) -> Vec<Ray> {
    let mut point = |reach: f32| Vec3::from_array(std::array::from_fn(|_| (unit(random) - 0.5) * reach));
    let from = point(2.0).normalize() * 4.0;
    let side = from.cross(point(2.0)).normalize();
    let target = side * (1.3 + point(1.2).x) + from * point(0.5).x;
    let ray = |_| {
        let origin = from + point(spread);
        Ray::new(origin, target + point(spread) - origin)
    };
    (0..count).map(ray).collect()
}

/// Asks a tree about all rays at once and the list about each; returns how many hit and what the
/// tree looked at.
fn agree(tree: &Bvh, list: &List, rays: &[Ray], interval: Interval) -> (usize, Counters) {
    let (mut c, mut ignored) = (Counters::default(), Counters::default());
    let (mut hits, mut any) = (vec![None; rays.len()], vec![false; rays.len()]);
    tree.nearest_many(rays, interval, &mut hits, &mut c);
    let looked = c;
    tree.any_many(rays, interval, &mut any, &mut c);
    for (i, ray) in rays.iter().enumerate() {
        let expected = list.nearest(ray, interval, &mut ignored);
        assert_eq!((hits[i], any[i]), (expected, expected.is_some()), "{ray:?} {interval:?}");
    }
    (hits.iter().flatten().count(), looked)
}

#[test]
fn a6t2_crowds_that_pass_the_tree_by_are_told_from_those_that_touch_it() {
    let ball = lumpy_ball(6);
    let (tree, list, mut random) = (Bvh::new(&ball), List::new(&ball), Pcg64Mcg::seed_from_u64(5));
    let (mut hits, mut passed, mut asked) = (0, 0, 0);
    for (i, count) in [1, 15, 16, 64, 65, 200].into_iter().cycle().take(600).enumerate() {
        let rays = crowd(&mut random, count, [0.0, 0.01, 0.2, 3.0][i % 4]);
        for interval in INTERVALS {
            let (met, looked) = agree(&tree, &list, &rays, interval);
            hits += met;
            asked += usize::from(count >= 16);
            passed += usize::from(count >= 16 && looked.cells == 0);
        }
    }
    assert!(hits > 10_000 && passed > asked / 20, "{hits} hits; {passed} of {asked} passed by");
}

/// What many rays find among planes and discs, beside what each finds alone, counts included.
fn sheets_agree(geometry: &Geometry, rays: &[Ray]) -> usize {
    let tree = Bvh::new(geometry);
    let mut found = 0;
    for interval in INTERVALS {
        let (mut together, mut alone) = (Counters::default(), Counters::default());
        let (mut hits, mut any) = (vec![None; rays.len()], vec![false; rays.len()]);
        tree.nearest_many(rays, interval, &mut hits, &mut together);
        tree.any_many(rays, interval, &mut any, &mut together);
        for (i, ray) in rays.iter().enumerate() {
            let expected = tree.nearest(ray, interval, &mut alone);
            assert_eq!((hits[i], any[i]), (expected, tree.any(ray, interval, &mut alone)), "{ray:?}");
            found += usize::from(any[i]);
        }
        assert_eq!(together, alone);
    }
    found
}

#[test]
fn a6t2_planes_and_discs_answer_many_rays_as_they_answer_one() {
    let sheets = "Plane { normal 0 1 0 offset -1 } Plane { normal 0 1 0 offset -1 } \
                  Plane { normal 0.3 1 -0.2 offset 0.5 } Plane { normal 0 0 1 offset -2 center 0 0 -2 radius 3 }";
    let mut random = Pcg64Mcg::seed_from_u64(9);
    let mut rays: Vec<Ray> = (0..500).flat_map(|i| crowd(&mut random, 1 + i % 13, 2.0)).collect();
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 0.0, f32::MAX, 1e-45] {
        for axis in 0..3 {
            let mut v = Vec3::ZERO;
            v[axis] = bad;
            rays.extend([
                Ray::new(v, Vec3::NEG_Y),
                Ray::new(Vec3::ONE, v),
                Ray::new(Vec3::ONE, v + Vec3::NEG_Y),
            ]);
        }
    }
    assert!(sheets_agree(&geometry(sheets, 4), &rays) > 2000);
    assert_eq!(sheets_agree(&geometry("", 0), &rays), 0);
}
