//! A3T3: the preview beside the ray-traced picture of the same scene.

mod world;

use common::math::Vec3;
use common::picture::{Film, Transfer, read};
use world::{
    NOTHING, ORTHOGRAPHIC, PERSPECTIVE, drawn_mask, hit_mask, largest_difference, preview, soup, studio,
    traced,
};

const SPHERE: &str = "Sphere { center 0 0 0 radius 1.5 }";
const CUBE: &str = "TriangleMesh { obj_file cube.obj }";
const SQUARE: (i64, i64) = (64, 64);

/// Whether a pixel and its eight neighbours (as far as there are any) have one value.
fn is_inner(mask: &[bool], width: usize, index: usize) -> bool {
    let height = mask.len() / width;
    let (x, y) = (index % width, index / width);
    let around = |v: usize, end: usize| v.saturating_sub(1)..(v + 2).min(end);
    around(y, height).all(|j| around(x, width).all(|i| mask[j * width + i] == mask[index]))
}

/// At pixel centres triangles cover exactly what rays hit, whatever the camera and the shape of
/// the picture, behind the eye included; and flat matt triangles have exactly the same colour.
#[test]
fn a3t3_triangles_cover_what_rays_hit() {
    for (camera, size) in
        [(ORTHOGRAPHIC, SQUARE), (PERSPECTIVE, SQUARE), (PERSPECTIVE, (90, 41)), (ORTHOGRAPHIC, (33, 70))]
    {
        for seed in 1..6 {
            let objects = soup(30, seed * 7919);
            let objects: Vec<&str> = objects.iter().map(String::as_str).collect();
            let studio = studio(camera, &objects, size);
            for flags in ["", "-shade_back"] {
                let (drawn, rays) = (preview(&studio, flags), traced(&studio, flags));
                assert_eq!(drawn_mask(&drawn), hit_mask(&studio), "{camera} {seed}");
                assert!(largest_difference(&drawn, &rays, |_| true) < 1e-5, "{camera} {seed} {flags}");
            }
        }
    }
}

/// The eye in the middle of the soup: many triangles cross the plane w = 0.
#[test]
fn a3t3_nothing_behind_the_eye_is_drawn() {
    let camera = "PerspectiveCamera { center 0 0 0 direction 0.2 0.1 -1 up 0 1 0 angle 110 }";
    let objects = soup(60, 4711);
    let objects: Vec<&str> = objects.iter().map(String::as_str).collect();
    let studio = studio(camera, &objects, SQUARE);
    assert_eq!(drawn_mask(&preview(&studio, "")), hit_mask(&studio));
    let hits = hit_mask(&studio).iter().filter(|&&h| h).count();
    assert!((500..4000).contains(&hits), "{hits}");
}

/// What lies behind an orthographic camera's plane is seen all the same.
#[test]
fn a3t3_orthographic_sees_behind_its_plane() {
    let camera = "OrthographicCamera { center 0.03 0.01 0 direction 0 0 -1 up 0 1 0 size 4 }";
    let triangles =
        [2.0, -2.0].map(|z| format!("Triangle {{ vertex0 -1 -1 {z} vertex1 1 -1 {z} vertex2 0 1 {z} }}"));
    let studio = studio(camera, &[&triangles[0], &triangles[1]], SQUARE);
    assert_eq!(drawn_mask(&preview(&studio, "")), hit_mask(&studio));
}

#[test]
fn a3t3_silhouettes_of_fine_spheres_agree_within_a_pixel() {
    let egg = "Transform { Rotate { 1 2 3 50 } Scale 1 -0.3 0.8 Sphere { center 0.3 0 0 radius 1.5 } }";
    for (camera, shape) in
        [(ORTHOGRAPHIC, SPHERE), (PERSPECTIVE, SPHERE), (ORTHOGRAPHIC, egg), (PERSPECTIVE, egg)]
    {
        let studio = studio(camera, &[shape], (100, 100));
        let (hit, drawn) = (hit_mask(&studio), drawn_mask(&preview(&studio, "-tessellation 200 100")));
        let astray = (0..hit.len()).filter(|&i| hit[i] != drawn[i] && is_inner(&hit, 100, i)).count();
        assert_eq!(astray, 0, "{camera} {shape}");
        assert!(hit.iter().zip(&drawn).all(|(h, d)| *h || !d), "an inscribed body never sticks out");
    }
}

