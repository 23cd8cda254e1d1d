//! A2T1 and A2T3: shapes under transforms, their distances and normals.

mod world;

use a1_ray_casting::Studio;
use common::math::Vec3;
use world::{
    CUBE, FRONT, PERSPECTIVE, SUN, UNIT_SPHERE, color, difference, distances, normals, positions,
    signed_normals, studio, transformed,
};

fn scene(camera: &str, object: &str) -> Studio {
    studio(camera, &[SUN], &[object])
}

/// Pictures of two objects are the same up to rounding.
fn assert_same(camera: &str, a: &str, b: &str) {
    let (a, b) = (scene(camera, a), scene(camera, b));
    assert!(difference(&distances(&a), &distances(&b)) < 1e-4);
    assert!(difference(&color(&a, ""), &color(&b, "")) < 1e-4);
    assert!(difference(&signed_normals(&a), &signed_normals(&b)) < 1e-4);
}

/// The object-space ray keeps its length, so t is the same number in both spaces.
#[test]
fn a2t1_scaling_does_not_change_what_t_means() {
    for camera in [FRONT, PERSPECTIVE] {
        let half = "Sphere { center 0 0 0 radius 0.5 }";
        assert_same(camera, UNIT_SPHERE, &transformed("Scale 2 2 2", half));
        assert_same(camera, UNIT_SPHERE, &transformed("UniformScale 0.25 UniformScale 8", half));
        // Not a similarity at any level, but the product is one.
        let nested = transformed("Scale 4 0.5 2", &transformed("Scale 0.5 4 1", half));
        assert_same(camera, UNIT_SPHERE, &nested);
    }
    // An ellipsoid: t = 5 − 3·√(1 − x²), on the middle row.
    let film = distances(&scene(FRONT, &transformed("Scale 1 1 3", UNIT_SPHERE)));
    for (i, j, x, y) in positions().filter(|(_, _, x, y)| x.hypot(*y) < 0.95) {
        let expected = 5.0 - 3.0 * (1.0 - x * x - y * y).sqrt();
        assert!((film.get(i, j).x - expected).abs() < 1e-4, "{i} {j}");
    }
}

#[test]
fn a2t1_the_last_transform_in_the_list_is_applied_first() {
    let ball = "Sphere { center 1 0 0 radius 0.4 }";
    // Turn (1, 0, 0) to (0, 1, 0), then move it by (0.5, 0, 0).
    let expected = "Sphere { center 0.5 1 0 radius 0.4 }";
    assert_same(FRONT, expected, &transformed("Translate 0.5 0 0 ZRotate 90", ball));
    assert_same(FRONT, expected, &transformed("Translate 0.5 0 0", &transformed("ZRotate 90", ball)));
    assert_same(FRONT, expected, &transformed("Matrix { 0 -1 0 0.5  1 0 0 0  0 0 1 0  0 0 0 1 }", ball));
    let other = "Sphere { center 0 1.5 0 radius 0.4 }";
    assert_same(FRONT, other, &transformed("ZRotate 90 Translate 0.5 0 0", ball));
}

#[test]
fn a2t1_rotating_a_ball_and_turning_right_round_show_nothing() {
    for list in ["Rotate { 1 2 3 77 }", "XRotate 90 YRotate 90 ZRotate -90", "YRotate 360"] {
        assert_same(PERSPECTIVE, UNIT_SPHERE, &transformed(list, UNIT_SPHERE));
    }
    assert_same(PERSPECTIVE, CUBE, &transformed("Rotate { 1 1 1 120 }", CUBE));
    assert_same(PERSPECTIVE, CUBE, &transformed("XRotate 90", CUBE));
}

/// A mirrored cube is a cube; inside out it would be black.
#[test]
fn a2t1_mirrored_shapes_keep_their_outside() {
    for shape in [CUBE, UNIT_SPHERE] {
        for scale in ["-1 1 1", "1 -1 1", "-1 -1 -1"] {
            assert_same(PERSPECTIVE, shape, &transformed(&format!("Scale {scale}"), shape));
        }
    }
    // A plane's normal is mirrored with it: what looked at the camera looks away.
    let plane = "Plane { normal 0 0 1 offset 0 }";
    let film = color(&scene(FRONT, &transformed("Scale 1 1 -1", plane)), "");
    assert!(film.pixels().iter().all(|&c| c == Vec3::ZERO));
}

#[test]
fn a2t1_planes_end_at_the_horizon() {
    let camera = "PerspectiveCamera { center 0 1 0 direction 0 0 -1 up 0 1 0 angle 60 }";
    let film = distances(&scene(camera, "Plane { normal 0 3 0 offset 0 }"));
    for (i, j, x, y) in positions() {
        // Screen positions in [−1, 1]·tan 30°.
        let slope = 30f32.to_radians().tan() / 2.0;
        let (x, y) = (x * slope, y * slope);
        let expected = if y < 0.0 { (1.0 + x * x + y * y).sqrt() / -y } else { -1.0 };
        assert!((film.get(i, j).x - expected).abs() < 1e-4 * expected.abs(), "{i} {j}");
    }
}

