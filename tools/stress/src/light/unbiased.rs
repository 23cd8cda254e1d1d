//! Property 14: every way to find the light finds the same light.

use super::stage::{Stage, mean_and_error, obj, scene};
use crate::Stress;
use crate::kit::convex_sphere;
use common::mesh::Mesh;
use rayon::prelude::*;

const SEEDS: u64 = 64;

/// A scene, the files beside it, and its name.
struct Place {
    name: &'static str,
    text: String,
    files: Vec<(&'static str, Vec<u8>)>,
}

const FRONT: &str = "PerspectiveCamera { center 0 1.6 5  direction 0 -0.2 -1  up 0 1 0  angle 45 }";
const WHITE: &str = "diffuseColor 0.75 0.6 0.7";
const FLOOR: &str = "MaterialIndex 0 Plane { normal 0 1 0 offset 0 }";

fn lamp(radiance: f64) -> String {
    format!("diffuseColor 0 0 0 emissiveColor {radiance} {radiance} {radiance}")
}

fn place(name: &'static str, materials: &[&str], objects: &str) -> Place {
    Place { name, text: scene(FRONT, "0 0 0", &[], materials, objects), files: Vec::new() }
}

/// Walls, a lamp of a ninth of the ceiling, and a block's worth of shadow.
fn room() -> Place {
    let camera = "PerspectiveCamera { center 0 0 0.95  direction 0 0 -1  up 0 1 0  angle 80 }";
    let objects = "MaterialIndex 0 TriangleMesh { obj_file cube.obj }\n\
        MaterialIndex 1 Triangle { vertex0 -0.3 0.98 -0.3 vertex1 0.3 0.98 -0.3 vertex2 0.3 0.98 0.3 }\n\
        Triangle { vertex0 -0.3 0.98 -0.3 vertex1 0.3 0.98 0.3 vertex2 -0.3 0.98 0.3 }\n\
        MaterialIndex 2 Sphere { center -0.3 -0.5 -0.2 radius 0.4 }";
    let text = scene(camera, "0 0 0", &[], &[WHITE, &lamp(5.0), "diffuseColor 0.2 0.5 0.3"], objects);
    Place {
        name: "room",
        text,
        files: vec![("cube.obj", tests::binary::workspace_bytes("scenes/meshes/cube.obj"))],
    }
}

/// A shining ball above a floor that mirrors it in a blur.
fn gloss() -> Place {
    let floor = "diffuseColor 0.3 0.3 0.3 specularColor 0.6 0.5 0.4 exponent 40";
    place(
        "gloss",
        &[floor, &lamp(3.0)],
        &format!("{FLOOR}\nMaterialIndex 1 Sphere {{ center 0 1.2 -0.5 radius 0.6 }}"),
    )
}

/// Thirty-two shining triangles.
fn mesh() -> Place {
    let objects = format!(
        "{FLOOR}\nMaterialIndex 1 Transform {{ Translate 0.6 1.4 0 UniformScale 0.5 TriangleMesh {{ obj_file ball.obj }} }}\n\
         MaterialIndex 0 Sphere {{ center -0.9 0.6 0.3 radius 0.6 }}"
    );
    let mesh: Mesh = convex_sphere(1);
    Place {
        files: vec![("ball.obj", obj(&mesh).into_bytes())],
        ..place("mesh", &[WHITE, &lamp(4.0)], &objects)
    }
}

/// A strong lamp behind a ball, and a faint one.
fn two() -> Place {
    let objects = format!(
        "{FLOOR}\nMaterialIndex 1 Sphere {{ center -1.6 1.8 -1 radius 0.35 }}\n\
         MaterialIndex 2 Sphere {{ center 1.3 0.8 0.6 radius 0.7 }}\n\
         MaterialIndex 0 Sphere {{ center -0.4 0.7 -0.2 radius 0.7 }}"
    );
    place("two lamps", &[WHITE, &lamp(30.0), &lamp(0.2)], &objects)
}

/// Lamp light through glass and off a mirror.
fn caustic() -> Place {
    let objects = format!(
        "{FLOOR}\nMaterialIndex 1 Sphere {{ center 0 3.2 0 radius 0.9 }}\n\
         MaterialIndex 2 Sphere {{ center -0.8 0.8 0.3 radius 0.7 }}\n\
         MaterialIndex 3 Sphere {{ center 0.8 0.8 0.3 radius 0.7 }}"
    );
    let glass = "diffuseColor 0 0 0 transparentColor 1 1 1 indexOfRefraction 1.5 absorption 0.2 0.4 0.1";
    let mirror = "diffuseColor 0.2 0.2 0.2 reflectiveColor 0.7 0.7 0.7";
    place("glass and mirror", &[WHITE, &lamp(3.0), glass, mirror], &objects)
}

/// A sky with a bright window, and a lamp besides.
fn sky() -> Place {
    let camera = FRONT;
    let objects = format!(
        "{FLOOR}\nMaterialIndex 0 Sphere {{ center -0.9 0.8 0 radius 0.8 }}\n\
         MaterialIndex 1 Sphere {{ center 1.2 1.0 0 radius 0.5 }}"
    );
    let text = scene(camera, "0 0 0 environment sky.pfm", &[], &[WHITE, &lamp(2.0)], &objects);
    let mut bytes = b"PF\n8 4\n-1.0\n".to_vec();
    for y in 0..4u32 {
        for x in 0..8u32 {
            let radiance: [f32; 3] =
                if (x, y) == (2, 3) { [9.0, 8.0, 6.0] } else { [0.2, 0.3, 0.1 * y as f32] };
            radiance.iter().for_each(|r| bytes.extend(r.to_le_bytes()));
        }
    }
    Place { name: "sky", text, files: vec![("sky.pfm", bytes)] }
}

impl Place {
    /// Mean of the picture over many seeds, which depend on `family`, and its standard error.
    fn light(&self, flags: &str, family: u64) -> (f64, f64) {
        let files: Vec<(&str, &[u8])> = self.files.iter().map(|(name, bytes)| (*name, &bytes[..])).collect();
        let stage = Stage::new(&self.text, &files, &format!("-size 8 8 {flags}"));
        let means: Vec<f64> = (0..SEEDS)
            .into_par_iter()
            .map(|seed| stage.mean(seed + 1000 * family).element_sum() / 3.0)
            .collect();
        mean_and_error(&means)
    }