/// The horizon of an endless plane, seen level, from above, and from a leaning camera.
#[test]
fn a3t3_planes_reach_the_horizon() {
    for camera in [
        "PerspectiveCamera { center 0 2 0 direction 0 0 -1 up 0 1 0 angle 60 }",
        "PerspectiveCamera { center 3 0.01 1 direction 1 0.1 -1 up 0.3 1 0 angle 90 }",
        "PerspectiveCamera { center 0 500 0 direction 0 -0.5 -1 up 0 1 0 angle 20 }",
        "OrthographicCamera { center 0 0 5 direction 0 -0.05 -1 up 0 1 0 size 40 }",
    ] {
        let studio = studio(camera, &["Plane { normal 0.02 1 0 offset -1 }"], (120, 80));
        let (hit, drawn) = (hit_mask(&studio), drawn_mask(&preview(&studio, "")));
        let astray = (0..hit.len()).filter(|&i| hit[i] != drawn[i]).count();
        // A row of pixels may hold the horizon itself.
        assert!(astray <= 1, "{camera}: {astray}");
        assert!(hit.contains(&true));
    }
}

#[test]
fn a3t3_flat_planes_look_as_traced() {
    let studio = studio(PERSPECTIVE, &["Plane { normal 0.1 1 0.2 offset -1 }"], SQUARE);
    assert!(largest_difference(&preview(&studio, ""), &traced(&studio, ""), |_| true) < 1e-5);
}

/// Gouraud shading interpolates a smooth function on cells of size h: error O(h²).
#[test]
fn a3t3_gouraud_converges_to_the_traced_sphere() {
    let studio = studio(ORTHOGRAPHIC, &[SPHERE], (80, 80));
    let rays = traced(&studio, "");
    // Off the rim, where the normal turns infinitely fast across pixels, and off the shadow's
    // edge, where the light itself has a kink.
    let lit = |i: usize| rays.pixels()[i] != NOTHING && rays.pixels()[i].x > 0.3;
    let (dx, dy) = (|i: usize| i % 80, |i: usize| i / 80);
    let well_inside = |i: usize| {
        let (x, y) = (dx(i) as f64 - 39.5, dy(i) as f64 - 39.5);
        x.hypot(y) < 24.0 && lit(i)
    };
    let error = |n: u32| {
        let film = preview(&studio, &format!("-gouraud -tessellation {} {n}", 2 * n));
        largest_difference(&film, &rays, well_inside)
    };
    let (coarse, middle, fine) = (error(16), error(32), error(64));
    assert!((3.0..5.5).contains(&(coarse / middle)), "{coarse} {middle} {fine}");
    assert!((3.0..5.5).contains(&(middle / fine)), "{coarse} {middle} {fine}");
    assert!(fine < 0.001, "{fine}");
}

/// Flat shading of the same sphere is worse, and has few colours: one per polygon.
#[test]
fn a3t3_flat_shading_has_one_colour_per_polygon() {
    let studio = studio(ORTHOGRAPHIC, &[SPHERE], (80, 80));
    let mut colors: Vec<[u32; 3]> = preview(&studio, "-tessellation 10 5")
        .pixels()
        .iter()
        .map(|c| c.to_array().map(f32::to_bits))
        .collect();
    colors.sort_unstable();
    colors.dedup();
    // At most the 50 polygons and the background. Half of them face away, some are in the dark.
    assert!((15..=51).contains(&colors.len()), "{}", colors.len());
}

/// A smooth normal that looks away at the silhouette must not blacken the outline.
#[test]
fn a3t3_gouraud_outlines_are_not_black() {
    let studio = studio(PERSPECTIVE, &[SPHERE], SQUARE);
    let film = preview(&studio, "-gouraud -tessellation 8 4");
    assert!(film.pixels().iter().all(|c| *c == NOTHING || c.x > 0.0999), "ambient light is the least");
}

