//! accuracy.md, properties 9 and 10: grids and trees answer what the list answers, bit for bit,
//! for every ray there is.

use a5_grid::Fit;
use common::accel::{Accel, List};
use common::camera::Camera;
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::{Bounds, Interval, Vec3};
use common::mesh::Mesh;
use common::ray::Ray;
use common::scene::Scene;
use tests::property::{
    Draw, agree, aim, build, committed_scenes, geometry_of, grid_of, lattice_sphere, lumpy_sphere, ray_bits,
    run, structures,
};

/// A camera ray, a ray through the box, or one aimed at an edge or a corner.
fn scene_ray(draw: &mut Draw, camera: &Camera, geometry: &Geometry, around: &Bounds) -> Ray {
    let (min, max) = (around.min, around.max);
    match draw.below(4) {
        0 => camera.ray((draw.unit(), draw.unit())),
        1 if !geometry.triangles().is_empty() => {
            let origin = draw.point(min - (max - min), max + (max - min));
            aim(draw, geometry.triangles(), origin)
        }
        2 => Ray::new(draw.point(min, max), draw.direction().as_vec3()),
        _ => {
            let origin = draw.point(min - (max - min), max + (max - min));
            Ray::new(origin, draw.point(min, max) - origin)
        }
    }
}

fn any_interval(draw: &mut Draw, reach: f32) -> Interval {
    match draw.below(4) {
        0 => Interval::ALL,
        1 => Interval::up_to(reach * draw.unit() as f32),
        2 => Interval { min: reach * draw.unit() as f32, max: f32::INFINITY },
        _ => Interval::FORWARD,
    }
}

fn scene_agrees(name: &str, scene: &Scene, trials: u64) {
    let geometry = Geometry::build(scene).unwrap_or_else(|e| panic!("{name}: {e}"));
    let around = geometry.bounds().unwrap_or(Bounds { min: -Vec3::ONE, max: Vec3::ONE });
    let reach = around.size().max_element().max(1.0);
    let list = List::new(&geometry);
    let large = geometry.len() > 2000;
    let counts: &[[u32; 3]] = if large { &[[40, 40, 33]] } else { &[[1, 1, 1], [7, 10, 3], [24, 1, 17]] };
    let mut grids: Vec<_> = counts.iter().map(|&n| (n, Fit::Exact)).collect();
    grids.push(([9, 8, 7], Fit::Bounds));
    list.validate().unwrap_or_else(|e| panic!("{name}: {e}"));
    let others = structures(&geometry, &grids);
    let camera = Camera::new(&scene.camera);
    run(&format!("p10 {name}"), 1001, trials, |draw| {
        let ray = scene_ray(draw, &camera, &geometry, &around);
        agree(&list, &others, &ray, any_interval(draw, reach))
    });
}

#[test]
fn p10_all_structures_agree_on_every_scene() {
    for (name, scene) in committed_scenes() {
        let size = Geometry::build(&scene).unwrap_or_else(|e| panic!("{name}: {e}")).len() as u64;
        scene_agrees(&name, &scene, (25_000_000 / size.max(1)).clamp(1_000, 24_000));
    }
}

/// Meshes far away and of any size, where the grid's planes and the triangles' corners are both
/// coarse.
#[test]
fn p10_all_structures_agree_far_away() {
    let far = Vec3::new(148_376.0, 1234.0, -223_423.0);
    let mut places = [1e-6f32, 1.0, 1e6, 2f32.powi(60), 2f32.powi(-60)].map(|s| (s, Vec3::ZERO)).to_vec();
    places.extend([(16.0, far), (1000.0, far), (1000.0, Vec3::splat(1e7)), (1e6, far * 10.0)]);
    for (scale, offset) in places {
        let mesh = lumpy_sphere(2, 21);
        let place = |i: &u32| mesh.positions[*i as usize] * scale + offset;
        let triangles: Vec<_> =
            mesh.triangles.iter().map(|t| [place(&t[0]), place(&t[1]), place(&t[2])]).collect();
        let geometry = geometry_of(&triangles);
        let around = geometry.bounds().expect("finite");
        let list = List::new(&geometry);
        let others = structures(&geometry, &[[1, 1, 1], [10, 7, 3], [33, 32, 31]].map(|n| (n, Fit::Exact)));
        let margin = (around.size() * 2.0).max(around.max.abs() * 1e-6);
        run(&format!("p10 × {scale:e} + {offset}"), 1002, 10_000, |draw| {
            let origin = draw.point(around.min - margin, around.max + margin);
            let ray = aim(draw, &triangles, origin);
            let unit = ray.direction.length();
            let interval = any_interval(draw, around.size().max_element() / unit);
            agree(&list, &others, &ray, interval)
        });
    }
}

const SPECIAL: [f32; 8] = [0.0, -0.0, 1.0, -1.0, 1e-45, -1e-45, 1e30, -1e30];

