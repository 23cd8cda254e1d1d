//! Scenes from text and their pictures, for the tests of this crate.
#![allow(dead_code)] // each test file uses its own part

use a1_ray_casting::{Layer, Sight, Studio};
use a2_transforms::{DiffuseArgs, DiffuseColor, Normals};
use common::accel::List;
use common::camera::Camera;
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::Vec3;
use common::mesh::{Mesh, MeshError};
use common::picture::{Film, Size};
use common::scene::{MeshSource, parse_str};
use std::sync::Arc;

/// Side of all pictures in pixels.
pub const SIDE: u32 = 60;
/// Looks along −z at the square [−2, 2]² from z = 5.
pub const FRONT: &str = "OrthographicCamera { center 0 0 5 direction 0 0 -1 up 0 1 0 size 4 }";
pub const PERSPECTIVE: &str = "PerspectiveCamera { center 1 2 5 direction -0.2 -0.4 -1 up 0 1 0 angle 40 }";
pub const UNIT_SPHERE: &str = "Sphere { center 0 0 0 radius 1 }";
/// A mesh with corners at ±1.
pub const CUBE: &str = "TriangleMesh { obj_file cube }";
/// Shines along −z, full white.
pub const SUN: &str = "DirectionalLight { direction 0 0 -2 color 1 1 1 }";

#[derive(clap::Parser)]
#[command(version, rename_all = "snake_case")]
struct Program {
    #[command(flatten)]
    args: DiffuseArgs,
}

/// Flags as typed; the scene is called `none`.
pub fn args(flags: &str) -> DiffuseArgs {
    let words = format!("test -input none {flags}");
    let parsed = common::cli::try_parse_from::<Program>(words.split_whitespace());
    parsed.unwrap_or_else(|stop| panic!("{}", stop.text)).options.args
}

struct Cube;

impl MeshSource for Cube {
    fn mesh(&mut self, _: &str) -> Result<Arc<Mesh>, MeshError> {
        let sign = |i: u32, bit: u32| if i & bit == 0 { -1.0 } else { 1.0 };
        let positions = (0..8).map(|i| Vec3::new(sign(i, 1), sign(i, 2), sign(i, 4))).collect();
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        Ok(Arc::new(Mesh { positions, triangles, ..Mesh::default() }))
    }
}

/// A scene of these lights and objects; the material is (1, ½, ¼), ambient light 0.2 red.
pub fn studio(camera: &str, lights: &[&str], objects: &[&str]) -> Studio {
    let text = format!(
        "{camera} Background {{ color 0 0 0.5 ambientLight 0.2 0 0 }} Lights {{ numLights {} {} }}
         Materials {{ numMaterials 1 Material {{ diffuseColor 1 0.5 0.25 }} }}
         Group {{ numObjects {} MaterialIndex 0 {} }}",
        lights.len(),
        lights.join(" "),
        objects.len(),
        objects.join(" ")
    );
    let scene = parse_str("test", &text, &mut Cube).unwrap_or_else(|e| panic!("{e}"));
    let geometry = Geometry::build(&scene).expect("test scenes are sound");
    let camera = Camera::new(&scene.camera);
    Studio { scene, geometry, camera, size: Size::new(SIDE.into(), SIDE.into()).unwrap() }
}

fn render(studio: &Studio, flags: &str, layer: &dyn Layer) -> Film {
    studio.render(&args(flags).cast, &List::new(&studio.geometry), &[layer]).0.remove(0)
}

/// The colour picture.
pub fn color(studio: &Studio, flags: &str) -> Film {
    let light = args(flags).local_light(&studio.scene);
    render(studio, flags, &DiffuseColor { scene: &studio.scene, light })
}

/// The picture of normals.
pub fn normals(studio: &Studio, flags: &str) -> Film {
    render(studio, flags, &Normals)
}

/// The normals with their signs; zero where nothing is.
pub fn signed_normals(studio: &Studio) -> Film {
    struct Signed;
    impl Layer for Signed {
        fn value(&self, sight: &Sight, _: &mut Counters) -> Vec3 {
            sight.surface().map_or(Vec3::ZERO, |s| s.normal)
        }
    }
    render(studio, "", &Signed)
}

/// The distances; −1 where nothing is hit.
pub fn distances(studio: &Studio) -> Film {
    struct Distance;
    impl Layer for Distance {
        fn value(&self, sight: &Sight, _: &mut Counters) -> Vec3 {
            Vec3::splat(sight.hit.map_or(-1.0, |hit| hit.t))
        }
    }
    render(studio, "", &Distance)
}

/// The pixels with their centres' positions on [−2, 2]².
pub fn positions() -> impl Iterator<Item = (u32, u32, f32, f32)> {
    let at = |i: u32| (i as f32 + 0.5) / SIDE as f32 * 4.0 - 2.0;
    (0..SIDE).flat_map(move |j| (0..SIDE).map(move |i| (i, j, at(i), at(j))))
}

/// Largest difference of any channel.
pub fn difference(a: &Film, b: &Film) -> f32 {
    a.pixels().iter().zip(b.pixels()).map(|(p, q)| (*p - *q).abs().max_element()).fold(0.0, f32::max)
}

/// `object` under a list of transforms.
pub fn transformed(list: &str, object: &str) -> String {
    format!("Transform {{ {list} {object} }}")
}
