//! Pixels, cameras, and the depth and normal pictures against formulas.

mod support;

use common::math::DVec3;
use oracle::{Options, OracleError, Raster, View, render};
use support::{close, near, scene, simple};

fn view(camera: &str, width: u32, height: u32) -> View {
    let scene = scene(&format!("{camera} Group {{ numObjects 0 }}"));
    View::new(&scene.camera, width, height).expect("a view")
}

#[test]
fn perspective_corners_lie_on_the_pyramid() {
    let view = view("PerspectiveCamera { center 1 2 3 direction 0 0 -9 up 0 5 1 angle 90 }", 8, 8);
    let corner = view.ray(0.0, 0.0);
    assert_eq!(corner.origin, DVec3::new(1.0, 2.0, 3.0));
    close(corner.direction, DVec3::new(-1.0, -1.0, -1.0).normalize(), 1e-15);
    close(view.ray(8.0, 8.0).direction, DVec3::new(1.0, 1.0, -1.0).normalize(), 1e-15);
    close(view.ray(4.0, 4.0).direction, -DVec3::Z, 1e-15);
}

#[test]
fn the_larger_side_spans_the_unit_square() {
    let camera = "OrthographicCamera { center 0 0 0 direction 0 0 -1 up 0 1 0 size 10 }";
    let wide = view(camera, 40, 20);
    close(wide.ray(0.0, 0.0).origin, DVec3::new(-5.0, -2.5, 0.0), 1e-14);
    close(wide.ray(40.0, 20.0).origin, DVec3::new(5.0, 2.5, 0.0), 1e-14);
    let tall = view(camera, 20, 40);
    close(tall.ray(0.5, 0.5).origin, DVec3::new(-9.5 / 4.0, -19.5 / 4.0, 0.0), 1e-14);
}

#[test]
fn right_is_direction_cross_up() {
    let view = view("OrthographicCamera { center 0 0 0 direction 1 0 0 up 0.3 0 2 size 2 }", 2, 2);
    // Looking along +x with z up, the right hand points to −y.
    close(view.ray(2.0, 1.0).origin, -DVec3::Y, 1e-15);
    close(view.ray(1.0, 2.0).origin, DVec3::Z, 1e-15);
}

#[test]
fn up_must_not_be_parallel() {
    let mut scene = simple(1, "Sphere { center 0 0 0 radius 1 }");
    scene.camera.up = 3.0 * scene.camera.direction;
    let error = render(&scene, &Options::default()).unwrap_err();
    assert_eq!(error, OracleError::Camera(scene.camera.position));
}

/// Every pixel of the picture with its screen position in [−2, 2]².
fn pixels(raster: &Raster) -> impl Iterator<Item = (DVec3, DVec3)> {
    let size = f64::from(raster.width);
    let place = move |i: u32| 4.0 * ((f64::from(i) + 0.5) / size - 0.5);
    let position = move |i, j| DVec3::new(place(i), place(j), 0.0);
    let row = move |j| (0..raster.width).map(move |i| (position(i, j), raster.pixel(i, j)));
    (0..raster.height).flat_map(row)
}

#[test]
fn depth_and_normals_of_a_sphere_by_its_equation() {
    let scene = simple(1, "Sphere { center 0.3 -0.2 1 radius 1.5 }");
    let options =
        Options { width: 61, height: 61, depth: Some((7.5, 9.0)), normals: true, ..Options::default() };
    let pictures = render(&scene, &options).unwrap();
    let (depth, normals) = (pictures.depth.unwrap(), pictures.normals.unwrap());
    let mut hits = 0;
    for ((position, grey), (_, normal)) in pixels(&depth).zip(pixels(&normals)) {
        let offset = position - DVec3::new(0.3, -0.2, 0.0);
        let height_squared = 1.5 * 1.5 - offset.length_squared();
        if height_squared < 0.0 {
            assert_eq!((grey, normal), (DVec3::ZERO, DVec3::ZERO));
            continue;
        }
        hits += 1;
        let height = height_squared.sqrt();
        let expected = ((9.0 - (10.0 - 1.0 - height)) / 1.5).clamp(0.0, 1.0);
        close(grey, DVec3::splat(expected), 1e-13);
        close(normal, ((offset + height * DVec3::Z) / 1.5).abs(), 1e-13);
    }
    // The disc covers π·1.5²/16 of the picture.
    near(f64::from(hits) / 3721.0, 0.4418, 0.01);
}

#[test]
fn orthographic_rays_see_what_is_behind_the_centre() {
    let scene = simple(2, "Sphere { center 0 0 15 radius 1 } Sphere { center 0 0 0 radius 1 }");
    let options = Options { width: 1, height: 1, depth: Some((-8.0, 2.0)), ..Options::default() };
    let grey = render(&scene, &options).unwrap().depth.unwrap().pixel(0, 0);
    // The nearest point is at z = 16, t = −6.
    close(grey, DVec3::splat(0.8), 1e-14);
}

#[test]
fn perspective_rays_see_nothing_behind_the_eye() {
    let text = "PerspectiveCamera { center 0 0 10 direction 0 0 -1 up 0 1 0 angle 30 }
        Background { color 0.1 0.2 0.3 } Materials { numMaterials 1 Material { } }
        Group { numObjects 1 MaterialIndex 0 Sphere { center 0 0 15 radius 1 } }";
    let picture = render(&scene(text), &Options::default()).unwrap().colour;
    assert!(picture.pixels.iter().all(|&p| (p - DVec3::new(0.1, 0.2, 0.3)).length() < 1e-7));
}

#[test]
fn the_lower_left_pixel_comes_first() {
    let scene = simple(1, "Sphere { center -1 -1 0 radius 0.5 }");
    let options = Options { width: 2, height: 2, normals: true, ..Options::default() };
    let normals = render(&scene, &options).unwrap().normals.unwrap();
    close(normals.pixels[0], DVec3::Z, 1e-14);
    assert_eq!(normals.pixels[1..], [DVec3::ZERO; 3]);
}

#[test]
fn impossible_options_are_refused() {
    let scene = simple(1, "Sphere { center 0 0 0 radius 1 }");
    let refused = |options: Options| matches!(render(&scene, &options), Err(OracleError::Options(_)));
    assert!(refused(Options { width: 0, ..Options::default() }));
    assert!(refused(Options { depth: Some((2.0, 2.0)), ..Options::default() }));
    assert!(refused(Options { depth: Some((f64::NAN, 2.0)), ..Options::default() }));
    assert!(refused(Options { weight: f64::NAN, ..Options::default() }));
    assert!(!refused(Options { depth: Some((3.0, 2.0)), ..Options::default() }));
}
