//! Which cells an object fills, by both rules.

mod support;

use common::math::DVec3;
use oracle::{CellGrid, CellPicture, GridFit, Range, World};
use support::{mesh, near, ray, scene_with_mesh, world};

fn picture(cells: [u32; 3], fit: GridFit) -> CellPicture {
    CellPicture { cells, fit }
}

fn grid(world: &World, cells: [u32; 3]) -> CellGrid {
    CellGrid::new(world, picture(cells, GridFit::Bounds))
}

#[test]
fn corner_cells_of_a_sphere_are_empty() {
    let world = world(1, "Sphere { center 1 2 3 radius 1 }");
    // Cells of side 2/15: the corner cell's centre is √3·14/15 = 1.617 away, a cell reaches
    // 0.115 from its centre.
    for fit in [GridFit::Bounds, GridFit::Exact] {
        let grid = CellGrid::new(&world, picture([15, 15, 15], fit));
        assert_eq!(grid.count([0, 0, 0]), 0);
        assert_eq!(grid.count([14, 14, 0]), 0);
        assert_eq!(grid.count([0, 7, 7]), 1);
        assert_eq!(grid.count([7, 7, 7]), 1);
    }
}

#[test]
fn the_conservative_rule_goes_by_cell_centres() {
    let world = world(1, "Sphere { center 0 0 0 radius 1 }");
    let grid = grid(&world, [9, 9, 9]);
    for i in 0..9 {
        for j in 0..9 {
            for k in 0..9 {
                let center = |n: u32| -1.0 + 2.0 * (f64::from(n) + 0.5) / 9.0;
                let away = DVec3::new(center(i), center(j), center(k)).length();
                let expected = away <= 1.0 + 3f64.sqrt() / 9.0;
                assert_eq!(grid.count([i, j, k]), u32::from(expected), "{i} {j} {k}");
            }
        }
    }
}

#[test]
fn under_a_transform_a_sphere_fills_its_box() {
    let world = world(1, "Transform { Translate 0 0 0 Sphere { center 0 0 0 radius 1 } }");
    assert_eq!(grid(&world, [5, 5, 5]).occupied(), 125);
}

/// Whether the ellipsoid M·(unit ball) meets a box, by a search: points of the box are moved
/// to where the image is nearest to the origin, one axis at a time.
fn meets(squares: DVec3, turn: f64, low: DVec3, high: DVec3) -> Option<bool> {
    let (sin, cos) = turn.to_radians().sin_cos();
    let measure = |p: DVec3| {
        let unturned = DVec3::new(cos * p.x + sin * p.y, cos * p.y - sin * p.x, p.z);
        (unturned * unturned * squares).element_sum()
    };
    let mut p = (low + high) / 2.0;
    for _ in 0..300 {
        for axis in 0..3 {
            // The parabola along this axis, through three points.
            let at = |x: f64| {
                measure(DVec3::from_array(std::array::from_fn(|a| if a == axis { x } else { p[a] })))
            };
            let (y0, y1, y2) = (at(-1.0), at(0.0), at(1.0));
            p[axis] = ((y0 - y2) / (2.0 * (y0 + y2 - 2.0 * y1))).clamp(low[axis], high[axis]);
        }
    }
    let least = measure(p);
    ((least - 1.0).abs() > 1e-9).then_some(least < 1.0)
}

#[test]
fn exactly_an_ellipsoid_fills_the_cells_it_meets() {
    let text = "Transform { ZRotate 30 Scale 1 0.25 0.5 Sphere { center 0 0 0 radius 1 } }";
    let grid = CellGrid::new(&world(1, text), picture([9, 8, 7], GridFit::Exact));
    // The box around the turned corners (±1, ±¼, ±½).
    let (sin, cos) = (0.5, 0.75f64.sqrt());
    let corner = DVec3::new(cos + 0.25 * sin, sin + 0.25 * cos, 0.5);
    let cells = DVec3::new(9.0, 8.0, 7.0);
    let mut decided = 0;
    for index in 0..9 * 8 * 7u32 {
        let cell = [index % 9, index / 9 % 8, index / 72];
        let low = -corner + 2.0 * corner * DVec3::from_array(cell.map(f64::from)) / cells;
        let high = low + 2.0 * corner / cells;
        let Some(expected) = meets(DVec3::new(1.0, 16.0, 4.0), 30.0, low, high) else { continue };
        decided += 1;
        assert_eq!(grid.count(cell), u32::from(expected), "{cell:?}");
    }
    assert!(decided > 480 && grid.occupied() < 400, "{decided}, {}", grid.occupied());
}

