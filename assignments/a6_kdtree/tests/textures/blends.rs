//! A blend is the weighted sum of what its materials would be alone.

use crate::{load, near, rules, scene, somewhere, trace};
use a1_ray_casting::{Mixture, World};
use a4_whitted::{RayKind, Rules};
use common::geometry::Geometry;
use common::math::{DVec3, Vec3};
use common::scene::Scene;
use std::time::Instant;

/// Everything that materials can have, and opposites of each other.
const FIRST: &str = "Material { diffuseColor 0.9 0.1 0.3 specularColor 0.5 0.5 0.5 exponent 8
    reflectiveColor 0.4 0 0.1 transparentColor 0.2 0.6 0.1 indexOfRefraction 1.5 absorption 0.3 0.2 0.1 }";
const SECOND: &str = "Material { diffuseColor 0.2 0.7 0.6 specularColor 0 0.2 0.9 exponent 2
    reflectiveColor 0 0.3 0.2 transparentColor 0.5 0.1 0.4 indexOfRefraction 1.5 }";
/// 0.3 of the first, whatever the point: the noise has no octaves, the sine no distance.
const BLEND: &str = "Marble { materialIndex 0 materialIndex 1 octaves 0 frequency 0 amplitude 0 }";

/// A ball of one material in a coloured room with two lamps, one behind a pillar.
fn room(materials: &[&str], material: usize) -> Scene {
    scene(&format!(
        "Background {{ color 0.1 0.4 0.8 ambientLight 0.2 0.3 0.1 }}
         Lights {{ numLights 2 DirectionalLight {{ direction -1 -1 -1 color 0.8 0.7 0.6 }}
             PointLight {{ position -4 5 3 color 0.3 0.5 0.4 }} }}
         Materials {{ numMaterials {} {} Material {{ diffuseColor 0.5 0.9 0.5 }} }}
         Group {{ numObjects 3 MaterialIndex {material} Sphere {{ center 0 0 0 radius 1 }}
             MaterialIndex {} Plane {{ normal 0 1 0 offset -2 }} Sphere {{ center -2 2.5 1.5 radius 0.5 }} }}",
        materials.len() + 1,
        materials.join(" "),
        materials.len(),
    ))
}

fn views() -> impl Iterator<Item = (Vec3, Vec3)> {
    (0..40).map(|i| {
        let (s, c) = (i as f32 * 0.37).sin_cos();
        (Vec3::new(4.0 * s, 1.0, 4.0 * c), Vec3::new(0.6 * c, 0.7 * s * c, -0.5 * s))
    })
}

/// Half of each: the sum of the two pictures, with every kind of light, as long as no ray meets
/// two mixed surfaces.
#[test]
fn a6t3_half_and_half_is_the_mean_of_the_pictures() {
    let rules = Rules { shadows: true, ..rules(0) };
    let [one, two, both] =
        [(&[FIRST][..], 0), (&[SECOND], 0), (&[FIRST, SECOND, BLEND], 2)].map(|(list, i)| room(list, i));
    for (origin, target) in views() {
        let [a, b, mixed] = [&one, &two, &both].map(|s| trace(s, rules, origin, target));
        assert!(near(mixed.color, (a.color + b.color) / 2.0), "{} {} {}", mixed.color, a.color, b.color);
        assert_eq!(mixed.counters.shadow_rays, a.counters.shadow_rays, "one ray for a light, not two");
    }
}

