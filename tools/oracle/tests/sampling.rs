//! Samples and filters, lens and curved screen, against formulas.

mod support;

use common::math::DVec3;
use oracle::{
    Filter, Options, Samples, View, filter_picture, pixel_places, render, samples, samples_picture,
};
use support::{close, near, scene, simple};

/// A board of unit squares, seen from straight above: pixels are as large as squares.
const BOARD: &str = "OrthographicCamera { center 0 0 9 direction 0 0 -1 up 0 1 0 size 8 }
    Materials { numMaterials 3 Material { diffuseColor 1 1 1 } Material { diffuseColor 0 0 0 }
        Checkerboard { Transform { Translate 0.25 0.25 0.5 } materialIndex 0 materialIndex 1 } }
    Group { numObjects 1 MaterialIndex 2 Plane { normal 0 0 1 offset 0 } }";

fn options(pixel_side: u32, filter: Option<Filter>) -> Options {
    Options { width: 8, height: 6, pixel_side, filter, ..Options::default() }
}

fn board(pixel_side: u32) -> Samples {
    samples(&scene(BOARD), &options(pixel_side, None)).unwrap()
}

#[test]
fn samples_stand_at_the_centres_of_squares_row_by_row() {
    assert_eq!(pixel_places(2), [[0.25, 0.25], [0.75, 0.25], [0.25, 0.75], [0.75, 0.75]]);
    assert_eq!(pixel_places(1), [[0.5, 0.5]]);
    // Pixel (3, 2) is the square [−1, 0]²; the last quarter of its columns and of its rows lies in
    // the next squares of the board.
    let colours: Vec<f64> = board(4).pixel(3, 2).iter().map(|c| c.x).collect();
    for (k, colour) in colours.iter().enumerate() {
        let next = (k % 4 == 3) != (k / 4 == 3);
        assert_eq!(*colour == colours[0], !next, "{k}: {colours:?}");
    }
}

#[test]
fn weights_and_supports_of_the_course() {
    assert_eq!([0.5, 0.6, 1.5, 1.7].map(|r| Filter::Box(r).support()), [0, 1, 1, 2]);
    assert_eq!([0.2, 0.4, 0.6, 2.3].map(|s| Filter::Gaussian(s).support()), [0, 1, 1, 5]);
    assert_eq!(Filter::Box(0.5).weight(0.5, -0.5), 1.0);
    assert_eq!(Filter::Box(0.5).weight(0.1, 0.6), 0.0);
    near(Filter::Tent(1.5).weight(0.9, -1.2), 0.0, 1e-15);
    near(Filter::Tent(2.0).weight(0.6, 0.8), 0.5, 1e-15);
    near(Filter::Gaussian(0.5).weight(0.5, 1.0), (-2.5f64).exp(), 1e-15);
}

#[test]
fn pixels_are_weighted_means_clipped_at_the_border() {
    let filter = Filter::Gaussian(0.7);
    let picture = render(&scene(BOARD), &options(4, Some(filter))).unwrap().colour;
    let all = board(4);
    for (i, j) in [(0u32, 0u32), (7, 3), (3, 5), (4, 2)] {
        let (mut sum, mut weights) = (0.0, 0.0);
        for (x, y) in (0..8u32).flat_map(|x| (0..6u32).map(move |y| (x, y))) {
            if x.abs_diff(i) > 1 || y.abs_diff(j) > 1 {
                continue;
            }
            for (k, colour) in all.pixel(x, y).iter().enumerate() {
                let place = |cell: u32, k: usize| f64::from(cell) + (k as f64 + 0.5) / 4.0;
                let (dx, dy) = (place(x, k % 4) - f64::from(i) - 0.5, place(y, k / 4) - f64::from(j) - 0.5);
                let weight = (-(dx * dx + dy * dy) / 0.98).exp();
                (sum, weights) = (sum + weight * colour.x, weights + weight);
            }
        }
        near(picture.pixel(i, j).x, sum / weights, 1e-12);
    }
}

