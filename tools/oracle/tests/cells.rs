//! The picture of the occupied cells.

mod support;

use common::math::DVec3;
use oracle::{CellGrid, CellPicture, GridFit, Options, Range, Raster, World, cell_colour, render};
use support::{Random, close, near, ray, scene, simple, world};

fn picture(cells: [u32; 3], fit: GridFit) -> CellPicture {
    CellPicture { cells, fit }
}

fn grid(world: &World, cells: [u32; 3]) -> CellGrid {
    CellGrid::new(world, picture(cells, GridFit::Bounds))
}

fn drawn(objects: &str, count: u32, cells: [u32; 3]) -> Raster {
    let text = format!(
        "OrthographicCamera {{ center 0 0 10 direction 0 0 -1 up 0 1 0 size 4 }}
         Background {{ color 0 0 1 ambientLight 0.25 0.25 0.25 }}
         Lights {{ numLights 1 DirectionalLight {{ direction 0 -3 -4 color 0.5 0.5 0.5 }} }}
         Materials {{ numMaterials 1 Material {{ diffuseColor 1 0 0 }} }}
         Group {{ numObjects {count} MaterialIndex 0 {objects} }}"
    );
    let grid = Some(picture(cells, GridFit::Bounds));
    let options = Options { width: 40, height: 40, grid, ..Options::default() };
    render(&scene(&text), &options).unwrap().colour
}

#[test]
fn one_sphere_in_one_cell_is_a_white_cube() {
    let picture = drawn("Sphere { center 0 0 0 radius 1 }", 1, [1, 1, 1]);
    for j in 0..40 {
        for i in 0..40 {
            let inside = (10..30).contains(&i) && (10..30).contains(&j);
            // The face towards the camera: N·L is 4/5.
            let expected = if inside { DVec3::splat(0.25 + 0.8 * 0.5) } else { DVec3::Z };
            close(picture.pixel(i, j), expected, 1e-15);
        }
    }
}

#[test]
fn planes_are_not_in_the_grid() {
    let plane = "Plane { normal 0 0 1 offset 3 }";
    let alone = drawn(plane, 1, [2, 2, 2]);
    assert!(alone.pixels.iter().all(|&p| p == DVec3::Z));
    let both = drawn(&format!("{plane} Sphere {{ center 0 0 0 radius 1 }}"), 2, [1, 1, 1]);
    assert_eq!(both, drawn("Sphere { center 0 0 0 radius 1 }", 1, [1, 1, 1]));
}

#[test]
fn a_flat_grid_can_be_seen_from_everywhere() {
    let flat = world(1, "Triangle { vertex0 0 0 1 vertex1 3 0 1 vertex2 0 3 1 }");
    let grid = grid(&flat, [3, 3, 3]);
    for (origin, look, t, normal) in [
        (DVec3::new(0.5, 0.5, 9.0), -DVec3::Z, 8.0, DVec3::Z),
        (DVec3::new(2.5, 2.5, -3.0), DVec3::Z, 4.0, -DVec3::Z),
        (DVec3::new(-2.0, 0.5, 1.0), DVec3::X, 2.0, -DVec3::X),
    ] {
        let hit = grid.first(&ray(origin, look), Range::FORWARD).expect("a cell");
        assert_eq!((hit.t, hit.normal, hit.count), (t, normal, 1));
    }
    assert_eq!(grid.first(&ray(DVec3::new(3.5, 0.5, 9.0), -DVec3::Z), Range::LINE), None);
}

#[test]
fn starting_inside_shows_the_face_behind() {
    let grid = grid(&world(1, "Sphere { center 0 0 0 radius 1 }"), [1, 1, 1]);
    let look = DVec3::new(3.0, 1.0, -2.0);
    let hit = grid.first(&ray(DVec3::new(0.5, 0.0, 0.1), look), Range::FORWARD).unwrap();
    // Backwards the ray leaves through z = 1, after 0.9/2 of `look`, before x = −1.
    near(hit.t, -0.45 * look.length(), 1e-15);
    assert_eq!(hit.normal, DVec3::Z);
    assert_eq!(grid.first(&ray(DVec3::new(0.0, 0.0, 1.5), DVec3::Z), Range::FORWARD), None);
    assert!(grid.first(&ray(DVec3::new(0.0, 0.0, 1.5), DVec3::Z), Range::LINE).is_some());
}

