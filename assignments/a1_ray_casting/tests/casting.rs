//! Assignment 1 against what geometry says the pictures must be.

mod world;

use common::math::Vec3;
use std::f64::consts::PI;
use world::{FRONT, UNIT_SPHERE, depth, distances, flat, positions, studio};

const RED: Vec3 = Vec3::new(1.0, 0.0, 0.0);
const BLUE: Vec3 = Vec3::new(0.0, 0.5, 1.0);
const BACKGROUND: Vec3 = Vec3::new(0.25, 0.5, 0.75);

/// Every pixel of a ball seen along −z from z = 5: t = 5 − √(1 − x² − y²).
#[test]
fn a1t1_distance_to_a_sphere_is_that_of_the_formula() {
    let film = distances(&studio(FRONT, &[UNIT_SPHERE], (80, 80)));
    for (i, j, x, y) in positions(80) {
        let (t, rest) = (f64::from(film.get(i, j).x), 1.0 - x * x - y * y);
        if rest > 0.0 {
            // Rays are rounded to f32; at the rim that moves t by √ε.
            let tolerance = 1e-6 + 1e-6 / rest.sqrt();
            assert!((t - (5.0 - rest.sqrt())).abs() < tolerance, "{i} {j}: {t}");
        } else {
            assert!(t.is_nan(), "{i} {j}: {t}");
        }
    }
}

/// Rows count from the bottom, columns from the left, and pixels are sampled at their centres.
#[test]
fn a1t1_up_is_up_and_right_is_right() {
    let studio = studio(FRONT, &["Sphere { center 1.05 0.45 0 radius 0.06 }"], (40, 40));
    let film = flat(&studio, "");
    let hit: Vec<(u32, u32)> =
        positions(40).filter(|&(i, j, ..)| film.get(i, j) == RED).map(|(i, j, ..)| (i, j)).collect();
    // Pixels are 0.1 wide: centre x = −1.95 + 0.1 i.
    assert_eq!(hit, [(30, 24)]);
}

/// Pixel centres in a circle of radius r are πr² in number, up to fewer than r.
#[test]
fn a1t1_a_circle_has_the_area_of_a_circle() {
    for side in [64, 101, 200] {
        let film = flat(&studio(FRONT, &[UNIT_SPHERE], (side, side)), "");
        let (count, r) = (film.pixels().iter().filter(|&&c| c == RED).count() as f64, side as f64 / 4.0);
        assert!((count - PI * r * r).abs() < r, "{side}: {count}");
    }
}

/// A ball of radius r at distance d looks as large as tan α = r / √(d² − r²), larger than r/d.
#[test]
fn a1t1_perspective_sees_a_ball_under_the_right_angle() {
    for (distance, angle) in [(3.0f64, 60.0f64), (1.5, 120.0), (10.0, 30.0)] {
        let camera =
            format!("PerspectiveCamera {{ center 0 0 {distance} direction 0 0 -1 up 0 1 0 angle {angle} }}");
        let film = flat(&studio(&camera, &[UNIT_SPHERE], (401, 401)), "");
        let width = film.row(200).iter().filter(|&&c| c == RED).count() as f64;
        let tangent = 1.0 / (distance * distance - 1.0).sqrt();
        let expected = 401.0 * tangent / (angle.to_radians() / 2.0).tan();
        assert!((width - expected).abs() <= 1.0, "{distance} {angle}: {width} {expected}");
    }
}

#[test]
fn a1t1_lengths_of_direction_and_up_do_not_matter() {
    let plain = distances(&studio(FRONT, &[UNIT_SPHERE], (40, 40)));
    let long = "OrthographicCamera { center 0 0 5 direction 0 0 -7 up 0 0.125 -3 size 4 }";
    let other = distances(&studio(long, &[UNIT_SPHERE], (40, 40)));
    let same = |(a, b): (&Vec3, &Vec3)| a.x == b.x || (a.x.is_nan() && b.x.is_nan());
    assert!(plain.pixels().iter().zip(other.pixels()).all(same));
}