#[test]
fn a_filter_that_catches_no_sample_leaves_the_mean() {
    let picture = |filter| render(&scene(BOARD), &options(4, filter)).unwrap().colour;
    assert_eq!(picture(Some(Filter::Box(0.1))), picture(None));
    assert_eq!(picture(Some(Filter::Box(0.5))), picture(None));
}

#[test]
fn the_picture_of_samples_has_their_dots_on_its_cells() {
    let picture = samples_picture(&board(2), 20).unwrap();
    assert_eq!((picture.width, picture.height), (160, 120));
    let mut painted = 0;
    for (x, y) in (0..160u32).flat_map(|x| (0..120u32).map(move |y| (x, y))) {
        // Dots of 3 × 3 around (5, 5), (15, 5), (5, 15) and (15, 15) of each cell.
        let on = |at: u32| [4, 5, 6, 14, 15, 16].contains(&(at % 20));
        if on(x) && on(y) {
            painted += 1;
            let place = |at: u32| (at % 20 / 10) as usize;
            assert_eq!(picture.pixel(x, y), board(2).pixel(x / 20, y / 20)[place(y) * 2 + place(x)]);
        } else {
            let grey = (x / 20 + y / 20) % 2 == 0;
            assert_eq!(picture.pixel(x, y), DVec3::splat(if grey { 0.2 } else { 0.0 }));
        }
    }
    assert_eq!(painted, 48 * 4 * 9);
    assert!(samples_picture(&board(1), 0).is_err());
}

#[test]
fn the_picture_of_a_filter_is_centred_and_lined() {
    let tent = options(1, Some(Filter::Tent(1.5)));
    let picture = filter_picture(&tent, 10).unwrap();
    assert_eq!((picture.width, picture.height), (81, 61));
    assert_eq!(picture.pixel(40, 33), DVec3::Z);
    assert_eq!(picture.pixel(80, 1), DVec3::Z);
    // The centre pixel is (4, 3); its neighbours count, those beyond do not.
    near(picture.pixel(44, 34).x, 1.0 - 0.05 * 2f64.sqrt() / 1.5, 1e-12);
    near(picture.pixel(59, 34).x, 1.0 - 1.45f64.hypot(0.05) / 1.5, 1e-12);
    near(picture.pixel(39, 29).x, 1.0 - 0.55f64.hypot(0.55) / 1.5, 1e-12);
    assert_eq!(picture.pixel(61, 34), DVec3::new(0.0, 0.0, 0.5));
    assert!(filter_picture(&options(1, None), 10).is_err());
    assert!(filter_picture(&options(1, Some(Filter::Tent(f64::NAN))), 10).is_err());
}

fn view(camera: &str) -> View {
    let scene = scene(&format!("PerspectiveCamera {{ center 1 2 3 {camera} }} Group {{ numObjects 0 }}"));
    View::new(&scene.camera, 100, 100).expect("a view")
}

#[test]
fn pixels_of_a_curved_screen_have_equal_angles() {
    let view = view("direction 0 0 -1 up 0 1 0 angle 120 screen curved");
    for i in 0..100 {
        let at = f64::from(i);
        let (one, next) = (view.ray(at, 50.0).direction, view.ray(at + 1.0, 50.0).direction);
        near(one.angle_between(next).to_degrees(), 1.2, 1e-6);
        let (one, next) = (view.ray(50.0, at).direction, view.ray(50.0, at + 1.0).direction);
        near(one.angle_between(next).to_degrees(), 1.2, 1e-6);
    }
    close(view.ray(50.0, 50.0).direction, -DVec3::Z, 1e-15);
    close(view.ray(125.0, 50.0).direction, DVec3::X, 1e-12);
    let (sin, cos) = 60f64.to_radians().sin_cos();
    close(view.ray(100.0, 100.0).direction, DVec3::new(sin * cos, sin, -cos * cos), 1e-12);
}

