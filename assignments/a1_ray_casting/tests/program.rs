//! What must not change a picture, what is counted, and what is refused.

mod world;

use a1_ray_casting::{FlatColor, Studio};
use world::{FRONT, args, flat, render, studio};

/// 25 small balls in the lower left corner: most tiles see none.
fn corner_of_balls() -> Vec<String> {
    let ball = |k: i32| {
        let (x, y) = (f64::from(k % 5) * 0.25 - 1.8, f64::from(k / 5) * 0.25 - 1.8);
        format!("MaterialIndex {} Sphere {{ center {x} {y} 0 radius 0.15 }}", k % 2)
    };
    (0..25).map(ball).collect()
}

fn balls(camera: &str) -> Studio {
    let objects = corner_of_balls();
    let objects: Vec<&str> = objects.iter().map(String::as_str).collect();
    studio(camera, &objects, (120, 90))
}

#[test]
fn a1t1_empty_tiles_are_skipped_counted_and_harmless() {
    let perspective = "PerspectiveCamera { center 0 0 5 direction 0 0 -1 up 0 1 0 angle 45 }";
    for camera in [FRONT, perspective] {
        let studio = balls(camera);
        let layer = FlatColor::new(&studio.scene);
        let (every, all) = render(&studio, "-noskip tile", &layer);
        let (some, fewer) = render(&studio, "", &layer);
        assert_eq!(every, some);
        let pixels = 120 * 90;
        assert_eq!((all.rays, all.skipped_empty_tile, all.intersections), (pixels, 0, pixels * 25));
        assert_eq!(fewer.rays + fewer.skipped_empty_tile, pixels);
        assert_eq!(fewer.intersections, fewer.rays * 25);
        assert!(fewer.skipped_empty_tile > pixels / 2, "{}", fewer.skipped_empty_tile);
    }
}

/// A plane may be anywhere: nothing is skipped.
#[test]
fn a1t1_scenes_with_planes_have_no_empty_tiles() {
    let mut objects = corner_of_balls();
    objects.push("Plane { normal 0 1 0 offset -1 }".to_owned());
    let objects: Vec<&str> = objects.iter().map(String::as_str).collect();
    let camera = "PerspectiveCamera { center 0 0 5 direction 0 0 -1 up 0 1 0 angle 45 }";
    let studio = studio(camera, &objects, (40, 40));
    let (film, counters) = render(&studio, "", &FlatColor::new(&studio.scene));
    assert_eq!((counters.rays, counters.skipped_empty_tile), (1600, 0));
    assert_eq!(film, flat(&studio, "-noskip tile"));
}

#[test]
fn a1t1_threads_and_tiles_never_change_the_picture() {
    let studio = balls(FRONT);
    let expected = flat(&studio, "-threads 1");
    for threads in [1, 2, 3, 7, 16] {
        for tile in [1, 5, 16, 64, 1000] {
            assert_eq!(
                flat(&studio, &format!("-threads {threads} -tile {tile}")),
                expected,
                "{threads} {tile}"
            );
        }
    }
}

#[test]
fn a1t1_impossible_tasks_are_refused_before_anything_is_done() {
    let refused = |flags: &str, part: &str| {
        let error = a1_ray_casting::run(&args(flags)).expect_err(flags);
        assert_eq!(error.code(), 2);
        assert!(error.report().contains(part), "{flags}: {}", error.report());
    };
    refused("", "nothing to do");
    refused("-output o.tga -size 0 10", "0 x 10");
    refused("-output none -size 9 9", "is the scene");
    refused("-depth 1 2 o.tga -output o.tga", "two pictures");
    refused("-depth 3 3 o.tga", "must differ");
    refused("-depth near 3 o.tga", "not `near`");
    refused("-output o.tiff", "o.tiff");
    refused("-output o.tga", "none");
}
