//! What is not done because it could not matter, counted; and that it does not matter.

use stress::light::stage::{Stage, scene};

const DOWN: &str = "OrthographicCamera { center 0 1 0  direction 0 -1 0  up 0 0 -1  size 0.5 }";
const FLOOR: &str = "Plane { normal 0 1 0 offset 0 }";

/// Paths of all pictures here.
const PATHS: u64 = 4 * 4 * 8;

fn stage(material: &str, light: &str, flags: &str) -> Stage {
    let text = scene(DOWN, "0.5 0.5 0.5", &[light], &[material], FLOOR);
    Stage::new(&text, &[], &format!("-size 4 4 -spp 8 {flags}"))
}

const LIGHT_ABOVE: &str = "PointLight { position 1 3 0 color 1 1 1 }";
const LIGHT_BELOW: &str = "PointLight { position 1 -3 0 color 1 1 1 }";

#[test]
fn mirrors_ask_no_light() {
    let mirror = "diffuseColor 0 0 0 reflectiveColor 0.9 0.9 0.9";
    let (sums, skipping) = stage(mirror, LIGHT_ABOVE, "").sums(1, &[8]);
    assert_eq!((skipping.rays, skipping.shadow_rays), (2 * PATHS, 0));
    assert_eq!((skipping.skipped_light_specular, skipping.skipped_shadow_dark), (PATHS, 0));
    let (same, asking) = stage(mirror, LIGHT_ABOVE, "-noskip specular").sums(1, &[8]);
    assert!(same == sums, "the skip changes the picture");
    assert_eq!((asking.rays, asking.shadow_rays), (2 * PATHS, 0));
    assert_eq!((asking.skipped_light_specular, asking.skipped_shadow_dark), (0, PATHS));
}

#[test]
fn lights_behind_a_surface_get_no_shadow_ray() {
    let matt = "diffuseColor 0.5 0.5 0.5";
    let (sums, skipping) = stage(matt, LIGHT_BELOW, "-rr_depth 9").sums(1, &[8]);
    assert_eq!((skipping.rays, skipping.shadow_rays), (2 * PATHS, 0));
    assert_eq!((skipping.skipped_shadow_behind, skipping.skipped_shadow_dark), (PATHS, 0));
    let (same, asking) = stage(matt, LIGHT_BELOW, "-rr_depth 9 -noskip behind").sums(1, &[8]);
    assert!(same == sums, "the skip changes the picture");
    assert_eq!((asking.skipped_shadow_behind, asking.skipped_shadow_dark), (0, PATHS));
    // With the light in front there is one for each path.
    let lit = stage(matt, LIGHT_ABOVE, "-rr_depth 9").sums(1, &[8]).1;
    assert_eq!((lit.rays, lit.shadow_rays, lit.skipped_shadow_behind), (2 * PATHS, PATHS, 0));
}

/// Between two floors, all paths meet three surfaces; the last ray only looks for light.
#[test]
fn what_the_last_ray_meets_is_not_looked_at_unless_it_shines() {
    let floors = format!("{FLOOR}\nPlane {{ normal 0 1 0 offset 5 }}");
    let sums = |material: &str, flags: &str| {
        let camera = "PerspectiveCamera { center 0 1 0  direction 0 -1 0  up 0 0 -1  angle 20 }";
        let text = scene(camera, "0.5 0.5 0.5", &[LIGHT_ABOVE], &[material], &floors);
        Stage::new(&text, &[], &format!("-size 4 4 -spp 8 -bounces 1 -rr_depth 9 {flags}")).sums(1, &[8])
    };
    let matt = "diffuseColor 0.5 0.5 0.5";
    let (picture, skipping) = sums(matt, "");
    let (same, looking) = sums(matt, "-noskip surface");
    assert!(same == picture, "the skip changes the picture");
    assert_eq!((skipping.surfaces, skipping.skipped_surface), (2 * PATHS, PATHS));
    assert_eq!((looking.surfaces, looking.skipped_surface), (3 * PATHS, 0));
    let shining = "diffuseColor 0.5 0.5 0.5 emissiveColor 1 1 1";
    let ((bright, skipping), (same, _)) = (sums(shining, ""), sums(shining, "-noskip surface"));
    assert!(bright == same && bright != picture, "light of the last surface is lost");
    assert_eq!((skipping.surfaces, skipping.skipped_surface), (3 * PATHS, 0));
}

#[test]
fn black_things_end_paths_and_direct_light_needs_no_way_on() {
    let black = stage("diffuseColor 0 0 0", LIGHT_ABOVE, "").sums(1, &[8]).1;
    assert_eq!((black.rays, black.shadow_rays), (PATHS, 0));
    let naive =
        stage("diffuseColor 0.5 0.5 0.5", LIGHT_ABOVE, "-integrator naive -rr_depth 9").sums(1, &[8]).1;
    assert_eq!((naive.rays, naive.shadow_rays), (2 * PATHS, 0));
    // Albedo 0.2 is half of what roulette lets pass: of the paths about half end, all are counted.
    let few = stage("diffuseColor 0.2 0.2 0.2", LIGHT_ABOVE, "-rr_depth 0").sums(1, &[8]).1;
    assert_eq!(few.rays + few.ended_by_roulette, 2 * PATHS);
    assert!((PATHS / 4..PATHS * 3 / 4).contains(&few.ended_by_roulette), "{}", few.ended_by_roulette);
}
