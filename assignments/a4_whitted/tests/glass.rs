//! Glass against what pen and paper say.

mod world;

use a4_whitted::{RayKind, Rules};
use common::math::Vec3;
use common::scene::Scene;
use world::{near, rules, scene, trace};

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
        assert_eq!(
            traced.tree.nodes.iter().map(|n| n.kind).collect::<Vec<_>>(),
            [RayKind::Camera, RayKind::Refracted, RayKind::Refracted],
            "{degrees}"
        );
        assert_eq!(traced.counters.rays, 3);
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