/// Walks along the ray in small steps and looks into which cell each point falls.
#[test]
fn the_first_cell_is_the_first_on_a_fine_walk() {
    let world = world(
        3,
        "Sphere { center -0.8 0 0 radius 0.2 } Sphere { center 0.9 0.5 0.5 radius 0.1 }
         Sphere { center 0.4 -0.9 -0.5 radius 0.1 }",
    );
    let (low, high) = (DVec3::new(-1.0, -1.0, -0.6), DVec3::new(1.0, 0.6, 0.6));
    let cells = [9, 7, 8];
    let grid = grid(&world, cells);
    let cell_at = |p: DVec3| {
        let scaled = (p - low) / (high - low);
        let inside = scaled.min_element() >= 0.0 && scaled.max_element() < 1.0;
        inside.then(|| std::array::from_fn(|a| (scaled[a] * f64::from(cells[a])) as u32))
    };
    let mut random = Random(8);
    let step = 1e-3;
    let mut seen = 0;
    for _ in 0..500 {
        let ray = ray(4.0 * random.direction(), random.cube());
        let ray = support::ray(ray.origin, ray.direction - ray.origin);
        let walked = (0..8000).map(|n| f64::from(n) * step).find_map(|t| {
            let cell: [u32; 3] = cell_at(ray.at(t))?;
            (grid.count(cell) > 0).then_some((t, cell))
        });
        let hit = grid.first(&ray, Range::FORWARD);
        match (walked, hit) {
            (Some((t, cell)), Some(hit)) if hit.cell == cell => {
                seen += 1;
                near(t, hit.t + step / 2.0, step / 2.0 + 1e-9);
            }
            // The walk may step over the corner of a cell, never find one that is not there.
            (walked, hit) => {
                let before = walked.map_or(f64::INFINITY, |(t, _)| t);
                let cut = hit.map(|hit| (hit.t + step, cell_at(ray.at(hit.t + step))));
                assert!(hit.is_none_or(|h| h.t < before) && (hit.is_some() || walked.is_none()));
                assert!(cut.is_none_or(|(_, cell)| cell != hit.map(|h| h.cell)));
            }
        }
    }
    assert!(seen > 50, "only {seen} rays met a cell");
}

#[test]
fn the_ramp_is_white_then_blue_to_red() {
    assert_eq!(cell_colour(1), DVec3::ONE);
    close(cell_colour(2), DVec3::new(0.25, 0.4, 1.0), 0.0);
    close(cell_colour(9), DVec3::new(0.3, 0.9, 0.2), 1e-15);
    close(cell_colour(16), DVec3::new(1.0, 0.15, 0.1), 1e-15);
    close(cell_colour(3), DVec3::new(0.25, 0.4, 1.0).lerp(DVec3::new(0.2, 0.9, 0.9), 4.0 / 14.0), 1e-15);
    assert_eq!(cell_colour(1_000_000), cell_colour(16));
}

#[test]
fn depth_and_normals_show_the_cells_too() {
    let scene = simple(1, "Sphere { center 0 0 0 radius 1 }");
    let grid = Some(picture([1, 1, 1], GridFit::Bounds));
    let depth = Some((8.0, 10.0));
    let options = Options { width: 4, height: 4, grid, depth, normals: true, ..Options::default() };
    let pictures = render(&scene, &options).unwrap();
    close(pictures.depth.unwrap().pixel(1, 1), DVec3::splat(0.5), 1e-15);
    assert_eq!(pictures.normals.unwrap().pixel(2, 2), DVec3::Z);
}
