//! Property 13 for whole scenes: no light is made and none is lost.

use super::stage::{Stage, mean, mean_and_error, obj, scene};
use crate::Stress;
use crate::kit::convex_sphere;

/// Three balls on a floor, so that light goes from one to the other.
const BALLS: &str = "Plane { normal 0 1 0 offset 0 }\n\
    Sphere { center -1.1 1 0 radius 1 }\n\
    Sphere { center 1.05 1 0.2 radius 1 }\n\
    Sphere { center 0 0.5 1.9 radius 0.5 }";

const CAMERA: &str = "PerspectiveCamera { center 0 2.5 7  direction 0 -0.3 -1  up 0 1 0  angle 40 }";

/// The mean of a white world's picture and its standard error, and the brightest channel.
fn white_world(material: &str, flags: &str) -> (f64, f64, f64) {
    let text = scene(CAMERA, "1 1 1", &[], &[material], BALLS);
    let stage = Stage::new(&text, &[], &format!("-size 16 16 -sampler random -spp 128 {flags}"));
    let film = stage.film(5);
    let values: Vec<f64> = film.pixels().iter().map(|p| f64::from(p.element_sum()) / 3.0).collect();
    // Pixels differ more than their noise does, so this is more than the error.
    let (mean_value, error) = mean_and_error(&values);
    (mean_value, error, mean(&film).max_element())
}

/// White things in a white world cannot be seen.
pub fn furnace(stress: &Stress) {
    stress.case("p13 white furnace, off 1 in σ", || {
        let mut worst: f64 = 0.0;
        let conserving = [
            "diffuseColor 1 1 1",
            "diffuseColor 0 0 0 reflectiveColor 1 1 1",
            "diffuseColor 0 0 0 transparentColor 1 1 1 indexOfRefraction 1.5",
            "diffuseColor 0 0 0 transparentColor 1 1 1 indexOfRefraction 0.7",
            "diffuseColor 0.5 0.5 0.5 reflectiveColor 0.5 0.5 0.5",
            "diffuseColor 1 1 1 reflectiveColor 1 1 1 transparentColor 1 1 1 indexOfRefraction 1.3",
        ];
        for material in conserving {
            for flags in ["", "-integrator nee -rr_depth 0", "-integrator naive -rr_depth 100"] {
                let (mean, error, most) = white_world(material, flags);
                assert!(error <= 0.001, "{material} {flags}: ± {error}");
                worst = worst.max((mean - 1.0).abs() / (error + 1e-5 / 3.0));
                assert!((mean - 1.0).abs() <= 3.0 * error + 1e-5, "{material} {flags}: {mean} ± {error}");
                assert!(most <= 1.001, "{material} {flags}: {most}");
            }
        }
        Ok(worst)
    });
}

/// The same light as a picture of the sky, which is asked for: weights must come out even.
pub fn white_sky(stress: &Stress) {
    stress.case("p13 white things under a white sky", || {
        let sky: Vec<u8> =
            b"PF\n8 4\n-1.0\n".iter().copied().chain([1f32.to_le_bytes(); 96].concat()).collect();
        let half = "diffuseColor 0.5 0.5 0.5 reflectiveColor 0.5 0.5 0.5";
        for (material, integrator, samples) in
            [("diffuseColor 1 1 1", "nee", 2048), ("diffuseColor 1 1 1", "mis", 512), (half, "mis", 512)]
        {
            let text = scene(CAMERA, "0 0 0 environment sky.pfm", &[], &[material], BALLS);
            let flags = format!("-size 16 16 -spp {samples} -integrator {integrator}");
            let film = Stage::new(&text, &[("sky.pfm", &sky)], &flags).film(6);
            let values: Vec<f64> = film.pixels().iter().map(|p| f64::from(p.element_sum()) / 3.0).collect();
            let (mean, error) = mean_and_error(&values);
            assert!(error <= 0.001, "{material} {integrator}: ± {error}");
            assert!((mean - 1.0).abs() <= 3.0 * error, "{material} {integrator}: {mean} ± {error}");
        }
        Ok(0.0)
    });
}

/// Through the middle of a ball that bends nothing, of radius 1 and in front of a white world, comes
/// exp(−2·absorption).
pub fn absorption(stress: &Stress) {
    stress.case("p13 absorption, off exp(−k t)", || {
        let camera = "PerspectiveCamera { center 0 0 5  direction 0 0 -1  up 0 1 0  angle 0.5 }";
        let glass = "diffuseColor 0 0 0 transparentColor 1 1 1 indexOfRefraction 1 absorption 0.25 0.5 1";
        let text = scene(camera, "1 1 1", &[], &[glass], "Sphere { center 0 0 0 radius 1 }");
        let film = Stage::new(&text, &[], "-size 4 4 -spp 4").film(1);
        let found = mean(&film);
        let off =
            (0..3).map(|i| (found[i] - (-2.0 * [0.25f64, 0.5, 1.0][i]).exp()).abs()).fold(0.0, f64::max);
        assert!(off < 2e-4, "{found}");
        Ok(off)
    });
}

