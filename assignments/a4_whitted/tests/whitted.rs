//! Shadows, mirrors and the ray tree against what pen and paper say.

mod world;

use a4_whitted::{RayKind, Rules};
use common::math::Vec3;
use common::scene::Scene;
use world::{near, rules, scene, trace};

fn shadows() -> Rules {
    Rules { shadows: true, ..rules(0) }
}

/// A white floor at y = 0 under one light, and a ball of some material somewhere.
fn floor_and_ball(light: &str, ball: Vec3, material: &str) -> Scene {
    scene(&format!(
        "Background {{ color 0 0 0 }} Lights {{ numLights 1 {light} }}
         Materials {{ numMaterials 2 Material {{ }} Material {{ {material} }} }}
         Group {{ numObjects 2 MaterialIndex 0 Plane {{ normal 0 1 0 offset 0 }}
            MaterialIndex 1 Sphere {{ center {} {} {} radius 0.5 }} }}",
        ball.x, ball.y, ball.z
    ))
}

/// The colour of the floor at the origin, seen from the side.
fn floor_color(scene: &Scene, rules: Rules) -> Vec3 {
    trace(scene, rules, Vec3::new(3.0, 1.0, 0.0), Vec3::new(-3.0, -1.0, 0.0)).color
}

const LAMP: &str = "PointLight { position 0 4 0 color 1 0.5 0.25 }";

#[test]
fn a4t1_what_stands_between_casts_a_shadow_and_what_stands_behind_the_lamp_does_not() {
    let lit = Vec3::new(1.0, 0.5, 0.25);
    let with_ball_at = |y: f32| floor_color(&floor_and_ball(LAMP, Vec3::Y * y, ""), shadows());
    assert_eq!(with_ball_at(2.0), Vec3::ZERO);
    assert!(near(with_ball_at(6.0), lit), "the lamp is before the ball");
    assert!(near(with_ball_at(-2.0), lit), "the ball is below the floor");
    let off = floor_color(&floor_and_ball(LAMP, Vec3::Y * 2.0, ""), rules(0));
    assert!(near(off, lit), "without -shadows nothing casts one");
}

#[test]
fn a4t1_parallel_light_is_blocked_at_any_distance() {
    let sun = "DirectionalLight { direction 0 -1 0 color 1 1 1 }";
    for y in [1.0, 1000.0] {
        assert_eq!(floor_color(&floor_and_ball(sun, Vec3::Y * y, ""), shadows()), Vec3::ZERO);
    }
}

/// A lit ball does not shadow itself, out to where the light grazes it.
#[test]
fn a4t1_no_acne() {
    let sun = "DirectionalLight { direction 0 -1 0 color 1 1 1 }";
    let world = floor_and_ball(sun, Vec3::Y * 1000.0, "");
    for i in 0..1000 {
        let x = 0.4999 * (i as f32 / 1000.0);
        let seen = trace(&world, shadows(), Vec3::new(x, 1010.0, 0.0), -Vec3::Y);
        let cosine = (0.25 - x * x).sqrt() / 0.5;
        assert!((seen.color.x - cosine).abs() < 2e-3 && seen.color.x > 0.0, "{x}: {} {cosine}", seen.color.x);
    }
}

/// Light enters and leaves the ball: two surfaces, so the square of its colour.
#[test]
fn a4t1_transparent_shadows_take_the_colour_of_every_surface() {
    let glass = "transparentColor 0.5 0.25 1";
    let world = floor_and_ball("PointLight { position 0 4 0 color 1 1 1 }", Vec3::Y * 2.0, glass);
    assert_eq!(floor_color(&world, shadows()), Vec3::ZERO, "without the flag glass is as dark as stone");
    let through = floor_color(&world, Rules { transparent_shadows: true, ..shadows() });
    assert!(near(through, Vec3::new(0.25, 0.0625, 1.0)), "{through}");
}

#[test]
fn a4t1_needless_shadow_rays_are_counted_and_change_nothing() {
    let behind = floor_and_ball("DirectionalLight { direction 0 1 0 color 1 1 1 }", Vec3::Y * 9.0, "");
    let look = |rules| trace(&behind, rules, Vec3::new(3.0, 1.0, 0.0), Vec3::new(-3.0, -1.0, 0.0));
    let (skipped, asked) = (look(shadows()), look(Rules { skip_behind: false, ..shadows() }));
    assert_eq!((skipped.counters.shadow_rays, skipped.counters.skipped_shadow_behind), (0, 1));
    assert_eq!((asked.counters.shadow_rays, asked.counters.skipped_shadow_behind), (1, 0));
    assert_eq!(skipped.color, asked.color);
}

