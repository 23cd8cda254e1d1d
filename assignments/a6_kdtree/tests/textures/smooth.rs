//! Smooth meshes: round to look at, and no light where none can be.

use crate::{Traced, rules, scene, trace};
use a4_whitted::{RayKind, Rules};
use common::math::Vec3;
use common::scene::Scene;

/// A ball of flat triangles, shaded round, in light that falls straight down.
fn ball(material: &str, more: &str) -> Scene {
    scene(&format!(
        "Background {{ color 0.2 0.4 0.6 ambientLight 0 0 0 }}
         Lights {{ numLights 1 DirectionalLight {{ direction 0 -1 0 color 1 1 1 }} }}
         Materials {{ numMaterials 1 Material {{ {material} }} }}
         Group {{ numObjects {} MaterialIndex 0 TriangleMesh {{ obj_file ball smooth 1 }} {more} }}",
        1 + more.matches('{').count()
    ))
}

/// Rays from all around to points in and around the ball, many of them grazing.
fn sights() -> impl Iterator<Item = (Vec3, Vec3)> {
    (0..3000).map(|i| {
        let (a, b) = (i as f32 * 0.61, i as f32 * 0.23);
        let from = Vec3::new(a.sin() * b.cos(), b.sin(), a.cos() * b.cos()) * 4.0;
        let aside = from.cross(Vec3::new(b, 1.0, a)).normalize();
        (from, aside * (0.999 * (i as f32 * 0.417).fract()))
    })
}

fn hits(traced: &Traced) -> bool {
    traced.tree.nodes[0].hit.is_some()
}

#[test]
fn a6t4_light_is_that_of_a_ball() {
    let world = ball("", "");
    for (origin, target) in sights() {
        let traced = trace(&world, rules(0), origin, target);
        if let Some(hit) = traced.tree.nodes[0].hit {
            let p = traced.tree.nodes[0].ray.at(f64::from(hit.t)).normalize();
            let (light, expected) = (traced.color.x, p.y.max(0.0) as f32);
            // A facet is up to 8° off the ball; shaded flat the light would be 0.13 off.
            let lit = p.y > 0.2 || p.y < -0.2;
            assert!(!lit || (light - expected).abs() < 0.03, "{p} {light}");
        }
    }
}

/// No triangle whose back is turned to the lamp gets light. The ball is convex, so that is all
/// the shadow it has: casting shadow rays changes nothing.
#[test]
fn a6t4_no_light_from_behind_the_facets() {
    let world = ball("", "");
    let shadowed = Rules { shadows: true, ..rules(0) };
    for (origin, target) in sights() {
        let [free, dark] = [rules(0), shadowed].map(|rules| trace(&world, rules, origin, target));
        assert_eq!(free.color, dark.color, "{origin} {target}");
    }
}

/// A mirrored ray off a closed convex mirror meets it never again.
#[test]
fn a6t4_a_smooth_mirror_lets_nothing_in() {
    let world = ball("diffuseColor 0 0 0 reflectiveColor 1 1 1", "");
    let sky = Vec3::new(0.2, 0.4, 0.6);
    for (origin, target) in sights() {
        let traced = trace(&world, rules(5), origin, target);
        let mirrored = traced.tree.nodes.iter().filter(|n| n.kind == RayKind::Mirrored).count();
        assert_eq!(mirrored, usize::from(hits(&traced)));
        assert_eq!(traced.color, sky, "{origin} {target}");
    }
}

/// In glass every refracted ray changes sides and every mirrored one stays.
#[test]
fn a6t4_smooth_glass_has_an_inside_and_an_outside() {
    let world = ball(
        "diffuseColor 0 0 0 reflectiveColor 0.5 0.5 0.5 transparentColor 1 1 1 indexOfRefraction 1.5",
        "",
    );
    let rules = Rules { min_weight: 0.2, ..rules(4) };
    for (origin, target) in sights().step_by(7) {
        let tree = trace(&world, rules, origin, target).tree;
        let mut inside = vec![false; tree.nodes.len()];
        for (i, node) in tree.nodes.iter().enumerate().skip(1) {
            let before = inside[node.parent];
            inside[i] = if node.kind == RayKind::Refracted { !before } else { before };
            // Whoever is inside a closed body meets it; whoever is outside a convex one, never.
            assert_eq!(node.hit.is_some(), inside[i], "{tree}");
        }
    }
}
