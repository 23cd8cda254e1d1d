//! Rays that run alongside each other, which go through the tree together: the same answers as the
//! list's, for fewer steps.

mod world;

use a6_kdtree::bvh::Bvh;
use common::accel::{Accel, List};
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::{Interval, Vec3};
use common::ray::Ray;
use rand_core::SeedableRng;
use rand_pcg::Pcg64Mcg;
use world::{geometry, lumpy_ball, scene, unit};

const INTERVALS: [Interval; 4] =
    [Interval::FORWARD, Interval::ALL, Interval { min: 0.0, max: 1.0 }, Interval { min: 0.2, max: 0.9 }];

/// Rows of rays side by side from near one place to near another inside or beside the box, which is where t = 1
/// is. On a raster, so that some of them meet edges and corners, which also lie on one.
fn sheaf(random: &mut Pcg64Mcg, geometry: &Geometry, count: usize, spread: f32) -> Vec<Ray> {
    let bounds = geometry.bounds().unwrap();
    let (center, size) = ((bounds.min + bounds.max) / 2.0, bounds.size().max_element());
    let mut point = || Vec3::from_array(std::array::from_fn(|_| unit(random) - 0.5)) * size;
    let raster = |p: Vec3| (p / size * 64.0).round() / 64.0 * size;
    let (from, to) = (raster(center + point() * 2.5), raster(center + point() * 0.8));
    let [right, up] = [point().normalize() * size * spread, point().normalize() * size * spread];
    let ray = |i: usize| {
        let (x, y) = ((i % 8) as f32 / 8.0, (i / 8) as f32 / 8.0);
        let origin = from + right * x * 0.1;
        Ray::new(origin, raster(to + right * x + up * y) - origin)
    };
    (0..count).map(ray).collect()
}

/// Every third ray leaves what it would hit, every fifth starts there.
fn leave(list: &List, rays: &mut [Ray]) {
    for (i, ray) in rays.iter_mut().enumerate() {
        if let Some(hit) = list.nearest(ray, Interval::FORWARD, &mut Counters::default()) {
            let start = ray.at(f64::from(hit.t)).as_vec3();
            let origin = if i % 5 == 0 { start } else { ray.origin };
            let home = if i % 3 == 0 { hit.primitive } else { Ray::ANYWHERE };
            *ray = Ray { origin, home, ..*ray };
        }
    }
}

/// Asks a tree about all rays at once and the list about each; returns how many hit, and how many nodes the
/// tree looked into for all together and for each alone.
fn agree(tree: &Bvh, list: &List, rays: &[Ray], interval: Interval) -> (usize, [u64; 2]) {
    let [mut c, mut alone, mut ignored] = [Counters::default(); 3];
    let (mut hits, mut any) = (vec![None; rays.len()], vec![false; rays.len()]);
    tree.nearest_many(rays, interval, &mut hits, &mut c);
    tree.any_many(rays, interval, &mut any, &mut c);
    for (i, ray) in rays.iter().enumerate() {
        let expected = list.nearest(ray, interval, &mut ignored);
        tree.nearest(ray, interval, &mut alone);
        tree.any(ray, interval, &mut alone);
        assert_eq!(
            (hits[i], any[i]),
            (expected, expected.is_some()),
            "{i} of {}: {ray:?} {interval:?}",
            rays.len()
        );
    }
    (hits.iter().flatten().count(), [c.cells, alone.cells])
}

/// Sheaves of all sizes at one scene; returns the share of rays that hit, and that of the nodes that each alone
/// would have looked into.
fn sheaves_agree(geometry: &Geometry, rounds: usize) -> (f64, f64) {
    let (tree, list, mut random) = (Bvh::new(geometry), List::new(geometry), Pcg64Mcg::seed_from_u64(8));
    let (mut met, mut asked, mut nodes) = (0, 0, [0, 0]);
    for (i, count) in [3, 4, 7, 8, 31, 32, 33, 40, 64, 96, 200].into_iter().cycle().take(rounds).enumerate() {
        let mut rays = sheaf(&mut random, geometry, count, [0.0, 0.01, 0.1, 0.5][i % 4]);
        if i % 3 == 2 {
            leave(&list, &mut rays);
        }
        if i % 10 == 9 {
            rays[count / 2].direction = [Vec3::ZERO, Vec3::NAN, Vec3::splat(f32::MAX)][i / 10 % 3];
        }
        for interval in INTERVALS {
            let (hits, looked) = agree(&tree, &list, &rays, interval);
            met += hits;
            asked += rays.len();
            nodes = [nodes[0] + looked[0], nodes[1] + looked[1]];
        }
    }
    (met as f64 / asked as f64, nodes[0] as f64 / nodes[1] as f64)
}

#[test]
fn a6t2_sheaves_of_rays_agree_with_the_list() {
    let (hits, steps) = sheaves_agree(&lumpy_ball(12), 1100);
    assert!(hits > 0.3 && steps < 0.7, "{hits} of them hit, {steps} of the steps");
}

#[test]
fn a6t2_sheaves_agree_where_triangles_lie_upon_each_other_and_beside_other_things() {
    let (doubled, _) = sheaves_agree(
        &geometry("TriangleMesh { obj_file lumpy_6 } TriangleMesh { obj_file lumpy_6 }", 2),
        330,
    );
    let many = "Sphere { center 0 0 0 radius 1.04 } TriangleMesh { obj_file lumpy_8 } \
                Plane { normal 0 1 0 offset -0.5 } Transform { Scale 1 0.5 1 Sphere { center 0 0 0 radius 1.3 } }";
    let (mixed, _) = sheaves_agree(&geometry(many, 4), 330);
    let (cube, _) = sheaves_agree(&scene("scene2_08_cube.txt"), 330);
    assert!(doubled > 0.3 && mixed > 0.5 && cube > 0.1, "{doubled} {mixed} {cube} of them hit");
}