/// One mirrored ray of the mean colour, one refracted ray if both bend alike.
#[test]
fn a6t3_secondary_rays_of_a_blend() {
    let [one, two, both] =
        [(&[FIRST][..], 0), (&[SECOND], 0), (&[FIRST, SECOND, BLEND], 2)].map(|(list, i)| room(list, i));
    // At depth 1 nothing has come through the ball yet that could be absorbed twice.
    for (origin, target) in views() {
        let [a, b, mixed] = [&one, &two, &both].map(|s| trace(s, rules(1), origin, target));
        let kinds = |t: &crate::Traced| t.tree.nodes.iter().map(|n| n.kind).collect::<Vec<_>>();
        assert_eq!(kinds(&mixed), kinds(&a));
        let weights: Vec<f32> = mixed.tree.nodes.iter().skip(1).map(|n| n.share.x).collect();
        let (kr, kt) = (Vec3::new(0.2, 0.15, 0.15), Vec3::new(0.35, 0.35, 0.25));
        assert!((weights[0] - kr.length()).abs() < 1e-6 && (weights[1] - kt.length()).abs() < 1e-6);
        // The inside of the ball is mixed once more where the refracted ray arrives.
        assert!(mixed.color.is_finite() && b.color.is_finite());
    }
}

#[test]
fn a6t3_each_index_of_refraction_has_its_ray() {
    let dense = SECOND.replace("1.5", "2.4");
    let world = room(&[FIRST, &dense, BLEND], 2);
    let traced = trace(&world, rules(1), Vec3::new(0.3, 0.2, 5.0), Vec3::ZERO);
    let kinds: Vec<RayKind> = traced.tree.nodes.iter().map(|n| n.kind).collect();
    assert_eq!(kinds, [RayKind::Camera, RayKind::Mirrored, RayKind::Refracted, RayKind::Refracted]);
    let weights: Vec<f32> = traced.tree.nodes[2..].iter().map(|n| n.share.x).collect();
    let expected = [Vec3::new(0.1, 0.3, 0.05).length(), Vec3::new(0.25, 0.05, 0.2).length()];
    let close = |w: &[f32]| w.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6);
    assert!(close(&weights) || close(&[weights[1], weights[0]]), "{weights:?}");
}

/// Looking straight at glass of index 1.5, 0.04 are mirrored; half of that of a half of glass,
/// and all that the opaque half mirrors.
#[test]
fn a6t3_fresnel_counts_for_the_transparent_part() {
    let opaque = "Material { reflectiveColor 0.4 0.4 0.4 }";
    let glass = "Material { transparentColor 1 1 1 indexOfRefraction 1.5 reflectiveColor 9 9 9 }";
    let world = room(&[opaque, glass, BLEND], 2);
    let rules = Rules { fresnel: true, ..rules(1) };
    let traced = trace(&world, rules, Vec3::new(0.0, 0.0, 5.0), Vec3::ZERO);
    let weight = |kind| {
        let mut of_kind = traced.tree.nodes.iter().filter(|n| n.kind == kind);
        of_kind.next().map(|n| n.share.x).unwrap_or_default()
    };
    let white = 3f32.sqrt();
    assert!((weight(RayKind::Mirrored) - (0.2 + 0.5 * 0.04) * white).abs() < 1e-5);
    assert!((weight(RayKind::Refracted) - 0.5 * 0.96 * white).abs() < 1e-5);
}

#[test]
fn a6t3_the_cut_off_weight_looks_at_the_merged_color() {
    let world =
        room(&["Material { reflectiveColor 0.4 0 0 }", "Material { reflectiveColor 0 0.3 0 }", BLEND], 2);
    let rays = |min_weight| {
        let rules = Rules { min_weight, ..rules(1) };
        trace(&world, rules, Vec3::Z * 5.0, Vec3::ZERO).counters.rays
    };
    assert_eq!([rays(0.249), rays(0.251)], [2, 1], "the length of (0.2, 0.15, 0) is 0.25");
}

