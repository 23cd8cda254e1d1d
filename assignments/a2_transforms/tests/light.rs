//! A2T2: diffuse light and its two sides.

mod world;

use common::math::Vec3;
use world::{
    CUBE, FRONT, PERSPECTIVE, SUN, UNIT_SPHERE, args, color, difference, positions, studio, transformed,
};

const KD: Vec3 = Vec3::new(1.0, 0.5, 0.25);
const AMBIENT: Vec3 = Vec3::new(0.2, 0.0, 0.0);
const BACKGROUND: Vec3 = Vec3::new(0.0, 0.0, 0.5);

/// On a ball lit along the line of sight N·L = N.z = √(1 − x² − y²).
#[test]
fn a2t2_a_lit_ball_follows_the_cosine() {
    let film = color(&studio(FRONT, &[SUN], &[UNIT_SPHERE]), "");
    for (i, j, x, y) in positions() {
        let rest = 1.0 - x * x - y * y;
        if rest > 0.01 {
            let expected = AMBIENT * KD + KD * rest.sqrt();
            assert!((film.get(i, j) - expected).length() < 1e-4, "{i} {j}");
        } else if rest < 0.0 {
            assert_eq!(film.get(i, j), BACKGROUND, "{i} {j}");
        }
    }
}

/// From behind the light adds nothing, and takes nothing away.
#[test]
fn a2t2_light_from_behind_leaves_the_ambient_part() {
    let back_light = "DirectionalLight { direction 0 0 1 color 1 1 1 }";
    let film = color(&studio(FRONT, &[back_light], &[UNIT_SPHERE]), "");
    assert!(film.pixels().iter().all(|&c| c == BACKGROUND || c == AMBIENT * KD));
    assert_eq!(film.get(30, 30), AMBIENT * KD);
}

#[test]
fn a2t2_lights_add_up() {
    let lamps = [
        "DirectionalLight { direction -1 -1 -1 color 0.9 0 0 }",
        "PointLight { position 2 2 2 color 0 0.8 0 attenuation 0.5 0.1 0.2 }",
        "DirectionalLight { direction 0 1 -3 color 0 0 2 }",
    ];
    let all = color(&studio(PERSPECTIVE, &lamps, &[CUBE]), "");
    let each = lamps.map(|lamp| color(&studio(PERSPECTIVE, &[lamp], &[CUBE]), ""));
    let dark = color(&studio(PERSPECTIVE, &[], &[CUBE]), "");
    for (k, &sum) in all.pixels().iter().enumerate() {
        let [a, b, c] = each.each_ref().map(|film| film.pixels()[k] - dark.pixels()[k]);
        assert!((dark.pixels()[k] + a + b + c - sum).length() < 1e-5);
    }
}

/// A point light over a plane: (h / d) / (a0 + a1·d + a2·d²) with d² = h² + r².
#[test]
fn a2t2_point_lights_fall_off_with_distance() {
    let lamp = "PointLight { position 0.3 0.2 1.5 color 1 1 1 attenuation 0.25 0.5 0.125 }";
    let film = color(&studio(FRONT, &[lamp], &["Plane { normal 0 0 1 offset 0 }"]), "");
    for (i, j, x, y) in positions() {
        let d = Vec3::new(x - 0.3, y - 0.2, 1.5).length();
        let expected = AMBIENT * KD + KD * (1.5 / d / (0.25 + 0.5 * d + 0.125 * d * d));
        assert!((film.get(i, j) - expected).length() < 1e-5, "{i} {j}");
    }
}

/// From inside, a ball is black all over, ambient light included; with -shade_back it is lit as
/// if its normal pointed inwards.
#[test]
fn a2t2_backs_are_black_unless_they_are_to_be_lit() {
    let camera = "PerspectiveCamera { center 0 0 0 direction 0 0 -1 up 0 1 0 angle 60 }";
    let studio = studio(camera, &[SUN], &[UNIT_SPHERE]);
    assert!(color(&studio, "").pixels().iter().all(|&c| c == Vec3::ZERO));
    let lit = color(&studio, "-shade_back");
    let slope = 30f32.to_radians().tan() / 2.0;
    for (i, j, x, y) in positions() {
        let cosine = 1.0 / Vec3::new(x * slope, y * slope, 1.0).length();
        assert!((lit.get(i, j) - (AMBIENT * KD + KD * cosine)).length() < 1e-5, "{i} {j}");
    }
}

/// Which side of a triangle is its front depends on the order of its corners only.
#[test]
fn a2t2_triangles_have_their_front_where_corners_run_counter_clockwise() {
    let front = "Triangle { vertex0 -1 -1 0 vertex1 1 -1 0 vertex2 0 1 0 }";
    let back = "Triangle { vertex0 -1 -1 0 vertex1 0 1 0 vertex2 1 -1 0 }";
    let [lit, black] = [front, back].map(|t| color(&studio(FRONT, &[SUN], &[t]), ""));
    assert!((lit.get(30, 30) - (AMBIENT * KD + KD)).length() < 1e-6);
    assert_eq!(black.get(30, 30), Vec3::ZERO);
    let [a, b] = [front, back].map(|t| color(&studio(FRONT, &[SUN], &[t]), "-shade_back"));
    assert!(difference(&a, &b) < 1e-6);
}

/// -shade_back changes nothing where no back shows.
#[test]
fn a2t2_closed_bodies_look_the_same_with_lit_backs() {
    for object in [CUBE, UNIT_SPHERE, &transformed("Scale 0.3 -1 1", CUBE)] {
        let studio = studio(PERSPECTIVE, &[SUN], &[object]);
        assert_eq!(color(&studio, ""), color(&studio, "-shade_back"));
    }
}

#[test]
fn a2t2_threads_and_tiles_never_change_the_picture() {
    let lamp = "PointLight { position 2 2 2 color 1 0.8 0.5 }";
    let studio =
        studio(PERSPECTIVE, &[SUN, lamp], &[CUBE, UNIT_SPHERE, &transformed("Scale 3 0.2 1", UNIT_SPHERE)]);
    let expected = color(&studio, "-threads 1");
    for flags in ["-threads 2 -tile 1", "-threads 3 -tile 7", "-threads 7 -tile 16", "-threads 16 -tile 60"] {
        assert_eq!(color(&studio, flags), expected, "{flags}");
    }
}

#[test]
fn a2t2_a_command_line_without_pictures_is_refused() {
    assert!(args("").refuse_idleness().is_err_and(|e| e.report().contains("nothing to do") && e.code() == 2));
    for flags in ["-normals n.tga", "-stats", "-output o.tga", "-depth 1 2 d.tga"] {
        assert!(args(flags).refuse_idleness().is_ok(), "{flags}");
    }
    assert_eq!(args("-normals n.tga -depth 1 2 d.tga -output o.tga").outputs().len(), 3);
}
