//! Property 9: numbers that are special.

use crate::kit::{Named, agree, build, grid_of, lattice_sphere, ray_bits, structures};
use crate::{Stress, Trials};
use a5_grid::Fit;
use common::accel::{Accel, List};
use common::counters::Counters;
use common::math::{Interval, Vec3};
use common::mesh::Mesh;
use common::ray::Ray;
use rayon::prelude::*;

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

/// Every combination of special numbers as direction and origin.
pub fn special(stress: &Stress) {
    let geometry = build(SPECIAL_WORLD, lattice_sphere(1, 3));
    let list = List::new(&geometry);
    let others = structures(&geometry, &[[1, 1, 1], [2, 2, 2], [8, 4, 3]].map(|n| (n, Fit::Exact)));
    // No divisor of the numbers of combinations: the quick tier, too, has every number in every place.
    let step = if stress.tier().is_thorough() { 1 } else { 5 };
    let rays = every(SPECIAL).flat_map(|d| every(LATTICE).map(move |o| Ray::new(o, d)));
    let rays: Vec<Ray> = rays.step_by(step).collect();
    let check = |ray: &Ray| -> Result<f64, String> {
        let forward = agree(&list, &others, ray, Interval::FORWARD)?;
        let both = agree(&list, &others, ray, Interval::ALL)?;
        // x + 0 turns −0 into +0 and leaves everything else.
        let positive = Ray::new(ray.origin + 0.0, ray.direction + 0.0);
        let find = |r: &Ray| list.nearest(r, Interval::ALL, &mut Counters::default());
        // The sign of a zero t may follow that of the ray; == does not see it.
        if find(ray) == find(&positive) { Ok(forward + both) } else { Err(ray_bits(ray)) }
    };
    let mut hits = 0.0;
    stress.count("p09 all special directions and origins", || {
        let found: Result<Vec<f64>, String> = rays.par_iter().map(check).collect();
        hits = found?.iter().sum();
        Ok(rays.len() as u64)
    });
    stress.expect("p09 hits of special rays", hits, |hits| hits > 50_000.0 / step as f64);
    any_special(stress, &list, &others);
}

/// Any special number in any place, in many more combinations than the lattice has.
fn any_special(stress: &Stress, list: &List, others: &[Named]) {
    stress.run("p09 special numbers anywhere", 901, Trials::new(5_000, 1_000_000), |draw| {
        let mut number = || match draw.below(3) {
            0 => draw.pick(&SPECIAL),
            1 => draw.pick(&LATTICE),
            _ => draw.pick(&LATTICE) * draw.pick(&[1e-30, 1e-10, 1.0 - f32::EPSILON, 1e10]),
        };
        let mut vector = || Vec3::new(number(), number(), number());
        let ray = Ray::new(vector(), vector());
        agree(list, others, &ray, Interval::FORWARD)?;
        agree(list, others, &ray, Interval::ALL)
    });
}

/// A ray within the plane of flat geometry crosses the flat grid and misses the triangles; one
/// across it hits.
pub fn flat_boxes(stress: &Stress) {
    let geometry = build("Triangle { vertex0 0 0 0 vertex1 4 0 0 vertex2 0 4 0 }", Mesh::default());
    let list = List::new(&geometry);
    let others = structures(&geometry, &[[1, 1, 1], [4, 4, 1], [3, 5, 7]].map(|n| (n, Fit::Exact)));
    let grid = grid_of(&geometry, [4, 4, 1], Fit::Exact);
    let places = (0..8).flat_map(|x| (0..8).map(move |y| (x as f32 / 2.0, y as f32 / 2.0)));
    let check = |(x, y): (f32, f32)| {
        let across = Ray::new(Vec3::new(x, y, 1.0), -Vec3::Z);
        let hit = agree(&list, &others, &across, Interval::FORWARD)?;
        assert!(hit == 1.0 || x + y >= 4.0 || x * y == 0.0, "{x} {y}");
        let within = Ray::new(Vec3::new(-1.0, y, 0.0), Vec3::X);
        let hit = agree(&list, &others, &within, Interval::FORWARD)?;
        assert_eq!(hit, 0.0);
        let march = a5_grid::March::new(grid.cells(), &within, Interval::FORWARD);
        assert_eq!(march.into_iter().flatten().count(), if y <= 4.0 { 4 } else { 0 });
        Ok(())
    };
    stress.count("p09 flat boxes", || {
        places.map(check).collect::<Result<Vec<_>, _>>().map(|all| 2 * all.len() as u64)
    });
}

/// NaN and infinity hit nothing, and the search ends.
pub fn not_finite(stress: &Stress) {
    let geometry = build(SPECIAL_WORLD, lattice_sphere(1, 3));
    let list = List::new(&geometry);
    let others = structures(&geometry, &[([8, 4, 3], Fit::Exact)]);
    let accels = || others.iter().map(|o| &*o.accel as &dyn Accel).chain([&list as &dyn Accel]);
    stress.count("p09 not a number, infinity", || {
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
        Ok(19)
    });
}
