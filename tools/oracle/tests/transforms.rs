//! Nested transforms: positions, t and normals.

mod support;

use common::math::DVec3;
use oracle::{Options, OracleError, Range, World, render};
use support::{Random, close, distance, near, ray, scene, simple, world};

#[test]
fn the_last_listed_acts_first() {
    // The centre (1, 0, 0) turns to (0, 1, 0), then moves by 5 along x.
    let world = world(1, "Transform { Translate 5 0 0 ZRotate 90 Sphere { center 1 0 0 radius 0.5 } }");
    let hit = world.nearest(&ray(DVec3::new(5.0, 1.0, 9.0), -DVec3::Z), Range::FORWARD);
    near(hit.unwrap().t, 8.5, 1e-14);
    assert_eq!(distance(&world, &ray(DVec3::new(6.0, 0.0, 9.0), -DVec3::Z)), None);
}

#[test]
fn rotations_are_right_handed() {
    for (turn, from, to) in [
        ("XRotate 90", DVec3::Y, DVec3::Z),
        ("YRotate 90", DVec3::Z, DVec3::X),
        ("ZRotate 90", DVec3::X, DVec3::Y),
        ("Rotate { 2 2 2 120 }", DVec3::X, DVec3::Y),
        ("Matrix { 0 0 1 0  1 0 0 0  0 1 0 0  0 0 0 1 }", DVec3::X, DVec3::Y),
    ] {
        let center = format!("{} {} {}", from.x, from.y, from.z);
        let world = world(1, &format!("Transform {{ {turn} Sphere {{ center {center} radius 0.25 }} }}"));
        let t = distance(&world, &ray(4.0 * to, -to)).expect(turn);
        near(t, 2.75, 1e-14);
    }
}

/// x²/4 + 4y² + z²/9 = 1, moved to (1, 2, 3).
const ELLIPSOID: &str = "Transform { Translate 1 2 3 Transform { Scale 2 0.5 3
    Sphere { center 0 0 0 radius 1 } } }";

#[test]
fn t_is_a_distance_and_normals_follow_the_gradient() {
    let world = world(1, ELLIPSOID);
    let inverse_squares = DVec3::new(0.25, 4.0, 1.0 / 9.0);
    let center = DVec3::new(1.0, 2.0, 3.0);
    let mut random = Random(5);
    for _ in 0..1000 {
        let origin = center + 20.0 * random.direction();
        let target = center + 0.3 * random.cube();
        let hit = world.nearest(&ray(origin, target - origin), Range::FORWARD).expect("a hit");
        near(hit.t, hit.point.distance(origin), 1e-13);
        let p = hit.point - center;
        near((p * p).dot(inverse_squares), 1.0, 1e-12);
        close(hit.normal, (p * inverse_squares).normalize(), 1e-12);
    }
}

#[test]
fn t_is_not_changed_by_scaling_along_the_ray() {
    let world = world(1, ELLIPSOID);
    near(distance(&world, &ray(DVec3::new(1.0, 2.0, 13.0), -DVec3::Z)).unwrap(), 7.0, 1e-14);
    near(distance(&world, &ray(DVec3::new(1.0, 2.0, 3.0), DVec3::Y)).unwrap(), 0.5, 1e-15);
}

#[test]
fn normals_use_the_inverse_transpose() {
    // The plane x + y = 0 stretched three times along y: 3x + y = 0.
    let world = world(1, "Transform { Scale 1 3 1 Plane { normal 1 1 0 offset 0 } }");
    let hit = world.nearest(&ray(DVec3::new(5.0, 0.0, 0.0), -DVec3::X), Range::FORWARD).unwrap();
    close(hit.normal, DVec3::new(3.0, 1.0, 0.0).normalize(), 1e-15);
    near(hit.t, 5.0, 1e-15);
}

#[test]
fn normals_turn_with_the_object() {
    let world = world(1, "Transform { ZRotate 30 Plane { normal 1 0 0 offset 2 } }");
    let normal = DVec3::new(0.75f64.sqrt(), 0.5, 0.0);
    let hit = world.nearest(&ray(9.0 * normal, -normal), Range::FORWARD).unwrap();
    close(hit.normal, normal, 1e-15);
    near(hit.t, 7.0, 1e-14);
}

#[test]
fn mirroring_keeps_outward_outward() {
    let world = world(1, "Transform { Scale -2 1 1 Sphere { center -1 0 0 radius 1 } }");
    let hit = world.nearest(&ray(DVec3::new(9.0, 0.0, 0.0), -DVec3::X), Range::FORWARD).unwrap();
    near(hit.t, 5.0, 1e-14);
    close(hit.normal, DVec3::X, 1e-15);
}

#[test]
fn tiny_scales_are_not_singular() {
    let world = world(1, "Transform { UniformScale 1e-6 Sphere { center 0 0 0 radius 1e6 } }");
    near(distance(&world, &ray(3.0 * DVec3::Z, -DVec3::Z)).unwrap(), 2.0, 1e-14);
}

#[test]
fn nesting_is_limited_by_memory_only() {
    let depth = 100_000;
    let open = "Transform { Translate 1e-5 0 0 Group { numObjects 1 ".repeat(depth);
    let close = "} }".repeat(depth);
    let world = world(1, &format!("{open} Sphere {{ center 0 0 0 radius 0.5 }} {close}"));
    near(distance(&world, &ray(DVec3::new(1.0, 0.0, 9.0), -DVec3::Z)).unwrap(), 8.5, 1e-9);
}

#[test]
fn a_product_without_inverse_is_refused() {
    let open = "Transform { UniformScale 1e-30 ".repeat(12);
    let scene = simple(1, &format!("{open} Sphere {{ center 0 0 0 radius 1 }} {}", "}".repeat(12)));
    assert!(matches!(World::new(&scene), Err(OracleError::Singular(_))));
}

#[test]
fn later_assignments_are_refused() {
    let text = |background: &str| {
        format!(
            "OrthographicCamera {{ center 0 0 5 direction 0 0 -1 up 0 1 0 size 2 }} {background}
             Group {{ numObjects 0 }}"
        )
    };
    let sky = scene(&text("Background { environment sky.hdr }"));
    let error = render(&sky, &Options::default()).unwrap_err();
    assert!(error.to_string().ends_with("an environment light belongs to assignment 8"), "{error}");
    assert!(render(&scene(&text("")), &Options::default()).is_ok());
}