/// Where the rays through a lens start, from its middle, and where they cross a distance.
fn lens(fields: &str, across: f64, distance: impl Fn(DVec3) -> f64) -> (Vec<DVec3>, Vec<DVec3>) {
    let view = view(&format!("direction 0 0 -1 up 0 1 0 angle 50 {fields}"));
    let rays = view.rays(across, 30.0, 24);
    let eye = DVec3::new(1.0, 2.0, 3.0);
    rays.iter().map(|ray| (ray.origin - eye, ray.at(distance(ray.direction)))).unzip()
}

#[test]
fn rays_of_a_round_lens_fill_a_disc_and_meet_in_focus() {
    let (starts, ends) = lens("aperture 0.8 focalDistance 5", 80.0, |d| -5.0 / d.z);
    ends.iter().for_each(|end| close(*end, ends[0], 1e-12));
    near(ends[0].z, -2.0, 1e-12);
    assert!(starts.iter().all(|s| s.length() < 0.4 && s.z == 0.0));
    // A disc's mean square distance from its middle is half of the radius squared.
    let n = starts.len() as f64;
    near(starts.iter().map(|s| s.length_squared()).sum::<f64>() / n, 0.08, 1e-12);
    close(starts.iter().sum::<DVec3>() / n, DVec3::ZERO, 1e-12);
}

#[test]
fn rays_of_a_hexagon_fill_it_with_a_corner_on_top() {
    let (starts, _) = lens("aperture 2 focalDistance 5 blades 6", 80.0, |_| 1.0);
    // In the directions of corners the hexagon reaches to 1, in those of sides to √¾.
    let reach = |angle: f64| {
        let towards = DVec3::new(angle.sin(), angle.cos(), 0.0);
        starts.iter().map(|s| s.dot(towards)).fold(0.0, f64::max)
    };
    for k in 0..6 {
        let corner = f64::from(k) * 60f64.to_radians();
        assert!((0.8..1.0).contains(&reach(corner)), "{}", reach(corner));
        let side = reach(corner + 30f64.to_radians());
        assert!((0.83..0.75f64.sqrt()).contains(&side), "{side}");
    }
    // Second moment of a regular hexagon: 5/12 of its circumradius squared.
    let n = starts.len() as f64;
    near(starts.iter().map(|s| s.length_squared()).sum::<f64>() / n, 5.0 / 12.0, 5e-3);
}

#[test]
fn a_curved_screen_is_in_focus_on_a_sphere() {
    let (_, ends) = lens("aperture 0.8 focalDistance 5 screen curved", 90.0, |_| 5.0);
    let middle = ends.iter().sum::<DVec3>() / ends.len() as f64;
    near(middle.distance(DVec3::new(1.0, 2.0, 3.0)), 5.0, 0.02);
}

#[test]
fn a_lens_of_one_place_is_a_pinhole() {
    let text = |lens: &str| {
        format!(
            "PerspectiveCamera {{ center 0 0 9 direction 0 0 -1 up 0 1 0 angle 40 {lens} }}
        Materials {{ numMaterials 1 Material {{ }} }}
        Group {{ numObjects 1 MaterialIndex 0 Sphere {{ center 0 0 0 radius 2 }} }}"
        )
    };
    let drawn = |lens: &str, lens_side: u32| {
        let options = Options { width: 40, height: 40, lens_side, ..Options::default() };
        render(&scene(&text(lens)), &options).unwrap().colour
    };
    let open = "aperture 1 focalDistance 3";
    let pinhole = drawn("", 16);
    assert_eq!(pinhole, drawn(open, 1));
    let shades = |picture: &oracle::Raster| picture.pixels.iter().filter(|p| p.x > 0.5 && p.x < 1.0).count();
    assert_eq!(shades(&pinhole), 0);
    assert!(shades(&drawn(open, 8)) > 200, "out of focus the ball's edge is a ramp");
}

#[test]
fn impossible_sampling_is_refused() {
    let scene = simple(1, "Sphere { center 0 0 0 radius 1 }");
    let refused = |options: Options| render(&scene, &options).is_err();
    assert!(refused(Options { pixel_side: 0, ..Options::default() }));
    assert!(refused(Options { light_side: 0, ..Options::default() }));
    assert!(refused(Options { filter: Some(Filter::Box(0.0)), ..Options::default() }));
}