/// A wide picture is the middle of the square one; a ball stays round.
#[test]
fn a1t1_oblong_pictures_are_cropped_squares() {
    let objects = [UNIT_SPHERE, "Sphere { center 1.3 0.3 0 radius 0.5 }"];
    let square = flat(&studio(FRONT, &objects, (80, 80)), "");
    let wide = flat(&studio(FRONT, &objects, (80, 40)), "");
    let tall = flat(&studio(FRONT, &objects, (40, 80)), "");
    assert!((0..40).all(|j| wide.row(j) == square.row(j + 20)));
    assert!((0..80).all(|j| tall.row(j) == &square.row(j)[20..60]));
}

#[test]
fn a1t2_the_nearest_wins_whatever_the_order_in_the_file() {
    let near = "MaterialIndex 0 Sphere { center 0 0 1 radius 1 }";
    let far = "MaterialIndex 1 Sphere { center 0 0 -1 radius 1.5 }";
    for objects in [[near, far], [far, near]] {
        let film = flat(&studio(FRONT, &objects, (40, 40)), "");
        for (i, j, x, y) in positions(40) {
            let r = x.hypot(y);
            let expected = if r < 1.0 {
                RED
            } else if r < 1.5 {
                BLUE
            } else {
                BACKGROUND
            };
            assert_eq!(film.get(i, j), expected, "{i} {j}");
        }
    }
}

/// With the camera's plane through the ball, the near half has negative t and still wins.
#[test]
fn a1t3_orthographic_cameras_see_behind_themselves() {
    let camera = "OrthographicCamera { center 0 0 0 direction 0 0 -1 up 0 1 0 size 4 }";
    let film = distances(&studio(camera, &[UNIT_SPHERE], (40, 40)));
    for (i, j, x, y) in positions(40).filter(|(_, _, x, y)| x.hypot(*y) < 0.95) {
        let expected = -(1.0 - x * x - y * y).sqrt();
        assert!((f64::from(film.get(i, j).x) - expected).abs() < 1e-5, "{i} {j}");
    }
}

#[test]
fn a1t3_a_perspective_camera_sees_nothing_behind_and_the_far_side_from_inside() {
    let behind = "PerspectiveCamera { center 0 0 3 direction 0 0 1 up 0 1 0 angle 60 }";
    assert!(distances(&studio(behind, &[UNIT_SPHERE], (20, 20))).pixels().iter().all(|t| t.x.is_nan()));
    let inside = "PerspectiveCamera { center 0 0 0 direction 0 0 1 up 0 1 0 angle 60 }";
    let film = distances(&studio(inside, &[UNIT_SPHERE], (20, 20)));
    assert!(film.pixels().iter().all(|t| (t.x - 1.0).abs() < 1e-6));
}

/// Grey is (max − t)/(max − min), white before min and black beyond max and where nothing is.
#[test]
fn a1t3_depth_is_white_at_min_and_black_at_max() {
    let disc = |z: f32| {
        let object = format!("Plane {{ normal 0 0 1 offset {z} center 0 0 0 radius 1 }}");
        let film = depth(&studio(FRONT, &[&object], (8, 8)), 2.0, 6.0);
        assert_eq!(film.get(0, 0), Vec3::ZERO, "background");
        film.get(4, 4).x
    };
    // The camera is at z = 5.
    for (z, grey) in [(3.0, 1.0), (4.0, 1.0), (2.0, 0.75), (1.0, 0.5), (-1.0, 0.0), (-3.0, 0.0)] {
        assert_eq!(disc(z), grey, "z = {z}");
    }
    // In perspective t is the distance along the ray, not along the camera's direction.
    let camera = "PerspectiveCamera { center 0 0 3 direction 0 0 -1 up 0 1 0 angle 90 }";
    let film = depth(&studio(camera, &["Plane { normal 0 0 1 offset 0 }"], (3, 3)), 0.0, 10.0);
    for (i, cells) in [(1, 0.0f32), (2, 1.0)] {
        let offset = 2.0 * cells / 3.0;
        assert!((film.get(i, 1).x - (1.0 - 0.3 * (1.0 + offset * offset).sqrt())).abs() < 1e-6);
    }
}
