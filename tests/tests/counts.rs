//! What is counted: the course's known numbers, and for every kind of skipped work that doing it
//! costs exactly what the counter says and changes nothing.

use common::cli::Skip;
use common::counters::Counters;
use std::fs;
use std::path::PathBuf;
use tests::stage::{Films, Stage};
use tests::{cost, workspace_file};

const PIXELS: u64 = 200 * 200;

/// Camera rays only, every primitive asked by every ray.
fn brute_force(scene: &str) -> (usize, Counters) {
    let stage = Stage::open(scene, "-size 200 200");
    let counters = stage.films(stage.list().as_accel()).counters;
    (cost::primitives(&stage.studio.scene), counters)
}

#[test]
fn a5t4_known_counts_without_a_grid() {
    for (scene, primitives) in [
        ("scenes/scene1_01.txt", 1),
        ("scenes/scene4_04_reflective_sphere.txt", 3),
        ("scenes/scene4_01_sphere_shadow.txt", 2),
    ] {
        let (found, counters) = brute_force(scene);
        assert_eq!(found, primitives, "{scene} is not what this test needs");
        let work = (counters.rays, counters.shadow_rays, counters.intersections, counters.cells);
        assert_eq!(work, (PIXELS, 0, PIXELS * primitives as u64, 0), "{scene}");
    }
}

/// The numbers that the course itself gives for its first scenes of assignment 6.
#[test]
fn a6_known_counts_without_a_grid() {
    for (scene, intersections) in [
        ("scenes/scene6_01_sphere.txt", 40_000),
        ("scenes/scene6_02_sphere_triangles.txt", 120_000),
        ("scenes/scene6_03_sphere_plane.txt", 80_000),
    ] {
        let (_, counters) = brute_force(scene);
        let work = (counters.rays, counters.shadow_rays, counters.intersections, counters.cells);
        assert_eq!(work, (PIXELS, 0, intersections, 0), "{scene}");
    }
}

#[test]
fn a5t4_a_grid_of_one_cell_asks_whoever_passes_through_it() {
    let stage = Stage::open("scenes/scene1_01.txt", "-size 200 200");
    let grid = stage.grid([1, 1, 1]).expect("a sphere is finite");
    let counters = stage.films(grid.as_accel()).counters;
    // The ball's box is 2 units wide, the picture 5: 80 × 80 of 200 × 200 pixels.
    assert_eq!((counters.rays, counters.cells, counters.intersections), (PIXELS, 80 * 80, 80 * 80));
}

/// Both ways, and that the picture is the same.
fn with_and_without(scene: &PathBuf, flags: &str, skip: Skip) -> [Counters; 2] {
    let films = |stage: &Stage| stage.films(stage.list().as_accel());
    let skipping: Films = films(&Stage::open(scene, flags));
    let toiling = films(&Stage::open(scene, flags).not_skipping(skip));
    assert_eq!(skipping.first_difference(&toiling), None, "-noskip {skip:?} changes {}", scene.display());
    [skipping.counters, toiling.counters]
}

#[test]
fn a5t4_tiles_that_see_nothing() {
    let scene = workspace_file("scenes/scene2_09_bunny_200.txt");
    let [skipping, toiling] = with_and_without(&scene, "-size 200 200", Skip::Tile);
    assert!(skipping.skipped_empty_tile > 0);
    assert_eq!(skipping.rays + skipping.skipped_empty_tile, PIXELS);
    assert_eq!((toiling.rays, toiling.skipped_empty_tile), (PIXELS, 0));
}

#[test]
fn a4t1_lights_behind_the_surface() {
    let scene = workspace_file("scenes/scene4_02_colored_shadows.txt");
    let [skipping, toiling] = with_and_without(&scene, "-size 200 200 -shadows", Skip::Behind);
    assert!(skipping.skipped_shadow_behind > 0);
    assert_eq!(skipping.shadow_rays + skipping.skipped_shadow_behind, toiling.shadow_rays);
    assert_eq!((toiling.skipped_shadow_behind, toiling.rays), (0, skipping.rays));
}

/// The ball of scene 4.01 with a black light among the others.
const DARK: &str = "
PerspectiveCamera { center 0 1 6  direction 0 0 -1  up 0 1 0  angle 40 }
Background { color 0.1 0.2 0.3  ambientLight 0.1 0.1 0.1 }
Lights { numLights 3
    DirectionalLight { direction 0 0 -1  color 0 0 0 }
    DirectionalLight { direction -1 -2 -1  color 0.7 0.6 0.5 }
    PointLight { position 2 3 4  color 1 1 1  attenuation -1 0 0 }
}
Materials { numMaterials 1  PhongMaterial { diffuseColor 1 1 1 } }
Group { numObjects 2  MaterialIndex 0
    Sphere { center 0 1 0  radius 1 }
    Plane { normal 0 1 0  offset 0 }
}";

#[test]
fn a4t1_lights_that_give_nothing() {
    let folder = tempfile::tempdir().expect("there is room for temporary files");
    let scene = folder.path().join("dark.txt");
    fs::write(&scene, DARK).expect("there is room for temporary files");
    let [skipping, toiling] = with_and_without(&scene, "-size 200 200 -shadows", Skip::Dark);
    assert!(skipping.skipped_shadow_dark > 0);
    assert_eq!(skipping.skipped_shadow_dark % 2, 0, "two lights are dark at every point");
    assert_eq!(skipping.shadow_rays + skipping.skipped_shadow_dark, toiling.shadow_rays);
    assert_eq!(toiling.skipped_shadow_dark, 0);
}

