//! Solid textures: the patterns by their formulas, and what a mixture of materials
//! does with light, mirrors, glass and shadows.

mod support;

use common::math::DVec3;
use oracle::{Model, Options, render};
use support::{close, near, scene, see, see_scene};

/// Materials 0 and 1 are white and black, material 2 is `texture`.
fn materials(texture: &str) -> String {
    format!("Materials {{ numMaterials 3 Material {{ }} Material {{ diffuseColor 0 0 0 }} {texture} }}")
}

const WALL: &str = "Group { numObjects 1 MaterialIndex 2 Plane { normal 0 0 1 offset 0 } }";
fn options(model: Model) -> Options {
    Options { model, ..Options::default() }
}

/// The share of the first material of a texture at the point (x, y, 0).
fn share(texture: &str, x: f64, y: f64) -> f64 {
    let rest = format!("{} {WALL}", materials(texture));
    see(&options(Model::Flat), DVec3::new(x, y, 1.0), -DVec3::Z, &rest).x
}

#[test]
fn checkerboard_alternates_on_both_sides_of_zero() {
    let board = "Checkerboard { Transform { Translate 0 0 0.5 } materialIndex 0 materialIndex 1 }";
    for (x, y, first) in
        [(0.5, 0.5, 1.0), (1.5, 0.5, 0.0), (-0.5, 0.5, 0.0), (-0.5, -0.5, 1.0), (-1.5, 3.5, 0.0)]
    {
        assert_eq!(share(board, x, y), first, "({x}, {y})");
    }
}

/// The list is applied to the point as it stands: Scale 2 makes squares of side ½.
#[test]
fn the_transform_is_not_inverted() {
    let board = "Checkerboard { Transform { Scale 2 2 1 Translate 0.25 0 0.5 }
        materialIndex 0 materialIndex 1 }";
    assert_eq!((share(board, 0.2, 0.1), share(board, 0.3, 0.1), share(board, -0.3, 0.1)), (1.0, 0.0, 0.0));
}

/// A floor between two layers of cubes belongs to the upper one everywhere, however the rays
/// come and their hit points are rounded.
#[test]
fn a_face_between_two_layers_shows_no_specks() {
    let board = "Checkerboard { Transform { YRotate 33 Translate 0 -0.3 0 Scale 1e-6 1 1e-6 Translate 999999 0 999999 }
        materialIndex 0 materialIndex 1 }";
    let text = format!(
        "PerspectiveCamera {{ center 0.1 3.3 7 direction 0 -0.31 -1 up 0 1 0 angle 40 }} {}
         Group {{ numObjects 1 MaterialIndex 2 Plane {{ normal 0 1 0 offset 0.3 }} }}",
        materials(board)
    );
    let picture =
        render(&scene(&text), &Options { width: 64, height: 64, ..options(Model::Flat) }).unwrap().colour;
    let shown: Vec<DVec3> = picture.pixels.into_iter().filter(|p| *p != DVec3::splat(0.5)).collect();
    assert!(shown.len() > 1000 && shown.iter().all(|p| *p == shown[0]), "{} floor pixels", shown.len());
}

#[test]
fn noise_marble_and_wood_are_their_formulas() {
    let with = |name: &str, octaves: u32, rest: &str| {
        format!(
            "{name} {{ Transform {{ Translate 0 0 7 }} materialIndex 0 materialIndex 1 octaves {octaves} {rest} }}"
        )
    };
    // One of Perlin's published values, at 3.14, which is not meant to be π.
    let (x, noise) = (314.0 / 100.0, 0.136_919_958_784_000_12_f64);
    near(share(&with("Noise", 1, ""), x, 42.0), 0.5 + noise, 1e-13);
    near(share(&with("Noise", 1, ""), 3.0, 42.0), 0.5, 1e-13);
    let waves = "frequency 3 amplitude 2";
    near(share(&with("Marble", 1, waves), x, 42.0), ((3.0 * x + 2.0 * noise).sin() + 1.0) / 2.0, 1e-12);
    let radius = f64::hypot(x, 7.0);
    near(share(&with("Wood", 1, waves), x, 42.0), ((3.0 * radius + 2.0 * noise).sin() + 1.0) / 2.0, 1e-12);
    near(share(&with("Marble", 0, waves), 0.4, 0.3), (1.2f64.sin() + 1.0) / 2.0, 1e-13);
}

/// A quarter of the first material, three quarters of the second: sin = −½ at x = 7π/6.
fn quarter(first: &str, second: &str) -> String {
    format!(
        "Materials {{ numMaterials 3 Material {{ {first} }} Material {{ {second} }}
         Marble {{ Transform {{ Translate 3.6651914291880923 0 0 Scale 0 1 1 }}
            materialIndex 0 materialIndex 1 octaves 0 frequency 1 amplitude 0 }} }}"
    )
}

#[test]
fn a_mixture_shades_as_its_parts_do() {
    let lights = "Lights { numLights 1 DirectionalLight { direction 0.6 0 -0.8 color 1 1 1 } }";
    let first = "diffuseColor 1 0.5 0 specularColor 1 1 1 exponent 20";
    let second = "diffuseColor 0 0.5 1 specularColor 0.5 0 0 exponent 2";
    let look = |materials: String| {
        see(&options(Model::Phong), DVec3::Z, -DVec3::Z, &format!("{lights} {materials} {WALL}"))
    };
    let (a, b) = (look(quarter(first, first)), look(quarter(second, second)));
    close(look(quarter(first, second)), 0.25 * a + 0.75 * b, 1e-13);
    assert!((a - b).length() > 0.5);
}

