//! Trees shared by copies of a mesh against the list: same primitive, same bits of t, u and v,
//! however the copies are placed; and what is built when.

mod world;

use a6_kdtree::instances::{Instances, Options};
use common::accel::{Accel, List};
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::{Interval, Vec3};
use common::ray::Ray;
use rand_core::SeedableRng;
use rand_pcg::Pcg64Mcg;
use world::{agree_on, geometry, rays, scenes, unit};

/// Every mesh has a tree, which its copies share however coarse they are.
const ALL: Options = Options { least: 1, coarsest: f64::INFINITY };

/// A use of the ball of 12 `n`² triangles under some transforms.
fn ball(n: u32, transforms: &str) -> String {
    format!("Transform {{ {transforms} TriangleMesh {{ obj_file lumpy_{n} }} }} ")
}

/// Transforms of all kinds, from a number: turned, mirrored, sheared, flattened, large and small.
fn placed(random: &mut Pcg64Mcg, i: usize) -> String {
    let mut r = |reach: f32| (unit(random) - 0.5) * 2.0 * reach;
    let far = if i % 9 == 8 { 1e4 } else { 5.0 };
    let at = format!("Translate {} {} {}", r(far), r(far), r(far));
    let turn = format!("XRotate {} YRotate {} ZRotate {}", r(180.0), r(180.0), r(180.0));
    let kind = match i % 6 {
        0 => format!("UniformScale {}", 0.5 + r(0.4)),
        1 => format!("Scale -1 {} 1", 1.5 + r(1.0)),
        2 => format!("Matrix {{ 1 {} {} 0  0 1 {} 0  0 0 1 0  0 0 0 1 }}", r(2.0), r(2.0), r(2.0)),
        3 => "Scale 1 0.001 1".to_owned(),
        4 => format!("Scale {} {} {}", r(1.0), 1.0 + r(0.5), -2.0),
        _ => String::new(),
    };
    format!("{at} {turn} {kind}")
}

/// Copies of three balls under random transforms, with loose things between them.
fn crowd(seed: u64, count: usize) -> Geometry {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut objects = String::from(
        "Plane { normal 0 1 0 offset -4 } Sphere { center 1 0 0 radius 1 } \
         Triangle { vertex0 -9 0 0 vertex1 9 0 1 vertex2 0 9 0 } ",
    );
    for i in 0..count {
        objects += &ball([3, 5, 8][i % 3], &placed(&mut random, i));
    }
    geometry(&objects, count + 3)
}

/// Rays towards corners, edges and middles of triangles, and from inside copies.
fn aimed(geometry: &Geometry, n: usize) -> Vec<Ray> {
    let mut random = Pcg64Mcg::seed_from_u64(11);
    let starts = rays(geometry, n);
    let triangles = geometry.triangles();
    if triangles.is_empty() {
        return starts;
    }
    let aim = |(i, ray): (usize, Ray)| {
        let [a, b, c] = triangles[(unit(&mut random) * triangles.len() as f32) as usize % triangles.len()];
        let target = [a, (a + b) / 2.0, (a + b + c) / 3.0, a + (b - a) * unit(&mut random)][i % 4];
        let origin = if i % 3 == 0 { (a + b) / 2.0 + (c - a) * unit(&mut random) } else { ray.origin };
        let mut direction = target - origin;
        if i % 5 == 0 {
            direction = [Vec3::X, Vec3::NEG_Y, Vec3::Z][i % 3];
            return Ray::new(target - direction * unit(&mut random), direction);
        }
        if i % 11 == 0 {
            direction *= 1e-6;
        }
        Ray::new(origin, direction)
    };
    starts.into_iter().enumerate().map(aim).collect()
}

/// Valid, and equal to the list on `n` rays of each kind; returns the number of hits.
fn agree(geometry: &Geometry, options: Options, n: usize) -> usize {
    let (instances, list) = (Instances::with(geometry, 1, options), List::new(geometry));
    instances.validate().unwrap();
    let all = rays(geometry, n).into_iter().chain(aimed(geometry, n));
    all.map(|ray| agree_on(&instances, &list, &ray)).sum()
}

#[test]
fn a6t2_crowds_of_copies_equal_the_list() {
    for seed in 0..3 {
        let geometry = crowd(seed, 20 + 6 * seed as usize);
        let hits = agree(&geometry, ALL, 1500) + agree(&geometry, Options::default(), 500);
        assert!(hits > 4000, "{hits}");
    }
}

#[test]
fn a6t2_scales_from_a_millionth_to_a_million_and_places_far_away() {
    let kinds = [
        "UniformScale 1e-6",
        "UniformScale 1e6",
        "Scale 1e6 1 1e-6",
        "Translate 1e6 0 0",
        "Translate 1e6 -1e6 1e6 UniformScale 1e6",
        "Translate 1e6 0 0 UniformScale 100",
        "UniformScale 1e-6 Translate 1e6 0 0 ZRotate 30",
        "XRotate 45 Scale 1e-3 1e3 1 YRotate 45",
        "Scale -1e-6 1e-6 1e-6",
        "Matrix { 1 1e6 0 0  0 1 0 0  0 0 1 0  0 0 0 1 }",
        "Matrix { 1 1 1 0  1 1.000001 1 0  1 1 1.000002 0  0 0 0 1 }",
        "UniformScale 1e-30",
        "UniformScale 1e30",
    ];
    for kind in kinds {
        let two = ball(6, kind) + &ball(6, &format!("{kind} Translate 1.5 0.1 0"));
        let hits = agree(&geometry(&two, 2), ALL, 500);
        assert!(hits > 600, "{kind}: {hits}");
        let beside = geometry(&(two + &ball(6, "")), 3);
        assert!(agree(&beside, ALL, 200) > 150, "{kind}");
    }
}

