//! Mirrors, refraction, Fresnel and absorption against optics.

mod support;

use common::math::DVec3;
use oracle::{Options, fresnel_reflectance, mirror, refract};
use support::{Random, close, near, see};

const SKY: &str = "Background { color 0.25 0.5 1 ambientLight 0 0 0 }";
const SKY_COLOR: DVec3 = DVec3::new(0.25, 0.5, 1.0);
const BALL: &str = "Group { numObjects 1 MaterialIndex 0 Sphere { center 0 0 0 radius 2 } }";

fn bounces(bounces: u32) -> Options {
    Options { bounces, ..Options::default() }
}

/// The middle of a black ball of radius 2 with these other properties, from far away.
fn ball(options: &Options, material: &str) -> DVec3 {
    let materials = format!("Materials {{ numMaterials 1 Material {{ {BLACK} {material} }} }}");
    // A light, so that the ambient light is not white by default.
    see(options, 9.0 * DVec3::Z, -DVec3::Z, &format!("{SKY} {materials} {BALL}"))
}

const BLACK: &str = "diffuseColor 0 0 0";

#[test]
fn snell_holds_on_both_sides() {
    let mut random = Random(6);
    for _ in 0..1000 {
        let (incoming, normal) = (random.direction(), random.direction());
        let index = 1.0 + random.unit();
        let sine = |v: DVec3| v.cross(normal).length();
        let leaving = incoming.dot(normal) > 0.0;
        let (before, after) = if leaving { (index, 1.0) } else { (1.0, index) };
        match refract(incoming, normal, index) {
            Some(out) => {
                near(before * sine(incoming), after * sine(out), 1e-12);
                near(out.dot(incoming.cross(normal)), 0.0, 1e-12);
                assert_eq!(out.dot(normal) > 0.0, leaving);
                near(out.length(), 1.0, 1e-15);
            }
            None => assert!(leaving && index * sine(incoming) > 1.0 - 1e-12),
        }
        let mirrored = mirror(incoming, normal);
        near(mirrored.dot(normal), -incoming.dot(normal), 1e-15);
        close(mirrored.cross(normal), incoming.cross(normal), 1e-15);
    }
}

#[test]
fn fresnel_at_angles_that_are_known() {
    near(fresnel_reflectance(-DVec3::Z, DVec3::Z, 1.5), 0.04, 1e-15);
    near(fresnel_reflectance(DVec3::Z, DVec3::Z, 1.5), 0.04, 1e-15);
    near(fresnel_reflectance(-DVec3::Z, DVec3::Z, 1.0), 0.0, 1e-15);
    near(fresnel_reflectance(DVec3::X, DVec3::Z, 1.5), 1.0, 1e-12);
    // Brewster's angle tan θ = n: one polarisation is not reflected at all, the other by
    // ((n² − 1)/(n² + 1))².
    let brewster = DVec3::new(1.5, 0.0, -1.0).normalize();
    near(fresnel_reflectance(brewster, DVec3::Z, 1.5), (1.25f64 / 3.25).powi(2) / 2.0, 1e-15);
    // Beyond the critical angle asin(1/1.5) = 41.8°.
    let steep = DVec3::new(1.0, 0.0, 1.0).normalize();
    assert_eq!(fresnel_reflectance(steep, DVec3::Z, 1.5), 1.0);
    assert_eq!(refract(steep, DVec3::Z, 1.5), None);
}

#[test]
fn fresnel_is_the_same_in_both_directions() {
    let mut random = Random(7);
    for _ in 0..1000 {
        let into = random.direction();
        let into = DVec3::new(into.x, into.y, -into.z.abs());
        let out = -refract(into, DVec3::Z, 1.7).expect("entering always works");
        let there = fresnel_reflectance(into, DVec3::Z, 1.7);
        near(there, fresnel_reflectance(out, DVec3::Z, 1.7), 1e-11);
    }
}

