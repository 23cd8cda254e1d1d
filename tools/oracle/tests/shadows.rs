//! Shadow rays: where they stop, what they take along, and that no surface shadows itself.

mod support;

use common::math::DVec3;
use oracle::{Model, Options, render};
use support::{close, looking, mesh, scene, scene_with_mesh, see, see_scene};

const SHADOWS: Options = Options {
    width: 1,
    height: 1,
    model: Model::Whitted,
    shade_back: false,
    specular: oracle::Specular::Blinn,
    shadows: true,
    bounces: 0,
    weight: 0.0,
    transparent_shadows: false,
    fresnel: false,
    depth: None,
    normals: false,
    grid: None,
    pixel_side: 1,
    filter: None,
    lens_side: 1,
    light_side: 1,
};

const LAMP: &str = "Lights { numLights 1 PointLight { position 0 0 2 color 1 1 1 } }";
const MATERIALS: &str = "Materials { numMaterials 2 Material { }
    Material { diffuseColor 0 0 0 transparentColor 0.5 0.25 0 } }";

/// The floor under the lamp, seen from the side, with `blockers` in between.
fn floor(options: &Options, count: u32, blockers: &str) -> DVec3 {
    let group = format!(
        "Group {{ numObjects {} MaterialIndex 0 Plane {{ normal 0 0 1 offset 0 }} {blockers} }}",
        count + 1
    );
    let eye = DVec3::new(8.0, 0.0, 1.0);
    see(options, eye, -eye, &format!("{LAMP} {MATERIALS} {group}"))
}

#[test]
fn a_blocker_between_floor_and_light_makes_a_shadow() {
    let ball = "Sphere { center 0 0 1 radius 0.25 }";
    assert_eq!(floor(&SHADOWS, 1, ball), DVec3::ZERO);
    close(floor(&Options { shadows: false, ..SHADOWS }, 1, ball), DVec3::ONE, 1e-14);
    close(floor(&Options { model: Model::Phong, ..SHADOWS }, 1, ball), DVec3::ONE, 1e-14);
    assert_eq!(floor(&SHADOWS, 1, &format!("MaterialIndex 1 {ball}")), DVec3::ZERO);
}

#[test]
fn shadow_rays_stop_at_the_light_and_start_at_the_surface() {
    close(floor(&SHADOWS, 1, "Sphere { center 0 0 3 radius 0.9 }"), DVec3::ONE, 1e-8);
    close(floor(&SHADOWS, 1, "Sphere { center 0 0 -1 radius 0.9 }"), DVec3::ONE, 1e-8);
    // A lamp shade that the lamp sits on.
    close(floor(&SHADOWS, 1, "Plane { normal 0 0 1 offset 2 }"), DVec3::ONE, 1e-8);
}

#[test]
fn transparent_shadows_take_every_surface_crossed() {
    let through = Options { transparent_shadows: true, ..SHADOWS };
    let pane = "Plane { normal 0 0 1 offset 1 center 0 0 1 radius 0.5 }";
    let glass = |count, object: &str| floor(&through, count, &format!("MaterialIndex 1 {object}"));
    let kt = DVec3::new(0.5, 0.25, 0.0);
    close(glass(1, pane), kt, 1e-8);
    close(glass(1, "Sphere { center 0 0 1 radius 0.25 }"), kt * kt, 1e-8);
    let both = format!("{pane} MaterialIndex 0 Sphere {{ center 0 0 1.5 radius 0.25 }}");
    assert_eq!(glass(2, &both), DVec3::ZERO);
}

#[test]
fn the_seam_of_two_triangles_is_one_surface() {
    let through = Options { transparent_shadows: true, ..SHADOWS };
    let square = "MaterialIndex 1
        Triangle { vertex0 -1 -1 1 vertex1 1 -1 1 vertex2 1 1 1 }
        Triangle { vertex0 -1 -1 1 vertex1 1 1 1 vertex2 -1 1 1 }";
    close(floor(&through, 2, square), DVec3::new(0.5, 0.25, 0.0), 1e-8);
    // Two panes one above the other are two, though.
    let higher = square.replace("1 }", "1.5 }").replace(" 1 vertex", " 1.5 vertex");
    close(floor(&through, 4, &format!("{square} {higher}")), DVec3::new(0.25, 0.0625, 0.0), 1e-8);
}