/// From inside a ball or a gem, a light outside is always hidden by the body itself.
#[test]
fn a4t1_lights_outside_of_closed_bodies() {
    let inside = "-size 100 100 -shadows -shade_back -bounces 4";
    for scene in ["scenes/scene4_14_faceted_gem.txt", "scenes/scene4_09_transparent_sphere_2.0.txt"] {
        let [skipping, toiling] = with_and_without(&workspace_file(scene), inside, Skip::Inside);
        let lights = |c: &Counters| {
            let skipped = c.skipped_shadow_behind + c.skipped_shadow_dark + c.skipped_shadow_inside;
            c.shadow_rays + skipped
        };
        assert!(skipping.skipped_shadow_inside > 1000, "{scene}: {}", skipping.skipped_shadow_inside);
        // Who looks at every light traces the last rays, too, for their sake.
        let known = skipping.skipped_known_secondary;
        let lamps = Stage::open(scene, inside).studio.scene.lights.len() as u64;
        let all = (lights(&skipping) + lamps * known, skipping.rays + known);
        assert_eq!(all, (lights(&toiling), toiling.rays), "{scene}");
        assert_eq!(toiling.skipped_shadow_inside, 0);
    }
}

/// The last rays into a ball or a gem meet its inner side, wherever they go.
#[test]
fn a4t2_last_rays_inside_of_closed_bodies() {
    for scene in ["scenes/scene4_14_faceted_gem.txt", "scenes/scene4_09_transparent_sphere_2.0.txt"] {
        for flags in ["-shadows -shade_back -bounces 4", "-shadows -bounces 1 -weight 0.01"] {
            let flags = format!("-size 100 100 {flags}");
            let [skipping, toiling] = with_and_without(&workspace_file(scene), &flags, Skip::Known);
            let known = skipping.skipped_known_secondary;
            assert!(known > 1000, "{scene}: {known}");
            let all = (skipping.rays + known, skipping.surfaces + known);
            assert_eq!(all, (toiling.rays, toiling.surfaces), "{scene}");
            assert_eq!(toiling.skipped_known_secondary, 0);
        }
    }
}

/// A ball of glass, and things that make a difference to what its inner side sends on.
#[test]
fn a4t2_last_rays_that_are_not_known() {
    let folder = tempfile::tempdir().expect("there is room for temporary files");
    let known = |light: &str, glass: &str, other: &str, flags: &str| {
        let scene = folder.path().join("ball.txt");
        let text = format!(
            "PerspectiveCamera {{ center 0 0 5 direction 0 0 -1 up 0 1 0 angle 40 }}
             Lights {{ numLights 1 PointLight {{ position {light} color 1 1 1 }} }}
             Background {{ color 0.2 0.3 0.4 ambientLight 0.3 0.3 0.3 }}
             Materials {{ numMaterials 1 PhongMaterial {{ diffuseColor 0.2 0.3 0.1
                 transparentColor 0.9 0.8 0.9 indexOfRefraction 1.3 {glass} }} }}
             Group {{ numObjects 2 MaterialIndex 0 Sphere {{ center 0 0 0 radius 1 }} {other} }}"
        );
        fs::write(&scene, text).expect("there is room for temporary files");
        let flags = format!("-size 50 50 -shade_back -bounces 1 {flags}");
        with_and_without(&scene, &flags, Skip::Known)[0].skipped_known_secondary
    };
    let aside = "Sphere { center 3 0 0 radius 0.5 }";
    assert!(known("2 3 4", "", aside, "-shadows") > 100);
    assert_eq!(known("0.1 0.2 0.3", "", aside, "-shadows"), 0, "the light is inside");
    assert_eq!(known("2 3 4", "absorption 1 2 3", aside, "-shadows"), 0, "it depends on the distance");
    assert_eq!(
        known("2 3 4", "", "Sphere { center 0.2 0 0 radius 0.3 }", "-shadows"),
        0,
        "something is inside"
    );
    assert_eq!(known("2 3 4", "", aside, ""), 0, "light comes through everything");
    assert_eq!(known("2 3 4", "", aside, "-shadows -transparent_shadows"), 0, "and through glass");
}

#[test]
fn a4t2_secondary_rays_of_black_weight() {
    let scene = workspace_file("scenes/scene4_04_reflective_sphere.txt");
    let [skipping, toiling] = with_and_without(&scene, "-size 200 200 -bounces 1", Skip::Black);
    assert!(skipping.skipped_black_secondary > 0);
    assert_eq!(skipping.rays + skipping.skipped_black_secondary, toiling.rays);
    assert_eq!(toiling.skipped_black_secondary, 0);
    // Deeper, the needless rays hit things and make needless rays of their own.
    let [skipping, toiling] = with_and_without(&scene, "-size 60 60 -shadows -bounces 3", Skip::Black);
    assert!(skipping.rays + skipping.skipped_black_secondary <= toiling.rays);
}

#[test]
fn a4t2_the_cut_off_weight_drops_what_it_counts() {
    let scene = "scenes/scene4_04_reflective_sphere.txt";
    let counters = |flags: &str| {
        let stage = Stage::open(scene, flags);
        stage.films(stage.list().as_accel()).counters
    };
    // Both mirrors weigh less than 2, so that no ray is left and every one was counted.
    let all = counters("-size 200 200 -bounces 1");
    let none = counters("-size 200 200 -bounces 1 -weight 2");
    assert_eq!((all.skipped_below_weight, none.rays), (0, PIXELS));
    assert_eq!(all.rays, none.rays + none.skipped_below_weight);
}