#[test]
fn a6t2_copies_upon_each_other_tie_to_the_first() {
    let turned = "YRotate 33 Scale 1 2 -1";
    let copies = ball(5, turned) + &ball(5, turned) + &ball(8, "") + &ball(8, "") + &ball(5, turned);
    assert!(agree(&geometry(&copies, 5), ALL, 3000) > 8000);
}

#[test]
fn a6t2_every_scene_through_two_levels() {
    let hits: usize = scenes().map(|g| agree(&g, ALL, if g.len() > 10_000 { 40 } else { 200 })).sum();
    assert!(hits > 10_000, "{hits}");
}

#[test]
fn a6t2_many_copies_one_build() {
    let copies: String =
        (0..30).map(|i| ball(12, &format!("Translate {} 0 {} YRotate {i}", 3 * i, i))).collect();
    let geometry = geometry(&copies, 30);
    let instances = Instances::new(&geometry, 2);
    let before = instances.summary();
    assert_eq!((before.uses, before.trees, before.built, before.unreached), (30, 1, 0, 30));
    instances.validate().unwrap();
    let s = instances.summary();
    assert_eq!((s.trees, s.built, s.shared, s.sharing, s.unreached), (1, 1, 1, 30, 0));
    let flat = a6_kdtree::bvh::Bvh::new(&geometry);
    assert!(s.bytes * 20 < flat.bytes(), "{} bytes, flat {}", s.bytes, flat.bytes());
}

#[test]
fn a6t2_what_no_ray_meets_is_not_built() {
    let wall = "Triangle { vertex0 -99 -99 0 vertex1 99 -99 0 vertex2 0 99 0 } ";
    let objects = format!(
        "{wall} {} {} {}",
        ball(8, "Translate 0 0 -5"),
        ball(9, "Translate 0 0 -9"),
        ball(10, "Translate 3 0 3")
    );
    let geometry = geometry(&objects, 4);
    let instances = Instances::new(&geometry, 1);
    let mut c = Counters::default();
    let at = |x: f32| Ray::new(Vec3::new(x, 0.0, 9.0), Vec3::NEG_Z);
    let wall = instances.nearest(&at(0.1), Interval::FORWARD, &mut c);
    assert_eq!(wall.map(|h| h.primitive), Some(0));
    let s = instances.summary();
    assert_eq!((s.trees, s.built, s.unreached), (4, 1, 3), "behind the wall, and beside the ray");
    assert!(instances.nearest(&at(3.1), Interval::FORWARD, &mut c).is_some_and(|h| h.t < 8.0));
    assert_eq!((instances.summary().built, instances.summary().unreached), (2, 2));
    let through = Ray::new(Vec3::new(0.1, 0.0, -1.0), Vec3::NEG_Z);
    assert!(instances.any(&through, Interval::FORWARD, &mut c));
    assert_eq!((instances.summary().built, instances.summary().unreached), (3, 1));
}

#[test]
fn a6t2_built_once_though_all_threads_of_the_pool_ask() {
    let copies: String = (0..8).map(|i| ball(40, &format!("Translate {} 0 0", 3 * i))).collect();
    let geometry = geometry(&copies, 8);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(4).build().unwrap();
    let instances = Instances::new(&geometry, 2);
    let rays = rays(&geometry, 400);
    let hits = pool.install(|| {
        use rayon::prelude::*;
        let ask = |ray| u32::from(instances.any(ray, Interval::ALL, &mut Counters::default()));
        rays.par_iter().map(ask).sum::<u32>()
    });
    let list = List::new(&geometry);
    let mut c = Counters::default();
    let expected: u32 = rays.iter().map(|ray| u32::from(list.any(ray, Interval::ALL, &mut c))).sum();
    assert_eq!((hits, instances.summary().built), (expected, 1));
}

#[test]
fn a6t2_rays_that_hit_nothing_and_scenes_of_nothing() {
    let planes = geometry("Plane { normal 0 1 0 offset -1 }", 1);
    let (instances, mut c) = (Instances::new(&planes, 1), Counters::default());
    instances.validate().unwrap();
    let down = Ray::new(Vec3::ZERO, Vec3::NEG_Y);
    assert_eq!(instances.nearest(&down, Interval::FORWARD, &mut c).map(|h| h.t), Some(1.0));
    let copies = geometry(&(ball(4, "") + &ball(4, "Translate 1 0 0")), 2);
    let instances = Instances::with(&copies, 1, ALL);
    for ray in
        [Ray::new(Vec3::NAN, Vec3::X), Ray::new(Vec3::ZERO, Vec3::ZERO), Ray::new(Vec3::ZERO, Vec3::INFINITY)]
    {
        assert!(instances.nearest(&ray, Interval::ALL, &mut c).is_none());
        assert!(!instances.any(&ray, Interval::ALL, &mut c));
    }
    let list = List::new(&copies);
    for size in [1e-40, 1e-30, 1e-10, 1e10, 1e30] {
        for origin in [Vec3::new(0.3, 0.2, 0.1), Vec3::splat(1e30), Vec3::new(0.3, 3.0, 0.0)] {
            agree_on(&instances, &list, &Ray::new(origin, Vec3::new(0.1, -1.0, 0.2) * size));
        }
    }
}