/// Light passes a checkerboard of glass and lead where it is glass.
#[test]
fn a6t3_transparent_shadows_have_the_pattern() {
    let world = scene(
        "Background { ambientLight 0 0 0 } Lights { numLights 1 DirectionalLight { direction 0 -1 0 color 1 1 1 } }
         Materials { numMaterials 4 Material { transparentColor 0.5 1 0.25 } Material { diffuseColor 0 0 0 }
             Checkerboard { materialIndex 0 materialIndex 1 } Material { } }
         Group { numObjects 2 MaterialIndex 2 Plane { normal 0 1 0 offset 1 }
             MaterialIndex 3 Plane { normal 0 1 0 offset 0 } }",
    );
    let rules = Rules { shadows: true, transparent_shadows: true, ..rules(0) };
    let floor = |x: f32| trace(&world, rules, Vec3::new(x, 0.5, 0.0), Vec3::new(x, 0.0, 0.5)).color;
    assert_eq!([floor(0.5), floor(1.5)], [Vec3::ZERO, Vec3::new(0.5, 1.0, 0.25)]);
    assert_eq!(floor(-0.5), Vec3::new(0.5, 1.0, 0.25));
}

/// A ray that goes through a block of a blend loses the mean of what both would take.
#[test]
fn a6t3_absorption_is_the_mean_of_what_is_left() {
    let clear = "Material { transparentColor 1 1 1 diffuseColor 0 0 0 }";
    let murky = "Material { transparentColor 1 1 1 diffuseColor 0 0 0 absorption 0.5 1 2 }";
    let world = scene(&format!(
        "Background {{ color 1 1 1 }} Materials {{ numMaterials 3 {clear} {murky} {BLEND} }}
         Group {{ numObjects 1 MaterialIndex 2 Sphere {{ center 0 0 0 radius 1 }} }}"
    ));
    let color = trace(&world, rules(2), Vec3::Z * 5.0, Vec3::ZERO).color;
    let expected = Vec3::new(-1.0, -2.0, -4.0).exp().lerp(Vec3::ONE, 0.5);
    assert!(near(color, expected), "{color} {expected}");
}

/// Each texture blends the two before it: the number of paths is that of Fibonacci, 4 · 10¹² for
/// sixty.
#[test]
fn a6t3_sixty_nested_textures_take_no_time() {
    let textures: Vec<String> = (0..60)
        .map(|i| {
            let (frequency, amplitude) = (1.0 + 0.1 * f64::from(i), 2.0);
            let [first, second] = [i, i + 1];
            format!(
                "Wood {{ materialIndex {first} materialIndex {second} octaves 2
                    frequency {frequency} amplitude {amplitude} }}"
            )
        })
        .collect();
    let materials = format!("{FIRST} {SECOND} {}", textures.join(" "));
    let world = scene(&format!(
        "Materials {{ numMaterials 62 {materials} }}
         Group {{ numObjects 1 MaterialIndex 61 Sphere {{ center 0 0 0 radius 1 }} }}"
    ));
    let geometry = Geometry::build(&world).unwrap();
    let textured = load(&world, &geometry).unwrap();
    let started = Instant::now();
    for i in 0..1000 {
        let point = DVec3::new(0.37, 0.59, -0.83) * f64::from(i);
        let mixture = textured.at(&somewhere(point, 61));
        let total: f32 = mixture.parts().map(|(weight, _)| weight).sum();
        assert!((total - 1.0).abs() < 1e-5 && mixture.parts().count() <= 2);
    }
    assert!(started.elapsed().as_secs() < 2, "{:?}", started.elapsed());
}

#[test]
fn a6t3_a_square_of_a_checkerboard_is_its_material_itself() {
    let world = scene(
        "Materials { numMaterials 3 Material { diffuseColor 1 0 0 } Material { } Checkerboard {
             materialIndex 0 materialIndex 1 } } Group { numObjects 0 }",
    );
    let geometry = Geometry::build(&world).unwrap();
    let textured = load(&world, &geometry).unwrap();
    assert!(textured.plain(0).is_some() && textured.plain(2).is_none());
    let at = |x: f64| textured.at(&somewhere(DVec3::new(x, 0.5, 0.5), 2));
    assert_eq!(at(0.5), Mixture::Plain(textured.plain(0).unwrap()));
    assert_eq!(at(1.5), Mixture::Plain(textured.plain(1).unwrap()));
}
