//! Surfaces left eight at a time and one by one: the same picture, to the bit.

use stress::light::everything::{everything, lumps};
use stress::light::stage::{Stage, scene};

const CAMERA: &str = "PerspectiveCamera { center 0 1.6 5  direction 0 -0.2 -1  up 0 1 0  angle 45 }";

/// Glass, mirrors, matt things and a board, with whatever shines.
fn still_life(lights: &[&str], lamp: &str) -> String {
    let materials = [
        "diffuseColor 0.7 0.6 0.5",
        "diffuseColor 0 0 0 transparentColor 1 0.95 0.9 indexOfRefraction 1.5 absorption 0.3 0.1 0.5",
        "diffuseColor 0 0 0 reflectiveColor 0.8 0.8 0.7",
        "diffuseColor 0 0 0 emissiveColor 6 5 4",
        "diffuseColor 0.3 0.6 0.4",
        "diffuseColor 0 0 0 transparentColor 1 1 1 indexOfRefraction 0.8",
    ];
    let objects = format!(
        "MaterialIndex 6 Plane {{ normal 0 1 0 offset 0 }}\n\
         MaterialIndex 1 Sphere {{ center -1 0.7 0.6 radius 0.6 }}\n\
         MaterialIndex 2 Sphere {{ center 1.2 0.7 0 radius 0.7 }}\n\
         MaterialIndex 5 Sphere {{ center 0.2 0.3 1.6 radius 0.3 }}\n\
         MaterialIndex 3 {lamp}\n\
         MaterialIndex 2 Triangle {{ vertex0 -3 0 -2 vertex1 3 0 -2 vertex2 0 4 -2 }}\n\
         MaterialIndex 4 Transform {{ Translate 0 1 -0.6 TriangleMesh {{ obj_file lumps.obj }} }}"
    );
    let checkers = "Checkerboard { Transform { Scale 0.7 0 0.7 } materialIndex 0 materialIndex 4 }";
    let text = scene(CAMERA, "0.1 0.15 0.2", lights, &materials, &objects);
    let text = text.replace("numMaterials 6", "numMaterials 7");
    text.replacen("}\nGroup", &format!("{checkers} }}\nGroup"), 1)
}

#[test]
fn no_bit_tells_how_many_surfaces_are_looked_at_together() {
    let ball = "Sphere { center 0 3.2 1 radius 0.5 }";
    let around = "Sphere { center 0 1 1 radius 60 }";
    let triangle = "Triangle { vertex0 -1 3 0 vertex1 1 3 0 vertex2 0 3 1.5 }";
    let point = "PointLight { position 2 3 2 color 0.5 0.2 0.2 }";
    let lumps = lumps();
    let scenes = [
        still_life(&[], ball),
        still_life(&[], around),
        still_life(&[point], ball),
        still_life(&[], &format!("{ball}\n{}", ball.replace("0 3.2", "1 3.2"))),
        still_life(&[], triangle),
        everything(),
    ];
    let flags = ["-integrator naive", "-integrator nee", "", "-sampler halton -bounces 2", "-rr_depth 0"];
    for scene in &scenes {
        for flags in flags {
            let sums = |more: &str| {
                let flags = format!("-size 21 17 -spp 4 {flags} {more}");
                Stage::new(scene, &[("lumps.obj", &lumps)], &flags).sums(1, &[1, 2, 4]).0
            };
            let abreast = sums("-aov albedo a.png -aov normal n.png -aov depth d.png");
            let alone = sums("-noskip behind -aov albedo a.png -aov normal n.png -aov depth d.png");
            assert!(abreast == alone, "{flags}\n{scene}");
            assert!(abreast.radiance(100).is_finite());
        }
    }
}