const SKY: &str = "Background { color 1 0.5 0.25 ambientLight 0 0 0 }";

fn traced(options: &Options, materials: &str, group: &str) -> DVec3 {
    let lights = "Lights { numLights 1 DirectionalLight { direction 0 0 1 color 0 0 0 } }";
    let rest = format!("{SKY} {lights} {materials} {group}");
    see(options, DVec3::new(0.0, 3.0, 1.0), DVec3::new(0.0, -3.0, -1.0), &rest)
}

#[test]
fn mirrors_blend_into_one_ray() {
    let whitted = Options { bounces: 1, ..options(Model::Whitted) };
    let mirrors = quarter("reflectiveColor 1 1 1", "reflectiveColor 0 0.5 0");
    let expected = DVec3::new(0.25, 0.625, 0.25) * DVec3::new(1.0, 0.5, 0.25);
    close(traced(&whitted, &mirrors, WALL), expected, 1e-13);
    // The length of the blended colour is 0.718; the first part alone would weigh 0.433.
    for (cut_off, kept) in [(0.7, expected), (0.73, DVec3::ZERO)] {
        close(traced(&Options { weight: cut_off, ..whitted.clone() }, &mirrors, WALL), kept, 1e-13);
    }
}

/// Seen from inside at a grazing angle, glass reflects totally; what does not bend lets through.
#[test]
fn each_index_of_refraction_has_its_ray() {
    let whitted = Options { bounces: 1, ..options(Model::Whitted) };
    let back = WALL.replace("0 0 1 offset", "0 0 -1 offset");
    let glass = quarter(
        "transparentColor 1 1 1 indexOfRefraction 1",
        "transparentColor 0.5 1 1 indexOfRefraction 1.5",
    );
    let sky = DVec3::new(1.0, 0.5, 0.25);
    close(traced(&whitted, &glass, WALL), sky * DVec3::new(0.625, 1.0, 1.0), 1e-13);
    close(traced(&whitted, &glass, &back), sky * 0.25, 1e-13);
    // With Fresnel's equations what is totally reflected comes back as the mirrored ray.
    let fresnel = Options { fresnel: true, ..whitted };
    close(traced(&fresnel, &glass, &back), sky, 1e-13);
}

#[test]
fn absorption_is_the_mean_of_what_the_parts_leave() {
    let whitted = Options { bounces: 2, ..options(Model::Whitted) };
    let clear = "transparentColor 1 1 1";
    let materials = quarter(clear, &format!("{clear} absorption 0.5 1 0"));
    let ball = "Group { numObjects 1 MaterialIndex 2 Sphere { center 0 0 0 radius 1 } }";
    let rest = format!("{SKY} {materials} {ball}");
    let left = |a: f64| 0.25 + 0.75 * (-2.0 * a).exp();
    let expected = DVec3::new(left(0.5), 0.5 * left(1.0), 0.25);
    close(see(&whitted, 3.0 * DVec3::Z, -DVec3::Z, &rest), expected, 1e-8);
}

#[test]
fn shadows_are_tinted_by_the_blend() {
    let through = Options { shadows: true, transparent_shadows: true, ..options(Model::Whitted) };
    let lamp = "Lights { numLights 1 PointLight { position 0 0 2 color 1 1 1 } }";
    let panes = quarter("transparentColor 1 1 0", "transparentColor 0 1 0")
        .replace("numMaterials 3", "numMaterials 4")
        .replace("amplitude 0 }", "amplitude 0 } Material { }");
    let group = "Group { numObjects 2 MaterialIndex 3 Plane { normal 0 0 1 offset 0 }
        MaterialIndex 2 Plane { normal 0 0 1 offset 1 center 0 0 1 radius 0.5 } }";
    let eye = DVec3::new(8.0, 0.0, 1.0);
    let seen = see(&through, eye, -eye, &format!("{lamp} {panes} {group}"));
    close(seen, DVec3::new(0.25, 1.0, 0.0), 1e-8);
}

/// Each of sixty textures blends its predecessor with itself: 2⁶⁰ ways to the bottom.
#[test]
fn a_material_reached_on_many_ways_is_looked_at_once() {
    let mut materials =
        String::from("Materials { numMaterials 62 Material { } Material { diffuseColor 0 0 0 }");
    for k in 2..62 {
        materials += &format!(" Noise {{ materialIndex {} materialIndex {} octaves 2 }}", k - 1, k - 1);
    }
    let group = WALL.replace("MaterialIndex 2", "MaterialIndex 61");
    let seen =
        see(&options(Model::Flat), DVec3::new(0.3, 0.2, 1.0), -DVec3::Z, &format!("{materials} }} {group}"));
    close(seen, DVec3::ZERO, 1e-12);
}

/// Nothing about the plain materials around a texture changes.
#[test]
fn a_texture_of_equal_materials_is_that_material() {
    let text = |material: &str| {
        format!(
            "OrthographicCamera {{ center 0.2 0.3 10 direction 0 0 -1 up 0 1 0 size 4 }} {} {}",
            materials("Noise { materialIndex 0 materialIndex 0 octaves 3 }"),
            WALL.replace("MaterialIndex 2", material)
        )
    };
    let look = |material| see_scene(&options(Model::Whitted), &scene(&text(material)));
    close(look("MaterialIndex 2"), look("MaterialIndex 0"), 1e-15);
}