    /// Whether variants of the flags see as much light as `usual`; by how many σ they differ at
    /// most.
    fn compare(&self, usual: &str, variants: &[&str]) -> f64 {
        let mut worst: f64 = 0.0;
        let (expected, error) = self.light(usual, 0);
        assert!(expected > 0.01, "{}: {expected}", self.name);
        for (flags, family) in variants.iter().zip(1..) {
            let (mean, own) = self.light(flags, family);
            let off = (mean - expected) / own.hypot(error);
            assert!(off.abs() <= 4.0, "{} {flags}: {mean} ± {own}, not {expected} ± {error}", self.name);
            worst = worst.max(off.abs());
        }
        worst
    }
}

pub fn integrators(stress: &Stress) {
    let (quick, more) = ([room(), caustic(), sky()], [gloss(), mesh(), two()]);
    let more = more.into_iter().filter(|_| stress.tier().is_thorough());
    for place in quick.into_iter().chain(more) {
        stress.case(format!("p14 integrators and roulette, {}, in σ", place.name), || {
            Ok(place.compare(
                "-spp 16",
                &[
                    "-spp 32 -integrator naive",
                    "-spp 16 -integrator nee",
                    "-spp 8 -rr_depth 0",
                    "-spp 8 -rr_depth 3",
                    "-spp 4 -rr_depth 100 -bounces 100",
                    "-spp 16 -integrator naive -sampler random -rr_depth 3",
                ],
            ))
        });
    }
}

pub fn samplers(stress: &Stress) {
    let samplers = ["random", "jittered", "multi_jittered", "halton", "r2", "blue_noise"];
    let flags = samplers.map(|name| format!("-spp 16 -sampler {name}"));
    let more = [sky()].into_iter().filter(|_| stress.tier().is_thorough());
    for place in [room()].into_iter().chain(more) {
        let flags = flags.each_ref().map(String::as_str);
        stress.case(format!("p14 samplers, {}, in σ", place.name), || Ok(place.compare("-spp 16", &flags)));
    }
}

/// Each bounce adds light, and all of them are the limit.
pub fn bounces(stress: &Stress) {
    stress.case("p14 bounces", || {
        for place in [room(), mesh(), sky()] {
            let (all, error) = place.light("-spp 16", 0);
            let mut before = 0.0;
            for (bounces, family) in [0, 1, 2, 40].into_iter().zip(1..) {
                let (mean, own) = place.light(&format!("-spp 16 -bounces {bounces}"), family);
                assert!(mean >= before - 4.0 * own, "{} {bounces}: {mean} after {before}", place.name);
                assert!(mean <= all + 4.0 * own.hypot(error), "{} {bounces}: {mean} of {all}", place.name);
                before = mean;
            }
            assert!((before - all).abs() <= 4.0 * error.hypot(error), "{}: {before}, not {all}", place.name);
        }
        Ok(0.0)
    });
}

/// Light of a square lamp on a floor straight below one of its corners, as a share of the lamp's
/// radiance times π: the point-to-rectangle form factor (Howell, configuration B-4).
fn form_factor(x: f64, y: f64) -> f64 {
    let part = |a: f64, b: f64| a / (1.0 + a * a).sqrt() * (b / (1.0 + a * a).sqrt()).atan();
    (part(x, y) + part(y, x)) / std::f64::consts::TAU
}

/// The direct light of a square is its form factor.
pub fn direct_light(stress: &Stress) {
    stress.case("p14 direct light of a square, in σ", || {
        let camera = "PerspectiveCamera { center 0 1 0  direction 0 -1 0  up 0 0 -1  angle 0.01 }";
        let objects = format!(
            "{FLOOR}\nMaterialIndex 1 Triangle {{ vertex0 0 2 0 vertex1 1.5 2 0 vertex2 1.5 2 1 }}\n\
         Triangle {{ vertex0 0 2 0 vertex1 1.5 2 1 vertex2 0 2 1 }}"
        );
        let text = scene(camera, "0 0 0", &[], &["diffuseColor 0.5 0.5 0.5", &lamp(10.0)], &objects);
        let expected = 0.5 * 10.0 * form_factor(1.5 / 2.0, 1.0 / 2.0);
        let mut worst: f64 = 0.0;
        for flags in ["-spp 64", "-spp 64 -integrator nee", "-spp 4096 -integrator naive"] {
            let stage = Stage::new(&text, &[], &format!("-size 4 4 -bounces 0 {flags}"));
            let means: Vec<f64> = (0..16).map(|seed| stage.mean(seed).x).collect();
            let (mean, error) = mean_and_error(&means);
            worst = worst.max((mean - expected).abs() / (error + 2.5e-7 * expected));
            assert!(
                (mean - expected).abs() <= 4.0 * error + 1e-6 * expected,
                "{flags}: {mean}, not {expected}"
            );
            assert!(error < 0.004 * expected, "{flags}: ± {error}");
        }
        Ok(worst)
    });
}