#[test]
fn a_mirror_shows_the_sky() {
    let chrome = "reflectiveColor 0.5 1 0.25";
    assert_eq!(ball(&bounces(0), chrome), DVec3::ZERO);
    close(ball(&bounces(1), chrome), SKY_COLOR * DVec3::new(0.5, 1.0, 0.25), 1e-15);
    close(ball(&bounces(7), chrome), SKY_COLOR * DVec3::new(0.5, 1.0, 0.25), 1e-15);
}

/// Two mirrors face to face: the colour is d·Σ kᵏ over the surfaces reached.
fn corridor(options: &Options) -> f64 {
    let rest = "Background { ambientLight 1 1 1 } Materials { numMaterials 1
        Material { diffuseColor 0.125 0.125 0.125 reflectiveColor 0.5 0.5 0.5 } }
        Group { numObjects 2 MaterialIndex 0
        Plane { normal 0 0 1 offset -1 } Plane { normal 0 0 -1 offset -1 } }";
    see(options, DVec3::ZERO, DVec3::new(0.1, 0.0, 1.0), rest).x
}

#[test]
fn every_bounce_adds_one_term() {
    for n in 0..20 {
        near(corridor(&bounces(n)), 0.125 * 2.0 * (1.0 - 0.5f64.powi(n as i32 + 1)), 1e-15);
    }
    near(corridor(&bounces(100_000)), 0.25, 1e-15);
}

#[test]
fn branches_below_the_weight_are_dropped() {
    // The weight after n bounces is (√3/2)ⁿ: 0.866, 0.75, 0.650, 0.5625, …
    for (weight, made) in [(0.9, 0), (0.86, 1), (0.76, 1), (0.74, 2), (0.6, 3)] {
        let expected = 0.125 * 2.0 * (1.0 - 0.5f64.powi(made + 1));
        near(corridor(&Options { weight, ..bounces(50) }), expected, 1e-15);
    }
}

#[test]
fn a_branch_exactly_at_the_cut_off_is_made() {
    let red = |weight| ball(&Options { weight, ..bounces(1) }, "reflectiveColor 1 0 0");
    close(red(1.0), DVec3::new(0.25, 0.0, 0.0), 1e-15);
    assert_eq!(red(1.0 + f64::EPSILON), DVec3::ZERO);
}

#[test]
fn light_goes_straight_through_the_middle_of_glass() {
    let glass = "transparentColor 0.5 1 0.25 indexOfRefraction 1.5";
    let kt = DVec3::new(0.5, 1.0, 0.25);
    assert_eq!(ball(&bounces(1), glass), DVec3::ZERO);
    close(ball(&bounces(2), glass), SKY_COLOR * kt * kt, 1e-15);
}

/// Light on a floor of glass lands one unit below where Snell's law says; a thin white strip is
/// there, and all around is black.
#[test]
fn a_refracted_ray_lands_where_snell_says() {
    let sine = 0.6 / 1.5;
    let x: f64 = sine / (1.0f64 - sine * sine).sqrt();
    let rest = |x: f64| {
        let (left, right) = (x - 1e-6, x + 1e-6);
        format!(
            "Background {{ color 0 0 0 ambientLight 1 1 1 }} Materials {{ numMaterials 2
             Material {{ {BLACK} transparentColor 1 1 1 indexOfRefraction 1.5 }} Material {{ }} }}
             Group {{ numObjects 2 MaterialIndex 0 Plane {{ normal 0 0 1 offset 0 }} MaterialIndex 1
             Triangle {{ vertex0 {left} -9 -1 vertex1 {right} -9 -1 vertex2 {x} 999999 -1 }} }}"
        )
    };
    let look = |x| see(&bounces(1), DVec3::new(-3.0, 0.0, 4.0), DVec3::new(3.0, 0.0, -4.0), &rest(x));
    assert_eq!(look(x), DVec3::ONE);
    assert_eq!(look(x + 1e-5), DVec3::ZERO);
    assert_eq!(look(x - 1e-5), DVec3::ZERO);
}

