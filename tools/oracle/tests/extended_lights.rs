//! Lights with an extent, against formulas for what they send to a small piece of floor.

mod support;

use common::math::DVec3;
use oracle::Options;
use support::{near, see};

/// What the floor y = 0 at the origin looks like from obliquely above, under a light given as a
/// block of lights and further objects of material 1, which shines 2 3 4.
fn floor(light_side: u32, shadows: bool, lights: &str, objects: &str) -> DVec3 {
    let count = 1 + objects.matches("radius 0.5").count() + objects.matches("Triangle").count();
    let rest = format!(
        "Background {{ ambientLight 0 0 0 color 0 0 0 }} {lights}
         Materials {{ numMaterials 2 Material {{ diffuseColor 1 1 1 }}
             Material {{ diffuseColor 0 0 0 emissiveColor 2 3 4 }} }}
         Group {{ numObjects {count} MaterialIndex 0 Plane {{ normal 0 1 0 offset 0 }}
             MaterialIndex 1 {objects} }}"
    );
    let options = Options { light_side, shadows, ..Options::default() };
    see(&options, DVec3::new(6.0, 1.0, 0.0), DVec3::new(-6.0, -1.0, 0.0), &rest)
}

fn ball(center: &str) -> String {
    format!(
        "Lights {{ numLights 1 SphereLight {{ center {center} radius 0.5 color 1 2 3 attenuation 0 0 1 }} }}"
    )
}

#[test]
fn a_light_sphere_overhead() {
    // The mean cosine over a cone is 1 − (1 − cos)/2.
    let cosine = (1.0 - 0.25f64 / 4.0).sqrt();
    let expected = (1.0 + cosine) / 2.0 / 4.0;
    for shadows in [false, true] {
        let seen = floor(16, shadows, &ball("0 2 0"), "");
        near(seen.x, expected, 1e-12);
        near(seen.z, 3.0 * expected, 1e-12);
    }
    near(floor(1, true, &ball("0 2 0"), "").x, 0.25, 1e-12);
}

#[test]
fn from_inside_a_light_sphere_comes_light_from_everywhere() {
    // Half of all directions are above the floor, with a mean cosine of one half.
    near(floor(64, true, &ball("0 0.2 0"), "").x, 0.25 / 0.04, 0.25 / 0.04 * 0.01);
}

/// A sphere of radiance L sends πL·(r/d)²·cosθ to a surface that sees all of it.
#[test]
fn a_shining_sphere_by_its_form_factor() {
    for shadows in [false, true] {
        let seen = floor(32, shadows, "", "Sphere { center 0 2 0 radius 0.5 }");
        near(seen.x, 2.0 * 0.0625, 1e-3);
        near(seen.z, 4.0 * 0.0625, 2e-3);
        let seen = floor(32, shadows, "", "Sphere { center 0 2 1.5 radius 0.5 }");
        near(seen.x, 2.0 * 0.04 * 0.8, 1e-3);
    }
    assert_eq!(floor(1, true, "", "Sphere { center 0 2 0 radius 0.5 }"), DVec3::ZERO);
}

/// A disc overhead: R²/(R² + h²).
#[test]
fn a_shining_disc_by_its_form_factor() {
    let disc = |normal: &str, offset: &str| {
        format!("Plane {{ normal {normal} offset {offset} center 0 2 0 radius 0.5 }}")
    };
    near(floor(32, true, "", &disc("0 -1 0", "-2")).x, 2.0 * 0.25 / 4.25, 1e-4);
    assert_eq!(floor(32, true, "", &disc("0 1 0", "2")), DVec3::ZERO);
}

/// A right-angled corner of a triangle overhead, by Lambert's formula for polygons: half the sum,
/// over its edges, of their angle times the slope of the plane through edge and point.
#[test]
fn a_shining_triangle_by_lamberts_formula() {
    let corners = [DVec3::new(0.0, 2.0, 0.0), DVec3::new(1.0, 2.0, 0.0), DVec3::new(0.0, 2.0, 1.5)];
    let factor: f64 = (0..3)
        .map(|i| {
            let (a, b) = (corners[i].normalize(), corners[(i + 1) % 3].normalize());
            a.angle_between(b) * a.cross(b).normalize().y
        })
        .sum::<f64>()
        .abs()
        / std::f64::consts::TAU;
    let text = |a: DVec3, b: DVec3, c: DVec3| {
        let say = |v: DVec3| format!("{:?} {:?} {:?}", v.x, v.y, v.z);
        format!("Triangle {{ vertex0 {} vertex1 {} vertex2 {} }}", say(a), say(b), say(c))
    };
    let [a, b, c] = corners;
    near(floor(32, true, "", &text(a, b, c)).x, 2.0 * factor, 1e-4);
    assert_eq!(floor(32, true, "", &text(a, c, b)), DVec3::ZERO, "it shines from its front only");
}

/// A sphere squashed by a transform shines as the ellipsoid that it is: from far below, like its
/// outline, a disc.
#[test]
fn transforms_stretch_what_shines() {
    let text = "Transform { Translate 0 40 0 Scale 2 0.1 2 Sphere { center 0 0 0 radius 0.5 } }";
    let seen = floor(64, false, "", text).x;
    near(seen / (2.0 / 1601.0), 1.0, 2e-3);
    let mirrored = "Transform { Translate 0 40 0 Scale -2 0.1 2 Sphere { center 0 0 0 radius 0.5 } }";
    near(floor(64, false, "", mirrored).x, seen, 1e-12);
}

/// A roof whose edge passes right under the middle of the light hides half of it.
#[test]
fn half_a_light_hidden_is_half_a_shadow() {
    let roof = "MaterialIndex 0 Triangle { vertex0 0 1.5 -50 vertex1 0 1.5 50 vertex2 -50 1.5 0 }";
    let whole = floor(16, true, &ball("0 2.5 0"), "").x;
    near(floor(16, true, &ball("0 2.5 0"), roof).x, whole / 2.0, 1e-12);
    near(floor(16, false, &ball("0 2.5 0"), roof).x, whole, 1e-12);
    assert_eq!(floor(1, true, &ball("-0.1 2.5 0"), roof), DVec3::ZERO);
}

#[test]
fn own_light_is_seen() {
    let rest = "Background { ambientLight 0 0 0 } Lights { numLights 0 }
        Materials { numMaterials 1 Material { emissiveColor 2 3 4 } }
        Group { numObjects 1 MaterialIndex 0 Sphere { center 0 0 0 radius 1 } }";
    let at = |eye: f64, shade_back: bool| {
        let options = Options { shade_back, ..Options::default() };
        see(&options, DVec3::new(0.0, 0.0, eye), -DVec3::Z, rest)
    };
    assert_eq!(at(5.0, false), DVec3::new(2.0, 3.0, 4.0));
    assert_eq!(at(0.0, false), DVec3::ZERO, "from behind");
    assert_eq!(at(0.0, true), DVec3::new(2.0, 3.0, 4.0));
}