#[test]
fn a3t3_gouraud_keeps_sharp_edges_and_smooths_the_others() {
    let sharp = studio(PERSPECTIVE, &[CUBE], SQUARE);
    assert!(largest_difference(&preview(&sharp, "-gouraud"), &preview(&sharp, ""), |_| true) < 1e-6);
    // Two triangles with a bend of 30°: their common edge takes the normal between them.
    let bent = [
        "Triangle { vertex0 -1 0 0.268 vertex1 0 -1 0 vertex2 0 1 0 }",
        "Triangle { vertex0 1 0 0.268 vertex1 0 1 0 vertex2 0 -1 0 }",
    ];
    let bent = studio(ORTHOGRAPHIC, &bent, SQUARE);
    let (flat, smooth) = (preview(&bent, ""), preview(&bent, "-gouraud"));
    let step = |film: &Film| {
        let row: Vec<f32> =
            (10..54).map(|x| film.get(x, 32)).filter(|c| *c != NOTHING).map(|c| c.x).collect();
        row.windows(2).map(|w| (w[0] - w[1]).abs()).fold(0.0, f32::max)
    };
    assert!(step(&smooth) < step(&flat) / 5.0, "{} {}", step(&smooth), step(&flat));
}

#[test]
fn a3t3_back_faces_are_black_unless_lit() {
    let turned = "Triangle { vertex0 -1 -1 0 vertex1 0 1 0 vertex2 1 -1 0 }";
    let studio = studio(ORTHOGRAPHIC, &[turned], SQUARE);
    for gouraud in ["", " -gouraud"] {
        let black = preview(&studio, gouraud);
        assert_eq!(black.get(32, 32), Vec3::ZERO);
        let lit = preview(&studio, &format!("-shade_back{gouraud}"));
        assert!((lit.get(32, 32) - traced(&studio, "-shade_back").get(32, 32)).length() < 1e-5);
        assert!(lit.get(32, 32).x > 0.5);
    }
}

#[test]
fn a3t3_mirrored_and_nested_cubes_look_as_traced() {
    for scale in ["1 1 1", "-1 1 1", "0.5 -0.7 1.2", "-1 -1 -1"] {
        let object = format!("Transform {{ YRotate 35 XRotate 20 Scale {scale} {CUBE} }}");
        let studio = studio(PERSPECTIVE, &[&object], SQUARE);
        let difference = largest_difference(&preview(&studio, ""), &traced(&studio, ""), |_| true);
        assert!(difference < 1e-5, "{scale}: {difference}");
    }
}

#[test]
fn a3t3_threads_and_tiles_never_change_the_picture() {
    let studio = studio(PERSPECTIVE, &[SPHERE, CUBE, "Plane { normal 0 1 0 offset -1 }"], (101, 67));
    let expected = preview(&studio, "-gouraud -threads 1 -tile 101");
    for flags in
        ["-threads 2", "-threads 3 -tile 1", "-threads 7 -tile 5", "-threads 16 -tile 16", "-tile 50"]
    {
        assert_eq!(preview(&studio, &format!("-gouraud {flags}")), expected, "{flags}");
    }
}

/// The program: the preview is written, and the ray-traced picture does not depend on it.
#[test]
fn a3t3_the_program_writes_both_pictures() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    std::fs::write(
        path("scene.txt"),
        format!("{ORTHOGRAPHIC} Materials {{ numMaterials 1 Material {{ }} }} Group {{ numObjects 1 MaterialIndex 0 {SPHERE} }}")
    )
    .unwrap();
    let run = |tessellation: &str| {
        let mut args = world::args(&format!(
            "-output {} -preview {} -size 30 20 -tessellation {tessellation}",
            path("traced.pfm"),
            path("preview.pfm")
        ));
        args.diffuse.cast.input = path("scene.txt").into();
        a3_phong::run(&args).unwrap_or_else(|e| panic!("{}", e.report()));
        ["traced.pfm", "preview.pfm"].map(|name| read(path(name).as_ref(), Transfer::Linear).unwrap())
    };
    let (coarse, fine) = (run("3 2"), run("60 30"));
    assert_eq!(coarse[0], fine[0], "-tessellation never changes the ray-traced picture");
    assert_ne!(coarse[1], fine[1]);
    assert_eq!((coarse[1].width(), coarse[1].height()), (30, 20));
}

#[test]
fn a3t3_impossible_flags_are_refused() {
    assert!(world::args("-preview p.png -tessellation 2 5").check().is_err());
    assert!(world::args("-preview p.png -tessellation 3 2").check().is_ok());
    assert!(world::args("").check().is_err(), "nothing to do");
    let crowd = vec![SPHERE; 2];
    assert!(
        world::args("-tessellation 4096 4096").tessellate(&studio(ORTHOGRAPHIC, &crowd, SQUARE)).is_err()
    );
    assert!(world::args("-preview p.png").outputs().iter().any(|p| p.ends_with("p.png")));
}