/// Two mirrors face each other across a corridor of width 2.
fn corridor(material: &str) -> Scene {
    scene(&format!(
        "Background {{ color 0 0 0 ambientLight 1 1 1 }} Materials {{ numMaterials 1 Material {{ {material} }} }}
         Group {{ numObjects 2 MaterialIndex 0
            Plane {{ normal -1 0 0 offset -1 }} Plane {{ normal 1 0 0 offset -1 }} }}"
    ))
}

/// Each mirror adds its own colour, halved with every bounce: a geometric series. Also the rule
/// of depth: n bounces are n + 1 rays.
#[test]
fn a4t2_corridor_of_mirrors() {
    let world = corridor("diffuseColor 0.25 0.5 0.125 reflectiveColor 0.5 0.5 0.5");
    let own = Vec3::new(0.25, 0.5, 0.125);
    for bounces in [0, 1, 5, 20] {
        let traced = trace(&world, rules(bounces), Vec3::ZERO, Vec3::X);
        let series: f32 = (0..=bounces).map(|k| 0.5f32.powi(k as i32)).sum();
        assert!(near(traced.color, own * series), "{bounces} bounces: {}", traced.color);
        assert_eq!(traced.counters.rays, u64::from(bounces) + 1);
        let lengths = traced.tree.nodes.iter().map(|n| n.hit.expect("a mirror").t);
        assert!(lengths.skip(1).all(|t| (t - 2.0).abs() < 1e-5));
    }
}

/// Weights are 1, ½, ¼, ⅛, then 1/16 falls below a tenth.
#[test]
fn a4t2_weight_cuts_off() {
    let world = corridor("reflectiveColor 0.5 0 0");
    let traced = trace(&world, Rules { min_weight: 0.1, ..rules(50) }, Vec3::ZERO, Vec3::X);
    let weights: Vec<f32> = traced.tree.nodes.iter().map(|n| n.share.x).collect();
    assert_eq!(weights, [1.0, 0.5, 0.25, 0.125]);
    assert_eq!(traced.counters.skipped_below_weight, 1);
    let at_the_limit = trace(&world, Rules { min_weight: 0.125, ..rules(50) }, Vec3::ZERO, Vec3::X);
    assert_eq!(at_the_limit.tree.nodes.len(), 4, "a weight equal to the cut-off is kept");
}

/// The weight of a colour is its Euclidean length, so (0.6 0.8 0) never fades.
#[test]
fn a4t2_weight_is_the_length_of_the_colour() {
    let world = corridor("reflectiveColor 0.6 0.8 0");
    let traced = trace(&world, Rules { min_weight: 0.99, ..rules(8) }, Vec3::ZERO, Vec3::X);
    assert_eq!(traced.counters.rays, 9);
}

/// Parents come before children, shadow rays have no children, and the counters count the tree.
#[test]
fn a4t4_the_tree_is_what_was_traced() {
    let world = scene(
        "Background { color 0.2 0.3 0.4 }
         Lights { numLights 2 PointLight { position 0 9 3 color 1 1 1 } DirectionalLight { direction 1 -1 -1 color 1 1 1 } }
         Materials { numMaterials 2 Material { reflectiveColor 0.5 0.5 0.5 transparentColor 0.5 0.5 0.5
            indexOfRefraction 1.3 } Material { reflectiveColor 0.3 0.3 0.3 } }
         Group { numObjects 2 MaterialIndex 0 Sphere { center 0 0 0 radius 1 }
            MaterialIndex 1 Plane { normal 0 1 0 offset -1.5 } }",
    );
    let traced = trace(&world, Rules { shadows: true, ..rules(4) }, Vec3::new(0.2, 0.5, 5.0), -Vec3::Z);
    let nodes = &traced.tree.nodes;
    assert_eq!((nodes[0].parent, nodes[0].kind), (0, RayKind::Camera));
    for (i, node) in nodes.iter().enumerate().skip(1) {
        assert!(node.parent < i, "ray {i} was traced before its parent");
        assert!(nodes[node.parent].kind != RayKind::Shadow && nodes[node.parent].hit.is_some());
        assert!(node.kind != RayKind::Camera);
    }
    let shadow = nodes.iter().filter(|n| n.kind == RayKind::Shadow).count() as u64;
    assert_eq!(shadow, traced.counters.shadow_rays);
    assert_eq!(nodes.len() as u64 - shadow, traced.counters.rays);
    for kind in [RayKind::Mirrored, RayKind::Refracted, RayKind::Shadow] {
        assert!(nodes.iter().any(|n| n.kind == kind), "no {kind:?}");
    }
    let text = traced.tree.to_string();
    assert_eq!(text.lines().count(), nodes.len());
    assert!(text.starts_with("camera from (0.20000 0.50000 5.00000)"), "{text}");
    let deepest = text.lines().map(|l| l.len() - l.trim_start().len()).max();
    assert_eq!(deepest, Some(2 * 5), "four bounces and a shadow ray, two blanks each");
}