/// With shadows and without must be the same picture: the object is convex and alone.
fn assert_no_acne(object: &str, eye: DVec3, look: DVec3, triangles: &[[DVec3; 3]]) {
    let lights = "Lights { numLights 3 DirectionalLight { direction -1 -2 -3 color 1 0 0 }
        DirectionalLight { direction 3 -1 1 color 0 1 0 }
        DirectionalLight { direction -0.001 1 -0.001 color 0 0 1 } }";
    let rest = format!("{lights} {MATERIALS} Group {{ numObjects 1 MaterialIndex 0 {object} }}");
    let text = looking(eye, look, &rest);
    let scene = scene_with_mesh(&text, mesh(triangles));
    let options = Options { width: 64, height: 64, ..SHADOWS };
    let with = render(&scene, &options).unwrap();
    let without = render(&scene, &Options { shadows: false, ..options }).unwrap();
    let lit = without.colour.pixels.iter().filter(|p| p.max_element() > 0.0).count();
    assert!(lit > 500, "{object}: the picture shows only {lit} lit pixels");
    let spoiled = with.colour.pixels.iter().zip(&without.colour.pixels).filter(|(a, b)| a != b);
    assert_eq!(spoiled.count(), 0, "{object}");
}

#[test]
fn convex_objects_do_not_shadow_themselves() {
    for radius in [1e-3, 1.0, 1e3, 1e6] {
        for far in [0.0, 1.0, 100.0] {
            let center = far * radius * DVec3::new(1.0, -2.0, 3.0);
            let eye = center + radius * DVec3::new(3.0, 2.0, 4.0);
            let place = format!("{:?} {:?} {:?}", center.x, center.y, center.z);
            let sphere = format!("Sphere {{ center {place} radius {radius:?} }}");
            assert_no_acne(&sphere, eye, center - eye, &[]);
            let squashed = format!(
                "Transform {{ Translate {place} Rotate {{ 1 1 0 40 }} Scale 1 0.01 1
                 Sphere {{ center 0 0 0 radius {radius:?} }} }}"
            );
            assert_no_acne(&squashed, eye, center - eye, &[]);
        }
    }
}

#[test]
fn flat_things_do_not_shadow_themselves() {
    let eye = DVec3::new(3.0, 2.0, 4.0);
    assert_no_acne("Plane { normal 1 2 3 offset 0.1 }", eye, -eye, &[]);
    assert_no_acne("Plane { normal 1 2 3 offset -1e5 }", eye, -eye, &[]);
    let faces = [[-DVec3::X, DVec3::new(2.0, -1.0, 0.5), DVec3::new(0.0, 2.0, 1.0)]];
    let turned = "Transform { Rotate { 1 2 3 10 } Scale 1 1 2 TriangleMesh { obj_file m.obj } }";
    assert_no_acne(turned, eye, -eye, &faces);
}

#[test]
fn a_closed_room_keeps_the_sun_out() {
    let rest = format!(
        "Lights {{ numLights 1 DirectionalLight {{ direction -1 -2 -3 color 1 1 1 }} }} {MATERIALS}
         Group {{ numObjects 1 MaterialIndex 0 Sphere {{ center 0 0 0 radius 1 }} }}"
    );
    let options = Options { shade_back: true, ..SHADOWS };
    let inside = scene(&looking(DVec3::new(0.1, 0.2, 0.3), DVec3::new(1.0, 2.0, 2.0), &rest));
    assert!(see_scene(&Options { shadows: false, ..options.clone() }, &inside).x < 1e-9);
    // The wall away from the sun faces it, and lies in the shadow of the other wall.
    let away = scene(&looking(DVec3::new(0.1, 0.2, 0.3), DVec3::new(-1.0, -2.0, -2.0), &rest));
    assert!(see_scene(&Options { shadows: false, ..options.clone() }, &away).x > 0.5);
    assert_eq!(see_scene(&options, &away), DVec3::ZERO);
}