/// From inside a glass ball towards its rim, beyond the critical angle.
fn from_inside(options: &Options, material: &str) -> DVec3 {
    let materials =
        format!("Materials {{ numMaterials 1 Material {{ {BLACK} indexOfRefraction 1.5 {material} }} }}");
    see(options, DVec3::new(1.8, 0.0, 0.0), DVec3::Z, &format!("{SKY} {materials} {BALL}"))
}

#[test]
fn total_internal_reflection_adds_nothing() {
    assert_eq!(from_inside(&bounces(9), "transparentColor 1 1 1"), DVec3::ZERO);
    // With Fresnel all light stays inside, so that the sky is never seen either.
    let fresnel = Options { fresnel: true, ..bounces(9) };
    assert_eq!(from_inside(&fresnel, "transparentColor 1 1 1"), DVec3::ZERO);
}

#[test]
fn fresnel_splits_the_light() {
    let glass = "transparentColor 1 0.5 1 indexOfRefraction 1.5 reflectiveColor 1 1 1";
    let fresnel = |n| Options { fresnel: true, ..bounces(n) };
    // One bounce: 4 % of the sky behind the eye; kr of the material does not matter.
    close(ball(&fresnel(1), glass), 0.04 * SKY_COLOR, 1e-15);
    // Two: and what is refracted twice.
    let through = DVec3::new(1.0, 0.25, 1.0) * 0.96 * 0.96;
    close(ball(&fresnel(2), glass), (DVec3::splat(0.04) + through) * SKY_COLOR, 1e-14);
    // A surface that is not transparent keeps its own colour.
    close(ball(&fresnel(1), "reflectiveColor 0.5 1 0.25"), SKY_COLOR * DVec3::new(0.5, 1.0, 0.25), 1e-15);
}

#[test]
fn white_glass_loses_no_light() {
    let options = Options { fresnel: true, weight: 1e-12, ..bounces(60) };
    let white = "transparentColor 1 1 1 indexOfRefraction 1.5";
    close(ball(&options, white), SKY_COLOR, 1e-9);
}

#[test]
fn absorption_is_exponential_in_the_way_inside() {
    let tinted = "transparentColor 1 1 1 indexOfRefraction 1.5 absorption 0.25 0 1";
    let left = DVec3::new((-1.0f64).exp(), 1.0, (-4.0f64).exp());
    close(ball(&bounces(2), tinted), SKY_COLOR * left, 1e-8);
    // The camera's own ray was not refracted in, and what it mirrors inside stays outside too.
    let here = "transparentColor 1 1 1 indexOfRefraction 1.5 absorption 1 1 1";
    let rest = format!("{SKY} Materials {{ numMaterials 1 Material {{ {BLACK} {here} }} }} {BALL}");
    close(see(&bounces(1), DVec3::ZERO, DVec3::Z, &rest), SKY_COLOR, 1e-15);
}

#[test]
fn absorption_counts_between_inner_reflections() {
    // In by 0.96, once back and forth by 0.04 twice, out by 0.96: three ways of 4 units.
    let tinted = "transparentColor 1 1 1 indexOfRefraction 1.5 absorption 0.125 0.125 0.125";
    let options = Options { fresnel: true, weight: 0.0, ..bounces(4) };
    let way = (-0.5f64).exp();
    let first = 0.04 + 0.96 * 0.96 * way;
    // Four bounces: also the ways that leave on the near side after two, and far after three.
    let expected = first + 0.96 * 0.96 * (0.04 * way.powi(2) + 0.04 * 0.04 * way.powi(3));
    close(ball(&options, tinted), expected * SKY_COLOR, 1e-8);
}

#[test]
fn backs_mirror_although_they_are_black() {
    let rest = format!(
        "{SKY} Materials {{ numMaterials 1 Material {{ reflectiveColor 0.5 0.5 0.5 }} }}
         Group {{ numObjects 1 MaterialIndex 0 Plane {{ normal 0 0 -1 offset 0 }} }}"
    );
    close(see(&bounces(1), DVec3::Z, -DVec3::Z, &rest), 0.5 * SKY_COLOR, 1e-15);
}