#[test]
fn a_turned_sphere_has_the_box_of_its_turned_box() {
    let world = world(1, "Transform { ZRotate 45 Sphere { center 0 0 0 radius 1 } }");
    let grid = grid(&world, [1, 1, 1]);
    let hit = grid.first(&ray(DVec3::new(9.0, 0.0, 0.0), -DVec3::X), Range::FORWARD).unwrap();
    near(hit.t, 9.0 - 2f64.sqrt(), 1e-14);
    assert_eq!((hit.normal, hit.count), (DVec3::X, 1));
}

#[test]
fn triangles_fill_the_cells_of_their_box_or_exactly_their_own() {
    let diagonal = [DVec3::ZERO, DVec3::new(4.0, 0.0, 4.0), DVec3::new(0.0, 4.0, 4.0)];
    let text = "OrthographicCamera { center 0 0 9 direction 0 0 -1 up 0 1 0 size 4 }
        Materials { numMaterials 1 Material { } }
        Group { numObjects 1 MaterialIndex 0 TriangleMesh { obj_file m.obj } }";
    let world = World::new(&scene_with_mesh(text, mesh(&[diagonal]))).unwrap();
    let bounds = grid(&world, [4, 4, 4]);
    assert_eq!(bounds.occupied(), 64);
    let exact = CellGrid::new(&world, picture([4, 4, 4], GridFit::Exact));
    // The plane is x + y = z, the triangle its part below z = 4. A cell meets it if its range
    // of x + y − z contains 0 and x + y ≤ 4 is possible; all corners are integers.
    for i in 0..4u32 {
        for j in 0..4 {
            for k in 0..4 {
                let (low, high) = (i + j, i + j + 2);
                let expected = low <= k + 1 && high >= k && low <= 4;
                assert_eq!(exact.count([i, j, k]), u32::from(expected), "{i} {j} {k}");
            }
        }
    }
}

#[test]
fn touching_cells_count() {
    // The second triangle ends on the plane x = 1 between the two cells.
    let world = world(
        2,
        "Triangle { vertex0 0 0 0 vertex1 2 0 0 vertex2 0 1 1 }
         Triangle { vertex0 0 0 0 vertex1 1 0 0 vertex2 0 1 1 }",
    );
    for fit in [GridFit::Bounds, GridFit::Exact] {
        let grid = CellGrid::new(&world, picture([2, 1, 1], fit));
        assert_eq!((grid.count([0, 0, 0]), grid.count([1, 0, 0])), (2, 2));
    }
}

#[test]
fn rounding_leaves_nothing_outside_the_last_cell() {
    // Here min + (max − min) rounds to less than max, where the second triangle lies.
    let lowest = -4e-12f32;
    assert!(f64::from(lowest) + (1.0 - f64::from(lowest)) < 1.0);
    let world = world(
        2,
        "Triangle { vertex0 -4e-12 0 0 vertex1 -4e-12 1 0 vertex2 -4e-12 0 1 }
         Triangle { vertex0 1 0 0 vertex1 1 1 0 vertex2 1 0 1 }",
    );
    for fit in [GridFit::Bounds, GridFit::Exact] {
        let grid = CellGrid::new(&world, picture([2, 1, 1], fit));
        assert_eq!((grid.count([0, 0, 0]), grid.count([1, 0, 0])), (1, 1));
    }
}
