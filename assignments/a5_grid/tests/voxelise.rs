//! A5T1: which cells a primitive belongs to.

mod world;

use a5_grid::voxelise::{count, solid_cells, triangle_cells};
use a5_grid::{Cells, Fit};
use common::math::{Bounds, DVec3, Vec3};
use std::collections::HashSet;
use world::geometry;

fn cells(n: [u32; 3], min: Vec3, max: Vec3) -> Cells {
    Cells::new(n, &Bounds { min, max })
}

fn every_cell(cells: &Cells) -> impl Iterator<Item = [usize; 3]> {
    let [nx, ny, nz] = cells.count;
    (0..nz).flat_map(move |z| (0..ny).flat_map(move |y| (0..nx).map(move |x| [x, y, z])))
}

/// The course's rule: every cell whose centre is within radius + half the cell's diagonal.
#[test]
fn a5t1_untransformed_sphere_by_the_distance_of_centres() {
    let world = geometry("Sphere { center 0.3 -0.2 0.1 radius 1 }");
    let cells = cells([7, 5, 9], Vec3::splat(-2.0), Vec3::splat(2.0));
    let mut found = HashSet::new();
    solid_cells(&cells, &world.solids()[0], Fit::Bounds, |c| assert!(found.insert(c), "{c:?} twice"));
    let half = DVec3::new(4.0 / 7.0, 4.0 / 5.0, 4.0 / 9.0).length() / 2.0;
    for cell in every_cell(&cells) {
        let (low, high) = cells.corners(cell);
        let beyond = ((low + high) / 2.0 - DVec3::new(0.3, -0.2, 0.1)).length() - 1.0 - half;
        assert!(beyond.abs() < 1e-9 || found.contains(&cell) == (beyond < 0.0), "{cell:?}");
    }
}

/// In a tracing grid the cells well inside a sphere are empty: nothing can be hit there.
#[test]
fn a5t1_exact_fit_leaves_the_inside_of_a_sphere_empty() {
    let world = geometry("Sphere { center 0 0 0 radius 4 }");
    let cells = cells([9; 3], Vec3::splat(-4.5), Vec3::splat(4.5));
    let exact = count(&cells, &world, Fit::Exact);
    assert_eq!(exact[cells.index([4, 4, 4])], 0);
    assert_eq!(exact[cells.index([8, 4, 4])], 1);
    assert_eq!(exact[cells.index([8, 8, 8])], 0, "the corner is outside");
    assert_eq!(count(&cells, &world, Fit::Bounds)[cells.index([4, 4, 4])], 1);
}

/// A plane between cells that only touches the sphere belongs to the cells on both of its sides.
#[test]
fn a5t1_a_sphere_is_in_the_cells_that_it_touches() {
    let world = geometry("Sphere { center 0 0 0 radius 1 }");
    let cells = cells([4; 3], Vec3::splat(-2.0), Vec3::splat(2.0));
    let exact = count(&cells, &world, Fit::Exact);
    for (a, end) in (0..3).flat_map(|a| [0, 3].map(|end| (a, end))) {
        for (u, v) in [(1, 1), (1, 2), (2, 1), (2, 2)] {
            let mut cell = [end; 3];
            (cell[(a + 1) % 3], cell[(a + 2) % 3]) = (u, v);
            assert_eq!(exact[cells.index(cell)], 1, "{cell:?}");
        }
    }
}

#[test]
fn a5t1_a_diagonal_triangle_fills_its_box_only_by_the_bounds_rule() {
    let cells = cells([4, 4, 1], Vec3::ZERO, Vec3::new(4.0, 4.0, 1.0));
    let thin = [Vec3::new(0.1, 0.1, 0.5), Vec3::new(3.9, 3.9, 0.5), Vec3::new(3.9, 3.8, 0.5)];
    let held = |fit| {
        let mut held = HashSet::new();
        triangle_cells(&cells, &thin, fit, |c| assert!(held.insert(c), "{c:?} twice"));
        held
    };
    assert_eq!(held(Fit::Bounds).len(), 16);
    let exact = held(Fit::Exact);
    assert!((0..4).all(|i| exact.contains(&[i, i, 0])), "{exact:?}");
    assert!(!exact.contains(&[0, 3, 0]) && !exact.contains(&[3, 0, 0]), "{exact:?}");
}

/// A triangle goes by its three transformed corners, a transformed sphere by the box around the
/// eight corners of its own box.
#[test]
fn a5t1_boxes_of_transformed_objects() {
    let turned = |object: &str| {
        let world = geometry(&format!("Transform {{ ZRotate 45 {object} }}"));
        world.bounds().expect("finite")
    };
    let near = |a: Vec3, b: Vec3| (a - b).length() < 1e-6;
    let s = 0.5f32.sqrt();
    let b = turned("Triangle { vertex0 0 0 0 vertex1 1 0 0 vertex2 0 1 0 }");
    assert!(near(b.min, Vec3::new(-s, 0.0, 0.0)) && near(b.max, Vec3::new(s, s, 0.0)), "{b:?}");
    let b = turned("Sphere { center 0 0 0 radius 1 }");
    assert!(near(b.max, Vec3::new(2f32.sqrt(), 2f32.sqrt(), 1.0)), "{b:?}");
    let plain = geometry("Sphere { center 1 2 3 radius 2 }").bounds().expect("finite");
    assert_eq!(plain, Bounds { min: Vec3::new(-1.0, 0.0, 1.0), max: Vec3::new(3.0, 4.0, 5.0) });
}

#[test]
fn a5t1_planes_are_in_no_cell() {
    let planes = "Group { numObjects 2 Plane { normal 0 1 0 offset 0 } Sphere { center 0 0 0 radius 1 } }";
    let world = geometry(planes);
    let cells = Cells::new([3; 3], &world.bounds().expect("the sphere"));
    assert!(count(&cells, &world, Fit::Bounds).iter().all(|&n| n <= 1));
}