/// Planes are `P·n = offset` with n normalised first, also under transforms.
#[test]
fn a2t1_transformed_planes_pass_through_the_transformed_points() {
    let tilted = "Plane { normal 0 0 5 offset 0 }";
    let film = distances(&scene(FRONT, &transformed("Translate 0 0 1 XRotate 45", tilted)));
    for (i, j, _, y) in positions() {
        // z rises towards the bottom: the normal (0, −√½, √½) gives z = 1 + y.
        assert!((film.get(i, j).x - (4.0 - y)).abs() < 1e-5, "{i} {j}");
    }
}

/// x + y = 0 stretched along y is x + y/2 = 0: the normal goes with M⁻ᵀ, here as anywhere.
#[test]
fn a2t3_normals_of_stretched_planes_stay_perpendicular() {
    let plane = transformed("Scale 1 2 1", "Plane { normal 1 1 1 offset 0 }");
    let studio = scene(FRONT, &plane);
    let expected = Vec3::new(1.0, 0.5, 1.0).normalize();
    assert!(signed_normals(&studio).pixels().iter().all(|n| (*n - expected).length() < 1e-6));
    let film = distances(&studio);
    for (i, j, x, y) in positions() {
        assert!((film.get(i, j).x - (5.0 + x + y / 2.0)).abs() < 1e-5, "{i} {j}");
    }
}

#[test]
fn a2t1_triangles_have_their_edges_where_the_corners_say() {
    let film = distances(&scene(FRONT, "Triangle { vertex0 -1 -1 0 vertex1 1.5 -1 0 vertex2 -1 1.5 2 }"));
    for (i, j, x, y) in positions() {
        let (u, v) = ((x + 1.0) / 2.5, (y + 1.0) / 2.5);
        if u > 0.0 && v > 0.0 && u + v < 1.0 {
            assert!((film.get(i, j).x - (5.0 - 2.0 * v)).abs() < 1e-5, "{i} {j}");
        } else {
            assert_eq!(film.get(i, j).x, -1.0, "{i} {j}");
        }
    }
}

/// World normal = M⁻ᵀ n: the squashed ball (x, y/b, z) has the normal (x, y/b², z).
#[test]
fn a2t3_normals_go_with_the_inverse_transpose() {
    let b = 0.4f32;
    let film = signed_normals(&scene(FRONT, &transformed("Scale 1 0.4 1", UNIT_SPHERE)));
    let mut seen = 0;
    for (i, j, x, y) in positions() {
        let rest = 1.0 - x * x - (y / b) * (y / b);
        if rest > 0.01 {
            let expected = Vec3::new(x, y / (b * b), rest.sqrt()).normalize();
            assert!((film.get(i, j) - expected).length() < 1e-4, "{i} {j}");
            seen += 1;
        }
    }
    assert!(seen > 200);
}

#[test]
fn a2t3_normals_of_a_sheared_mesh_stand_on_its_faces() {
    let studio = scene(PERSPECTIVE, &transformed("Matrix { 1 0.5 0 0  0 1 0 0  0 0.3 1 0  0 0 0 1 }", CUBE));
    let film = signed_normals(&studio);
    // M⁻ᵀ of ±x, ±y, ±z for this shear.
    let faces = [Vec3::new(1.0, -0.5, 0.0), Vec3::Y, Vec3::new(0.0, -0.3, 1.0)].map(|n: Vec3| n.normalize());
    let stands = |n: &Vec3| *n == Vec3::ZERO || faces.iter().any(|f| (f.dot(*n).abs() - 1.0).abs() < 1e-5);
    assert!(film.pixels().iter().all(stands));
    assert!(film.pixels().iter().filter(|n| **n != Vec3::ZERO).count() > 300);
}

/// The picture shows absolute values, black background, and knows no sides.
#[test]
fn a2t3_pictures_of_normals_show_absolute_values() {
    let inside = "PerspectiveCamera { center 0 0 0 direction 0 0 -1 up 0 1 0 angle 60 }";
    for camera in [FRONT, inside] {
        let studio = scene(camera, UNIT_SPHERE);
        let (film, signed) = (normals(&studio, ""), signed_normals(&studio));
        assert!(film.pixels().iter().zip(signed.pixels()).all(|(a, s)| *a == s.abs()));
        assert!(film.pixels().iter().all(|n| *n == Vec3::ZERO || (n.length() - 1.0).abs() < 1e-6));
        assert_eq!(film, normals(&studio, "-shade_back"));
        assert!(signed.pixels().iter().any(|n| n.min_element() < -0.1));
    }
    assert_eq!(normals(&scene(FRONT, UNIT_SPHERE), "").get(0, 0), Vec3::ZERO);
}
