//! A5T3: the grid finds what the list finds, with fewer questions.

mod world;

use a5_grid::{Cells, Fit, Grid};
use common::accel::{Accel, List};
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::{Bounds, Interval, Vec3};
use common::ray::Ray;
use world::geometry;

const WORLD: &str = "Group { numObjects 4
    Sphere { center 0 0 0 radius 1 }
    Transform { Translate 2 0 0 Scale 0.5 1 0.5 Sphere { center 0 0 0 radius 1 } }
    Triangle { vertex0 -2 -1 -2 vertex1 3 -1 -2 vertex2 0 2 -2 }
    Plane { normal 0 1 0 offset -1.5 } }";

fn grid(world: &Geometry, n: [u32; 3]) -> Grid<'_> {
    let bounds = world.bounds().unwrap_or(Bounds::of_points([Vec3::ZERO]));
    Grid::new(world, Cells::new(n, &bounds), Fit::Exact).expect("a small grid")
}

/// A picture's worth of rays.
fn rays() -> impl Iterator<Item = Ray> {
    let at = |i: i32| i as f32 / 20.0;
    (-40..=40).flat_map(move |x| {
        (-40..=40).map(move |y| Ray::new(Vec3::new(0.5, 0.5, 6.0), Vec3::new(at(x), at(y), -2.5)))
    })
}

#[test]
fn a5t3_grid_equals_list() {
    let world = geometry(WORLD);
    let list = List::new(&world);
    for n in [[1, 1, 1], [2, 3, 5], [20, 10, 15]] {
        let grid = grid(&world, n);
        grid.validate().expect("a valid grid");
        let (mut counters, mut found) = (Counters::default(), [0; 4]);
        for ray in rays() {
            let truth = list.nearest(&ray, Interval::FORWARD, &mut counters);
            assert_eq!(grid.nearest(&ray, Interval::FORWARD, &mut counters), truth, "{n:?} {ray:?}");
            assert_eq!(grid.any(&ray, Interval::FORWARD, &mut counters), truth.is_some());
            truth.iter().for_each(|h| found[h.primitive as usize] += 1);
        }
        assert!(found.iter().all(|&n| n > 50), "{found:?}");
    }
}

/// The course's counters: one step per cell, one test per primitive of a visited cell; a plane
/// is asked for every ray and costs no cell.
#[test]
fn a5t3_counters() {
    let count = |world: &Geometry, n, ray: &Ray| {
        let mut counters = Counters::default();
        grid(world, n).nearest(ray, Interval::FORWARD, &mut counters);
        (counters.intersections, counters.cells)
    };
    let sphere = geometry("Sphere { center 0 0 0 radius 1 }");
    let through = Ray::new(Vec3::Z * 5.0, -Vec3::Z);
    assert_eq!(count(&sphere, [1, 1, 1], &through), (1, 1));
    assert_eq!(count(&sphere, [1, 1, 5], &through), (1, 1), "the first cell has the hit");
    assert_eq!(count(&sphere, [5, 5, 5], &Ray::new(Vec3::Z * 5.0, Vec3::Z)), (0, 0));
    let plane = geometry("Plane { normal 0 0 1 offset 0 }");
    assert_eq!(count(&plane, [4, 4, 4], &through).0, 1);
}

/// The mailbox question: an object in many cells may be asked again, but a hit counts only once
/// and only if nothing nearer can follow.
#[test]
fn a5t3_a_hit_beyond_the_cell_does_not_end_the_march() {
    // The large triangle is in the first cell, but hit behind the small sphere, or beside it.
    let world = geometry(
        "Group { numObjects 2
        Triangle { vertex0 -4 -1 -0.35 vertex1 4 -1 0.05 vertex2 4 3 0.05 }
        Sphere { center 0 0 0 radius 0.25 } }",
    );
    let (list, grid) = (List::new(&world), grid(&world, [8, 2, 1]));
    let (mut counters, mut found) = (Counters::default(), [0; 2]);
    for i in -50..50 {
        let ray = Ray::new(Vec3::new(-5.0, i as f32 / 100.0, 0.01), Vec3::X);
        let truth = list.nearest(&ray, Interval::FORWARD, &mut counters);
        assert_eq!(grid.nearest(&ray, Interval::FORWARD, &mut counters), truth, "{i}");
        truth.iter().for_each(|hit| found[hit.primitive as usize] += 1);
    }
    assert!(found.iter().all(|&n| n > 40), "{found:?}");
}

/// The line passes the sphere by, and its box, by less than the rounding of the sphere's test,
/// which calls it touched. The grid must not know better.
#[test]
fn a5t3_rays_that_graze_a_sphere_at_the_side_of_the_box() {
    let world = geometry("Sphere { center 0 0 0 radius 1 }");
    let ray = Ray::new(Vec3::new(0.0, -1.0, 3.0), Vec3::new(0.0, 1.0, 1e30));
    let list = List::new(&world).nearest(&ray, Interval::ALL, &mut Counters::default());
    assert!(list.is_some());
    assert_eq!(grid(&world, [4; 3]).nearest(&ray, Interval::ALL, &mut Counters::default()), list);
}

#[test]
fn a5t3_worlds_without_finite_objects() {
    for world in [geometry("Group { numObjects 0 }"), geometry("Plane { normal 0 0 1 offset 0 }")] {
        let grid = grid(&world, [3; 3]);
        grid.validate().expect("a valid grid");
        let ray = Ray::new(Vec3::Z, -Vec3::Z);
        let hit = grid.nearest(&ray, Interval::FORWARD, &mut Counters::default());
        assert_eq!(hit.map(|h| h.t), (!world.is_empty()).then_some(1.0));
    }
}
