//! Path-traced pictures, bit for bit, however the work is dealt out.

use super::hash;
use crate::Stress;
use crate::kit::lumpy_sphere;
use crate::light::stage::{Stage, obj, scene};
use common::tiles::TileOptions;

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

fn stage(flags: &str) -> Stage {
    Stage::new(&everything(), &[("lumps.obj", &lumps())], &format!("-size 37 23 -spp 12 {flags}"))
}

/// Threads, tiles, the way samples are dealt out, and structures change no bit.
pub fn path(stress: &Stress) {
    for (name, check) in [
        ("threads and tiles", threads_and_tiles as fn()),
        ("shares of samples", shares_of_samples),
        ("structures", structures),
        ("a part of the picture", crop),
    ] {
        stress.case(format!("p16 path tracing, {name}"), || {
            check();
            Ok(0.0)
        });
    }
}

fn threads_and_tiles() {
    let stage = stage("");
    let (expected, counted) = stage.sums(4, &[12]);
    for threads in [1, 2, 3, 7, 16] {
        for tile in [4, 8, 16, 32] {
            let options = TileOptions { threads: Some(threads), tile: Some(tile), ..TileOptions::default() };
            let (sums, counters) = stage.sums_with(4, &[12], options);
            assert!(sums == expected, "{threads} threads, tiles of {tile}");
            let work = |c: common::counters::Counters| (c.rays, c.shadow_rays, c.ended_by_roulette);
            assert_eq!(work(counters), work(counted), "{threads} threads, tiles of {tile}");
        }
    }
    assert!(stage.sums(5, &[12]).0 != expected, "another seed, another picture");
}

fn shares_of_samples() {
    for flags in ["", "-sampler random", "-sampler halton", "-integrator naive", "-sampler multi_jittered"] {
        let stage = stage(flags);
        let expected = stage.sums(4, &[12]).0;
        for ends in [&[5, 12][..], &[1, 2, 11, 12], &[3, 4, 5, 6, 7, 12]] {
            assert!(stage.sums(4, ends).0 == expected, "{flags} {ends:?}");
        }
    }
}

fn structures() {
    let expected = stage("-accel list").sums(4, &[12]).0;
    for accel in ["bvh", "kdtree", "grid -grid 5 6 7"] {
        assert!(stage(&format!("-accel {accel}")).sums(4, &[12]).0 == expected, "{accel}");
    }
}

/// The part of a picture that is drawn alone has the pixels of the whole.
fn crop() {
    let whole = stage("").film(4);
    let part = stage("-crop 5 3 29 20").film(4);
    assert_eq!((part.width(), part.height()), (24, 17));
    for y in 0..17 {
        let row = &whole.row(y + 3)[5..29];
        assert_eq!(part.row(y), row, "row {y}");
    }
}

/// A picture as a number.
pub(super) fn everything_hashed() -> u64 {
    let film = stage("").film(4);
    hash(film.pixels().iter().flat_map(|c| c.to_array().map(f32::to_bits)))
}
