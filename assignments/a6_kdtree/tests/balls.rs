//! A few balls beside the tree: the same answers as the list's, for one ray and for many.

mod world;

use a6_kdtree::bvh::Bvh;
use common::accel::{Accel, List};
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::{Interval, Vec3};
use common::ray::Ray;
use rand_core::SeedableRng;
use rand_pcg::Pcg64Mcg;
use world::{agree, agree_on, agree_together, geometry, unit};

/// Balls of all sizes, inside of each other and apart, two triangles and a plane, all moved and scaled.
fn balls(count: usize, far: f64, scale: f64) -> Geometry {
    let mut random = Pcg64Mcg::seed_from_u64(count as u64);
    let mut x = || f64::from(unit(&mut random)) * 2.0 - 1.0;
    let mut objects = String::new();
    for i in 0..count {
        let radius = 2f64.powi(-(i as i32 % 6)) * scale;
        let [a, b, c] = [x(), x(), x()].map(|x| x * 2.0 * scale + far);
        objects += &format!("Sphere {{ center {a:e} {b:e} {c:e} radius {radius:e} }} ");
    }
    let at = |x: f64| x * scale + far;
    for z in [-1.5, 0.5] {
        let [low, high, z] = [at(-2.0), at(2.0), at(z)];
        objects += &format!(
            "Triangle {{ vertex0 {low:e} {low:e} {z:e} vertex1 {high:e} {low:e} {z:e} vertex2 {low:e} {high:e} {z:e} }} "
        );
    }
    objects += &format!("Plane {{ normal 0 1 0 offset {:e} }}", at(-1.0));
    geometry(&objects, count + 3)
}

#[test]
fn a6t2_balls_beside_the_tree_are_found_as_by_the_list() {
    let mut hits = 0;
    for count in [1, 7, 8, 9, 16, 17] {
        for (far, scale) in [
            (0.0, 1.0),
            (1e4, 1.0),
            (-3e6, 10.0),
            (0.0, 2f64.powi(-60)),
            (0.0, 2f64.powi(60)),
            (0.0, 2f64.powi(63)),
        ] {
            let scene = balls(count, far, scale);
            let tree = Bvh::new(&scene);
            hits += agree(&tree, 500) + agree_together(&tree, 100);
        }
    }
    assert!(hits > 50_000, "{hits}");
}

/// Rays that touch a ball, to the rounding of single precision, and rays that end at its surface.
#[test]
fn a6t2_rays_that_graze_balls_and_rays_that_end_at_them() {
    let scene = balls(11, 100.0, 1.0);
    let (tree, list, mut random) = (Bvh::new(&scene), List::new(&scene), Pcg64Mcg::seed_from_u64(1));
    let mut vector = || Vec3::from_array(std::array::from_fn(|_| unit(&mut random) - 0.5));
    let (mut hits, mut many) = (0, Vec::new());
    for i in 0..4000 {
        let bounds = scene.solids()[i % 11].bounds;
        let (center, radius) = ((bounds.min + bounds.max) / 2.0, bounds.size().x / 2.0);
        let outward = vector().normalize();
        let along = outward.cross(vector()).normalize();
        let touched = center + outward * radius;
        let from = touched - along * 3.0;
        let grazing = Ray::new(from, along);
        let ending = Ray::new(from, touched - from);
        hits += agree_on(&tree, &list, &grazing) + agree_on(&tree, &list, &ending);
        many.extend([grazing, ending]);
    }
    let mut c = Counters::default();
    for interval in [Interval::FORWARD, Interval::ALL, Interval::up_to(1.0)] {
        let (mut nearest, mut any) = (vec![None; many.len()], vec![false; many.len()]);
        tree.nearest_many(&many, interval, &mut nearest, &mut c);
        tree.any_many(&many, interval, &mut any, &mut c);
        for (ray, (nearest, any)) in many.iter().zip(nearest.into_iter().zip(any)) {
            let expected = list.nearest(ray, interval, &mut c);
            assert_eq!((nearest, any), (expected, expected.is_some()), "{ray:?} {interval:?}");
        }
    }
    assert!(hits > 10_000, "{hits}");
}

/// Not a number, endless, or without a direction: such rays hit nothing, alone or among others.
#[test]
fn a6t2_balls_are_not_hit_by_what_is_no_ray() {
    let scene = balls(11, 0.0, 1.0);
    let (tree, mut c) = (Bvh::new(&scene), Counters::default());
    let odd = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY]
        .into_iter()
        .flat_map(|x| [Ray::new(Vec3::splat(x), Vec3::X), Ray::new(Vec3::ZERO, Vec3::new(1.0, x, 0.0))]);
    let rays: Vec<Ray> = odd.chain([Ray::new(Vec3::ZERO, Vec3::ZERO)]).collect();
    let (mut hits, mut any) = (vec![None; rays.len()], vec![false; rays.len()]);
    tree.nearest_many(&rays, Interval::ALL, &mut hits, &mut c);
    tree.any_many(&rays, Interval::ALL, &mut any, &mut c);
    assert!(hits.iter().all(Option::is_none) && !any.contains(&true));
    assert!(rays.iter().all(|ray| tree.nearest(ray, Interval::ALL, &mut c).is_none()));
}