/// Glossy things in a white world are not brighter than it.
pub fn glossy(stress: &Stress) {
    stress.case("p13 glossy things, brightest", || {
        let mut brightest: f64 = 0.0;
        for material in [
            "diffuseColor 0 0 0 specularColor 1 1 1 exponent 1",
            "diffuseColor 0 0 0 specularColor 1 1 1 exponent 30",
            "diffuseColor 0 0 0 specularColor 1 1 1 exponent 1000",
            "diffuseColor 1 1 1 specularColor 1 1 1 exponent 30",
            "diffuseColor 0.6 0.6 0.6 specularColor 0.4 0.4 0.4 exponent 8 reflectiveColor 0.3 0.3 0.3",
        ] {
            let (mean, _, most) = white_world(material, "");
            brightest = brightest.max(most);
            assert!(most <= 1.001, "{material}: {most}");
            assert!(mean > 0.2, "{material}: {mean}");
        }
        Ok(brightest)
    });
}

/// A closed shape that faces inwards, around the eye.
fn shell(emission: f64, albedo: f64, samples: u32, flags: &str) -> Stage {
    let mut mesh = convex_sphere(2);
    mesh.triangles.iter_mut().for_each(|corners| corners.swap(1, 2));
    let camera = "PerspectiveCamera { center 0.2 0.1 -0.3  direction 0 0 -1  up 0 1 0  angle 90 }";
    let material =
        format!("diffuseColor {albedo} {albedo} {albedo} emissiveColor {emission} {emission} {emission}");
    let text = scene(camera, "0 0 0", &[], &[&material], "TriangleMesh { obj_file shell.obj }");
    Stage::new(&text, &[("shell.obj", obj(&mesh).as_bytes())], &format!("-size 8 8 -spp {samples} {flags}"))
}

/// A closed shell has the radiance of the geometric series: 1.
pub fn shells(stress: &Stress) {
    stress.case("p13 closed shells, off 1 / 0.005", || {
        let mut worst: f64 = 0.0;
        let depths: &[u32] = if stress.tier().is_thorough() { &[0, 3, 20] } else { &[3] };
        for (emission, albedo) in [(0.25, 0.75), (0.6, 0.4)] {
            for integrator in ["naive", "nee", "mis"] {
                for &depth in depths {
                    let stage =
                        shell(emission, albedo, 256, &format!("-integrator {integrator} -rr_depth {depth}"));
                    let mean = stage.mean(1).x;
                    worst = worst.max((mean - 1.0).abs() / 0.005);
                    assert!((mean - 1.0).abs() <= 0.005, "albedo {albedo} {integrator} {depth}: {mean}");
                }
            }
        }
        Ok(worst)
    });
}

/// Property 14: a path that is cut short lacks the rest of the series.
pub fn cut_short(stress: &Stress) {
    stress.case("p14 paths cut short", || {
        let (emission, albedo) = (0.3, 0.7f64);
        for integrator in ["naive", "nee", "mis"] {
            for bounces in [0, 1, 2, 5] {
                let stage =
                    shell(emission, albedo, 32, &format!("-integrator {integrator} -bounces {bounces}"));
                let means: Vec<f64> = (0..8).map(|seed| stage.mean(seed).x).collect();
                // What is seen at once, what has been sent on once, … and so many times more.
                let sum = emission * (1.0 - albedo.powi(bounces + 2)) / (1.0 - albedo);
                let (mean, error) = mean_and_error(&means);
                assert!(
                    (mean - sum).abs() <= 4.0 * error + 1e-6,
                    "{integrator} {bounces}: {mean} ± {error}, not {sum}"
                );
                assert!(error < 0.005 * sum, "{integrator} {bounces}: ± {error}");
            }
        }
        Ok(0.0)
    });
}

/// Property 8: a closed box without a light is black.
pub fn black_box(stress: &Stress) {
    stress.case("p08 path tracing in a closed box", || {
        for material in ["diffuseColor 1 1 1", "diffuseColor 0.3 0.3 0.3 reflectiveColor 0.6 0.6 0.6"] {
            let camera = "PerspectiveCamera { center 0.2 0.1 -0.3  direction 1 1 -1  up 0 1 0  angle 90 }";
            let cube = tests::binary::workspace_bytes("scenes/meshes/cube.obj");
            let text = scene(camera, "9 9 9", &[], &[material], "TriangleMesh { obj_file cube.obj }");
            let stage = Stage::new(&text, &[("cube.obj", &cube)], "-size 16 16 -spp 16 -bounces 20");
            assert_eq!(stage.mean(3), common::math::DVec3::ZERO, "{material}");
        }
        Ok(0.0)
    });
}