/// Faces, corners and split planes of the grids below, and points beside them.
const LATTICE: [f32; 7] = [-2.0, -1.0, -0.5, 0.0, 0.25, 1.0, 3.0];

fn every<const N: usize>(of: [f32; N]) -> impl Iterator<Item = Vec3> + Clone {
    of.into_iter().flat_map(move |x| of.into_iter().flat_map(move |y| of.map(|z| Vec3::new(x, y, z))))
}

/// Shapes that lie on split planes and have flat boxes, beside round and infinite ones.
const SPECIAL_WORLD: &str = "Group { numObjects 7
    TriangleMesh { obj_file it }
    Triangle { vertex0 -1 -1 0 vertex1 1 -1 0 vertex2 -1 1 0 }
    Triangle { vertex0 0 -1 -1 vertex1 0 1 -1 vertex2 0 0 1 }
    Sphere { center 0 0 0 radius 1 }
    Transform { Scale 0.5 1 0.25 Sphere { center 0 0 0 radius 1 } }
    Plane { normal 0 1 0 offset -1 }
    Plane { normal 1 2 3 offset 0.25 } }";

#[test]
fn p09_special_directions_and_origins_agree() {
    let geometry = build(SPECIAL_WORLD, lattice_sphere(1, 3));
    let list = List::new(&geometry);
    let others = structures(&geometry, &[[1, 1, 1], [2, 2, 2], [8, 4, 3]].map(|n| (n, Fit::Exact)));
    let mut hits = 0.0;
    for direction in every(SPECIAL) {
        for origin in every(LATTICE) {
            let ray = Ray::new(origin, direction);
            for interval in [Interval::FORWARD, Interval::ALL] {
                hits += agree(&list, &others, &ray, interval).unwrap_or_else(|e| panic!("{e}"));
            }
            // x + 0 turns −0 into +0 and leaves everything else.
            let positive = Ray::new(origin + 0.0, direction + 0.0);
            let find = |r: &Ray| list.nearest(r, Interval::ALL, &mut Counters::default());
            // The sign of a zero t may follow that of the ray; == does not see it.
            assert_eq!(find(&ray), find(&positive), "{}", ray_bits(&ray));
        }
    }
    assert!(hits > 50_000.0, "{hits}");
}

/// A ray within the plane of flat geometry crosses the flat grid and misses the triangles; one
/// across it hits.
#[test]
fn p09_flat_boxes_are_hit() {
    let geometry = build("Triangle { vertex0 0 0 0 vertex1 4 0 0 vertex2 0 4 0 }", Mesh::default());
    let list = List::new(&geometry);
    let others = structures(&geometry, &[[1, 1, 1], [4, 4, 1], [3, 5, 7]].map(|n| (n, Fit::Exact)));
    let grid = grid_of(&geometry, [4, 4, 1], Fit::Exact);
    for (x, y) in (0..8).flat_map(|x| (0..8).map(move |y| (x as f32 / 2.0, y as f32 / 2.0))) {
        let across = Ray::new(Vec3::new(x, y, 1.0), -Vec3::Z);
        let hit = agree(&list, &others, &across, Interval::FORWARD).unwrap_or_else(|e| panic!("{e}"));
        assert!(hit == 1.0 || x + y >= 4.0 || x * y == 0.0, "{x} {y}");
        let within = Ray::new(Vec3::new(-1.0, y, 0.0), Vec3::X);
        let hit = agree(&list, &others, &within, Interval::FORWARD).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(hit, 0.0);
        let march = a5_grid::March::new(grid.cells(), &within, Interval::FORWARD);
        assert_eq!(march.into_iter().flatten().count(), if y <= 4.0 { 4 } else { 0 });
    }
}

#[test]
fn p09_nan_and_infinity_hit_nothing_and_end() {
    let geometry = build(SPECIAL_WORLD, lattice_sphere(1, 3));
    let list = List::new(&geometry);
    let others = structures(&geometry, &[([8, 4, 3], Fit::Exact)]);
    let accels = || others.iter().map(|o| &*o.accel).chain([&list as &dyn Accel]);
    let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
    for (value, slot) in bad.into_iter().flat_map(|v| (0..6).map(move |s| (v, s))) {
        let mut numbers = [0.1, 0.2, 5.0, 0.0, 0.0, -1.0];
        numbers[slot] = value;
        let [x, y, z, dx, dy, dz] = numbers;
        let ray = Ray::new(Vec3::new(x, y, z), Vec3::new(dx, dy, dz));
        for accel in accels() {
            assert!(accel.nearest(&ray, Interval::ALL, &mut Counters::default()).is_none(), "{ray:?}");
            assert!(!accel.any(&ray, Interval::ALL, &mut Counters::default()));
        }
    }
    let none = Interval { min: f32::NAN, max: f32::NAN };
    let ray = Ray::new(Vec3::Z * 5.0, -Vec3::Z);
    for accel in accels() {
        assert!(accel.nearest(&ray, none, &mut Counters::default()).is_none());
    }
}
