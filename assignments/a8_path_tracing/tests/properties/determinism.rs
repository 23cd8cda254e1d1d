//! Property 16 by the program itself: the same picture, bit for bit, with any instructions.

use std::fs;
use stress::kit::lumpy_sphere;
use stress::light::stage::{obj, scene};
use tests::binary::{Binary, Scratch};

const PROGRAM: Binary = Binary { path: env!("CARGO_BIN_EXE_a8_path_tracing"), assignment: 8 };

/// Something of everything: a mesh, glass, a mirror, gloss, lamps of four kinds, a lens.
fn everything() -> String {
    let camera = "PerspectiveCamera { center 0 1.6 5  direction 0 -0.2 -1  up 0 1 0  angle 45  aperture 0.1  focalDistance 5 }";
    let objects = "MaterialIndex 0 Plane { normal 0 1 0 offset 0 }\n\
        MaterialIndex 1 Sphere { center -1 0.7 0.6 radius 0.6 }\n\
        MaterialIndex 2 Sphere { center 1.2 0.7 0 radius 0.7 }\n\
        MaterialIndex 3 Sphere { center 0 2.6 0 radius 0.3 }\n\
        Triangle { vertex0 -2 2 -1 vertex1 -1 2 -1 vertex2 -1 2 0 }\n\
        MaterialIndex 4 Transform { Translate 0 1 -0.6 TriangleMesh { obj_file lumps.obj } }";
    let lights = [
        "PointLight { position 2 3 2 color 0.5 0.2 0.2 }",
        "DirectionalLight { direction 1 -1 -0.3 color 0.1 0.2 0.3 }",
        "SphereLight { center -2 3 1 radius 0.4 color 0.2 0.2 0.3 }",
    ];
    let materials = [
        "diffuseColor 0.7 0.6 0.5 specularColor 0.2 0.2 0.2 exponent 30",
        "diffuseColor 0 0 0 transparentColor 1 0.95 0.9 indexOfRefraction 1.5 absorption 0.3 0.1 0.5",
        "diffuseColor 0.1 0.1 0.2 reflectiveColor 0.8 0.8 0.7",
        "diffuseColor 0 0 0 emissiveColor 6 5 4",
        "diffuseColor 0.3 0.6 0.4",
    ];
    scene(camera, "0.1 0.15 0.2", &lights, &materials, objects)
}

fn lumps() -> Vec<u8> {
    obj(&lumpy_sphere(3, 7)).into_bytes()
}

/// The program's float picture with an instruction set; `None` if the machine has it not.
fn drawn(scratch: &Scratch, simd: &str) -> Option<Vec<u8>> {
    let line = format!("-input scene.txt -output out.pfm -size 37 23 -spp 12 -threads 2 -simd {simd}");
    let outcome = PROGRAM.run(scratch.path(), &line.split_whitespace().collect::<Vec<_>>());
    if outcome.stderr.contains("does not offer") {
        return None;
    }
    assert_eq!(outcome.code, Some(0), "{}", outcome.stderr);
    Some(fs::read(scratch.file("out.pfm")).expect("it was written"))
}

#[test]
fn p16_instruction_sets_change_no_bit() {
    let scratch = Scratch::new(&[("scene.txt", everything().as_bytes()), ("lumps.obj", &lumps())]);
    let expected = drawn(&scratch, "baseline").expect("every machine has it");
    for simd in ["auto", "sse4", "avx2", "avx512"] {
        let Some(bytes) = drawn(&scratch, simd) else { continue };
        assert!(bytes == expected, "-simd {simd} changes the picture");
    }
}
