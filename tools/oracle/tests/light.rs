//! Ambient, diffuse and highlights against the formulas with numbers put in. Colours are sums
//! of powers of two, so that single precision keeps them.

mod support;

use common::math::DVec3;
use oracle::{Model, Options, Specular};
use support::{close, see};

const AMBIENT: &str = "Background { color 0 0 0.25 ambientLight 0.25 0.5 0.125 }";
/// Seen from above by all tests: the floor z = 0.
const FLOOR: &str = "Group { numObjects 1 MaterialIndex 0 Plane { normal 0 0 1 offset 0 } }";
/// The same from its back.
const CEILING: &str = "Group { numObjects 1 MaterialIndex 0 Plane { normal 0 0 -1 offset 0 } }";

const KD: DVec3 = DVec3::new(0.5, 0.25, 1.0);
const KS: DVec3 = DVec3::new(1.0, 0.5, 0.25);
const LIGHT: DVec3 = DVec3::new(1.0, 0.5, 2.0);

fn material() -> String {
    "Materials { numMaterials 1 Material {
        diffuseColor 0.5 0.25 1 specularColor 1 0.5 0.25 exponent 6 } }"
        .to_owned()
}

fn down(options: &Options, lights: &str, group: &str) -> DVec3 {
    let lights = format!("Lights {{ numLights 1 {lights} }}");
    let rest = format!("{AMBIENT} {lights} {} {group}", material());
    see(options, 5.0 * DVec3::Z, -DVec3::Z, &rest)
}

fn model(model: Model) -> Options {
    Options { model, ..Options::default() }
}

const AMBIENT_PART: DVec3 = DVec3::new(0.125, 0.125, 0.125);
/// Arrives 60° from the normal.
const SLANTED: &str = "DirectionalLight { direction 0.8660254037844386 0 -0.5 color 1 0.5 2 }";

#[test]
fn flat_knows_no_light() {
    for group in [FLOOR, CEILING] {
        assert_eq!(down(&model(Model::Flat), SLANTED, group), KD);
    }
}

#[test]
fn diffuse_is_ambient_plus_lambert() {
    close(down(&model(Model::Diffuse), SLANTED, FLOOR), AMBIENT_PART + 0.5 * LIGHT * KD, 1e-15);
}

#[test]
fn directional_light_from_below_adds_nothing() {
    let below = "DirectionalLight { direction 0 0.1 1 color 1 1 1 }";
    close(down(&model(Model::Phong), below, FLOOR), AMBIENT_PART, 1e-16);
}

#[test]
fn backs_are_black_or_turned_round() {
    for kind in [Model::Diffuse, Model::Phong, Model::Whitted] {
        let front = down(&model(kind), SLANTED, FLOOR);
        assert_eq!(down(&model(kind), SLANTED, CEILING), DVec3::ZERO);
        let both = Options { shade_back: true, ..model(kind) };
        close(down(&both, SLANTED, CEILING), front, 1e-15);
    }
}

#[test]
fn a_miss_shows_the_background() {
    let rest = format!("{AMBIENT} {} {FLOOR}", material());
    for kind in [Model::Flat, Model::Diffuse, Model::Phong, Model::Whitted] {
        assert_eq!(see(&model(kind), DVec3::Z, DVec3::Z, &rest), DVec3::new(0.0, 0.0, 0.25));
    }
}

#[test]
fn half_vector_highlight() {
    // The viewer is on the normal, the light at 60°, so the half vector is at 30°.
    let highlight = KS * 30f64.to_radians().cos().powi(6);
    let expected = AMBIENT_PART + 0.5 * LIGHT * (KD + highlight);
    close(down(&model(Model::Phong), SLANTED, FLOOR), expected, 1e-14);
}

#[test]
fn reflected_vector_highlight() {
    let options = Options { specular: Specular::Phong, ..model(Model::Phong) };
    let expected = AMBIENT_PART + 0.5 * LIGHT * (KD + KS * 0.5f64.powi(6));
    close(down(&options, SLANTED, FLOOR), expected, 1e-14);
}

#[test]
fn both_highlights_are_full_in_the_mirror_direction() {
    let lights = "Lights { numLights 1 DirectionalLight { direction 1 0 -1 color 1 0.5 2 } }";
    let rest = format!("{AMBIENT} {lights} {} {FLOOR}", material());
    for specular in [Specular::Blinn, Specular::Phong] {
        let options = Options { specular, ..model(Model::Phong) };
        let seen = see(&options, DVec3::new(3.0, 0.0, 3.0), DVec3::new(-1.0, 0.0, -1.0), &rest);
        close(seen, AMBIENT_PART + 0.5f64.sqrt() * LIGHT * (KD + KS), 1e-14);
    }
}

#[test]
fn point_light_falls_off_by_its_polynomial() {
    // At distance 5, with cosine 3/5.
    for (coefficients, divisor) in [("", 1.0), ("attenuation 0 0.5 0.25", 8.75), ("attenuation 2 0 0", 2.0)] {
        let light = format!("PointLight {{ position 4 0 3 color 1 0.5 2 {coefficients} }}");
        let expected = AMBIENT_PART + 0.6 / divisor * LIGHT * KD;
        close(down(&model(Model::Diffuse), &light, FLOOR), expected, 1e-15);
    }
}

#[test]
fn negative_falloff_gives_nothing() {
    let light = "PointLight { position 4 0 3 color 1 1 1 attenuation 1 -1 0 }";
    close(down(&model(Model::Diffuse), light, FLOOR), AMBIENT_PART, 0.0);
}

#[test]
fn a_sphere_light_is_a_point_at_its_centre() {
    let point = "PointLight { position 1 2 3 color 1 1 1 attenuation 0 1 0 }";
    let sphere = "SphereLight { center 1 2 3 radius 0.5 color 1 1 1 attenuation 0 1 0 }";
    let options = model(Model::Whitted);
    assert_eq!(down(&options, point, FLOOR), down(&options, sphere, FLOOR));
}

#[test]
fn without_any_light_ambient_is_white() {
    let rest = format!("{} {FLOOR}", material());
    assert_eq!(see(&model(Model::Whitted), DVec3::Z, -DVec3::Z, &rest), KD);
}
