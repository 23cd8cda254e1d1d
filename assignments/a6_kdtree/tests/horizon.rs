//! Rays that leave a triangle of a small mesh: what the tree is not asked about gets the same answer.

mod world;

use a6_kdtree::bvh::Bvh;
use common::accel::{Accel, List};
use common::counters::Counters;
use common::geometry::{Geometry, Hit};
use common::math::{Interval, Vec3};
use common::ray::Ray;
use rand_core::SeedableRng;
use rand_pcg::Pcg64Mcg;
use world::{geometry, lumpy_ball, rays, scene, unit};

/// Rays that leave triangles that other rays hit: on the same side, on the other side, and some of them
/// almost along the surface.
fn leaving(geometry: &Geometry, list: &List, n: usize) -> Vec<Ray> {
    let (mut random, mut c) = (Pcg64Mcg::seed_from_u64(9), Counters::default());
    let mut leaving = Vec::new();
    for (i, ray) in rays(geometry, n).iter().enumerate() {
        let hit = list.nearest(ray, Interval::FORWARD, &mut c);
        let is_triangle = |hit: &Hit| geometry.triangle_numbers().binary_search(&hit.primitive).is_ok();
        let Some(hit) = hit.filter(is_triangle) else { continue };
        let surface = geometry.surface(ray, &hit);
        let normal = surface.geometric_normal.as_vec3();
        let mut direction = Vec3::from_array(std::array::from_fn(|_| unit(&mut random) * 2.0 - 1.0));
        if i % 3 == 0 {
            direction -= normal * normal.dot(direction) * (1.0 - 10f32.powi(-(i as i32 % 8)));
        }
        let start = surface.leave(direction.as_dvec3());
        leaving.push(Ray::leaving(hit.primitive, start, direction));
    }
    leaving
}

/// Asks about many rays at once and about each; returns how many hit, of how many, and how many of
/// them the tree settled without a node, by itself.
fn agree(geometry: &Geometry, n: usize) -> [usize; 3] {
    let (tree, list) = (Bvh::new(geometry), List::new(geometry));
    let rays = leaving(geometry, &list, n);
    let (mut hits, mut settled) = (0, 0);
    for interval in [Interval::FORWARD, Interval::up_to(1.0), Interval::ALL] {
        let mut c = Counters::default();
        let (mut together, mut any) = (vec![None; rays.len()], vec![false; rays.len()]);
        tree.nearest_many(&rays, interval, &mut together, &mut c);
        tree.any_many(&rays, interval, &mut any, &mut c);
        for (i, ray) in rays.iter().enumerate() {
            let expected = list.nearest(ray, interval, &mut c);
            assert_eq!((together[i], any[i]), (expected, expected.is_some()), "{ray:?} {interval:?}");
            hits += usize::from(expected.is_some());
            let mut c = Counters::default();
            tree.nearest_many(&rays[i..=i], interval, &mut [None], &mut c);
            settled += usize::from(interval == Interval::FORWARD && c.cells == 0);
        }
    }
    [hits, 3 * rays.len(), settled]
}

#[test]
fn a6t2_what_leaves_a_convex_body_is_settled_without_the_tree() {
    for name in ["scene7_06_faceted_gem.txt", "scene3_02_cube_perspective.txt"] {
        let body = scene(name);
        let triangles = body.triangles().len();
        let [hits, all, settled] = agree(&body, 4000);
        assert!(hits > all / 8, "{name}: {hits} of {all} hit");
        assert!(triangles > 0 && 3 * settled > all / 4, "{name}: {settled} of {all} / 3 settled");
    }
}

#[test]
fn a6t2_what_leaves_a_dent_is_asked_about() {
    let [hits, all, settled] = agree(&lumpy_ball(4), 4000);
    assert!(hits > all / 2, "{hits} of {all} hit");
    assert!(3 * settled < all, "{settled} of {all} / 3 settled");
}

/// Two bodies, of which each stands in the other's sky; and one beside a ball.
#[test]
fn a6t2_what_stands_above_is_asked_about() {
    let tetrahedron = |x: f32| {
        let corner = |[a, b, c]: [f32; 3]| format!("{} {b} {c}", a + x);
        let at = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]].map(corner);
        let faces = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
        let face = |[a, b, c]: [usize; 3]| {
            format!("Triangle {{ vertex0 {} vertex1 {} vertex2 {} }}", at[a], at[b], at[c])
        };
        faces.map(face).join(" ")
    };
    let two = geometry(&format!("{} {}", tetrahedron(0.0), tetrahedron(2.5)), 8);
    let ball = "Sphere { center 0 3 0 radius 1 }";
    let beside = geometry(&format!("{} {ball}", tetrahedron(0.0)), 5);
    for (geometry, least) in [(two, 30), (beside, 30)] {
        let [hits, all, _] = agree(&geometry, 4000);
        assert!(hits > all / least, "{hits} of {all} hit");
    }
}
