//! The same command, the same picture: whatever the threads, the tiles and the structure.

mod stage;

use stage::picture;

const SCENE: &str = "
    PerspectiveCamera { center 0 2 8 direction 0 -0.2 -1 up 0 1 0 angle 40
        aperture 0.3 focalDistance 8 blades 6 }
    Background { color 0.2 0.3 0.4 ambientLight 0.1 0.1 0.1 }
    Lights { numLights 2
        SphereLight { center 2 6 3 radius 0.8 color 0.7 0.7 0.6 }
        DirectionalLight { direction -1 -1 -1 color 0.2 0.2 0.3 } }
    Materials { numMaterials 4
        Material { diffuseColor 0.9 0.9 0.8 }
        Material { diffuseColor 0.2 0.2 0.2 }
        Checkerboard { materialIndex 0 materialIndex 1 }
        Material { diffuseColor 0.1 0.1 0.1 transparentColor 0.8 0.9 0.8 reflectiveColor 0.2 0.2 0.2
            indexOfRefraction 1.5 } }
    Group { numObjects 5
        MaterialIndex 2 Plane { normal 0 1 0 offset -1 }
        MaterialIndex 3 Sphere { center 0 0.2 1 radius 1 }
        MaterialIndex 0 Sphere { center 2 0 -2 radius 1 }
        Sphere { center -2 0 -1 radius 0.8 }
        Triangle { vertex0 -3 0 -4 vertex1 3 0 -4 vertex2 0 4 -5 } }";

#[test]
fn a7t3_pictures_do_not_depend_on_threads_tiles_and_structures() {
    let all = "-size 45 31 -shadows -shade_back -bounces 3";
    for flags in [
        "-jittered_samples 9 -gaussian_filter 0.6",
        "-sampler sobol -samples 5 -filter lanczos 2.5",
        "-sampler blue_noise -samples 4",
        "-random_samples 3 -tent_filter 0.5 -smooth_edges 0.1",
    ] {
        let plain = picture(SCENE, &format!("{all} {flags} -threads 1"));
        for way in
            ["-threads 2 -tile 7", "-threads 7 -tile 1", "-threads 3 -tile 64 -accel list", "-accel kdtree"]
        {
            assert!(picture(SCENE, &format!("{all} {flags} {way}")) == plain, "{flags} {way}");
        }
        let other = picture(SCENE, &format!("{all} {flags} -seed 1"));
        assert!(other != plain, "{flags}: the seed does nothing");
    }
}

#[test]
fn without_samples_and_filters_it_draws_what_the_step_below_draws() {
    let scene =
        SCENE.replace("SphereLight", "PointLight").replace("center 2 6 3 radius 0.8", "position 2 6 3");
    let flags = "-size 45 31 -shadows -shade_back -bounces 3";
    let plain = picture(&scene, flags);
    assert!(picture(&scene, &format!("{flags} -uniform_samples 1 -aperture 0")) == plain);
    assert!(picture(&scene, &format!("{flags} -uniform_samples 1 -aperture 0 -box_filter 0.5")) == plain);
}
