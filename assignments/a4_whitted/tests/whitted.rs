//! Assignment 4 against what pen and paper say.

use a1_ray_casting::Sight;
use a2_transforms::LocalLight;
use a3_phong::Phong;
use a4_whitted::{RayKind, RayTree, Rules, Whitted};
use common::accel::{Accel, List};
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::{Interval, Vec3};
use common::mesh::{Mesh, MeshError};
use common::ray::Ray;
use common::scene::{MeshSource, Scene, parse_str};
use std::sync::Arc;

struct NoMesh;

impl MeshSource for NoMesh {
    fn mesh(&mut self, name: &str) -> Result<Arc<Mesh>, MeshError> {
        Err(MeshError::new(format!("no mesh `{name}` here")))
    }
}

/// A scene from its blocks; the camera is not used.
fn scene(blocks: &str) -> Scene {
    let camera = "PerspectiveCamera { center 0 0 5 direction 0 0 -1 up 0 1 0 angle 40 }";
    parse_str("a4.txt", &format!("{camera} {blocks}"), &mut NoMesh).unwrap_or_else(|e| panic!("{e}"))
}

/// What came back along one ray.
struct Traced {
    color: Vec3,
    tree: RayTree,
    counters: Counters,
}

impl Traced {
    fn kinds(&self) -> Vec<RayKind> {
        self.tree.nodes.iter().map(|n| n.kind).collect()
    }
}

fn trace(scene: &Scene, rules: Rules, origin: Vec3, direction: Vec3) -> Traced {
    let geometry = Geometry::build(scene).unwrap_or_else(|e| panic!("{e}"));
    let list = List::new(&geometry);
    let light = LocalLight { scene, shade_back: true };
    let whitted = Whitted { scene, accel: &list, light, phong: Phong::default(), rules };
    let (mut counters, mut tree) = (Counters::default(), RayTree::default());
    let ray = Ray::new(origin, direction.normalize());
    counters.rays += 1;
    let hit = list.nearest(&ray, Interval::FORWARD, &mut counters);
    let color = whitted.radiance(&Sight::new(&geometry, ray, hit), &mut counters, &mut tree);
    Traced { color, tree, counters }
}

fn near(a: Vec3, b: Vec3) -> bool {
    (a - b).abs().max_element() < 1e-5
}

fn rules(bounces: u32) -> Rules {
    Rules { bounces, skip_behind: true, skip_dark: true, skip_black: true, ..Rules::default() }
}

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

/// A slab of index n between y = −1 and y = 0, seen against a white background.
fn slab(ior: f32, more: &str) -> Scene {
    scene(&format!(
        "Background {{ color 1 1 1 }} Lights {{ numLights 1 PointLight {{ position 0 9 0 color 0 0 0 }} }}
         Materials {{ numMaterials 1 Material {{ diffuseColor 0 0 0 transparentColor 1 1 1
            indexOfRefraction {ior} {more} }} }}
         Group {{ numObjects 2 MaterialIndex 0
            Plane {{ normal 0 1 0 offset 0 }} Plane {{ normal 0 -1 0 offset 1 }} }}"
    ))
}

/// Snell: the ray leaves as it came, moved by tan θ − tan θ' times the thickness.
#[test]
fn a4t3_a_slab_shifts_the_ray() {
    for (degrees, ior) in [(0.0f64, 1.5), (30.0, 1.5), (60.0, 1.1), (45.0, 2.4), (20.0, 0.8)] {
        let (s, c) = degrees.to_radians().sin_cos();
        let direction = Vec3::new(s as f32, -c as f32, 0.0);
        let traced = trace(&slab(ior as f32, ""), rules(2), -direction, direction);
        assert_eq!(traced.kinds(), [RayKind::Camera, RayKind::Refracted, RayKind::Refracted], "{degrees}");
        let last = traced.tree.nodes[2].ray;
        let inside = (s / f64::from(ior as f32)).asin();
        let expected = Vec3::new(inside.tan() as f32, -1.0, 0.0);
        assert!(near(last.origin, expected) && near(last.direction, direction), "{last:?}, {expected}");
        assert!(near(traced.color, Vec3::ONE), "{}", traced.color);
    }
}

/// Inside glass, beyond the critical angle, nothing gets out and without a mirror colour
/// nothing goes on; the surface itself is black.
#[test]
fn a4t3_total_internal_reflection_adds_nothing() {
    let critical = (1.0f32 / 1.5).asin();
    let up = |angle: f32| Vec3::new(angle.sin(), angle.cos(), 0.0);
    let from = |angle| trace(&slab(1.5, ""), rules(5), Vec3::new(0.0, -0.5, 0.0), up(angle));
    assert!(near(from(critical - 0.01).color, Vec3::ONE));
    let beyond = from(critical + 0.01);
    assert_eq!((beyond.color, beyond.tree.nodes.len()), (Vec3::ZERO, 1));
}

/// Light loses a factor e^(−a·x) on its way through, per colour: Beer and Lambert.
#[test]
fn a4t3_absorption() {
    let world = slab(1.0, "absorption 1 2 0.5");
    for x in [1.0f32, 2.0] {
        // Straight down through thickness 1, or at 60° through 2.
        let cos = 1.0 / x;
        let direction = Vec3::new((1.0 - cos * cos).sqrt(), -cos, 0.0);
        let color = trace(&world, rules(2), -direction, direction).color;
        assert!(near(color, Vec3::new((-x).exp(), (-2.0 * x).exp(), (-0.5 * x).exp())), "{x}: {color}");
    }
}

/// Glass that shares its light by Fresnel neither makes nor, given enough bounces, loses any.
#[test]
fn a4t3_fresnel_keeps_the_energy() {
    let world = scene(
        "Background { color 1 1 1 } Lights { numLights 1 PointLight { position 0 9 0 color 0 0 0 } }
         Materials { numMaterials 1 Material { diffuseColor 0 0 0 transparentColor 1 1 1 indexOfRefraction 1.5 } }
         Group { numObjects 1 MaterialIndex 0 Sphere { center 0 0 0 radius 1 } }",
    );
    for i in 0..100 {
        let x = i as f32 / 100.0;
        let look = |bounces| {
            trace(&world, Rules { fresnel: true, ..rules(bounces) }, Vec3::new(x, 0.0, 3.0), -Vec3::Z).color.x
        };
        let (few, many) = (look(3), look(16));
        assert!(few <= many + 1e-6 && many <= 1.0 + 1e-5, "{x}: {few} {many}");
        assert!(many > 0.9, "{x}: {many}");
    }
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
