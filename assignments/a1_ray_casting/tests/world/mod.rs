//! Scenes from text and their layers, for the tests of this crate.
#![allow(dead_code)] // each test file uses its own part

use a1_ray_casting::{CastArgs, Depth, FlatColor, Layer, Studio};
use common::accel::List;
use common::camera::Camera;
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::Vec3;
use common::mesh::{Mesh, MeshError};
use common::picture::{Film, Size};
use common::scene::{MeshSource, parse_str};
use std::sync::Arc;

/// Looks along −z at the square [−2, 2]² from z = 5.
pub const FRONT: &str = "OrthographicCamera { center 0 0 5 direction 0 0 -1 up 0 1 0 size 4 }";
pub const UNIT_SPHERE: &str = "Sphere { center 0 0 0 radius 1 }";

const FRAME: &str = "
    Background { color 0.25 0.5 0.75 }
    Materials { numMaterials 2 Material { diffuseColor 1 0 0 } Material { diffuseColor 0 0.5 1 } }";

#[derive(clap::Parser)]
#[command(version, rename_all = "snake_case")]
struct Program {
    #[command(flatten)]
    args: CastArgs,
}

/// Flags as typed; the scene is called `none`.
pub fn args(flags: &str) -> CastArgs {
    let words = format!("test -input none {flags}");
    let parsed = common::cli::try_parse_from::<Program>(words.split_whitespace());
    parsed.unwrap_or_else(|stop| panic!("{}", stop.text)).options.args
}

struct NoMeshes;

impl MeshSource for NoMeshes {
    fn mesh(&mut self, name: &str) -> Result<Arc<Mesh>, MeshError> {
        Err(MeshError::new(name))
    }
}

/// A scene of these objects, the first material in force.
pub fn studio(camera: &str, objects: &[&str], (width, height): (i64, i64)) -> Studio {
    let (count, all) = (objects.len(), objects.join(" "));
    let text = format!("{camera}{FRAME} Group {{ numObjects {count} MaterialIndex 0 {all} }}");
    let scene = parse_str("test", &text, &mut NoMeshes).unwrap_or_else(|e| panic!("{e}"));
    let geometry = Geometry::build(&scene).expect("test scenes are sound");
    let camera = Camera::new(&scene.camera);
    Studio { scene, geometry, camera, size: Size::new(width, height).unwrap() }
}

/// One layer's picture, and what was counted.
pub fn render(studio: &Studio, flags: &str, layer: &dyn Layer) -> (Film, Counters) {
    let list = List::new(&studio.geometry);
    let (mut films, counters) = studio.render(&args(flags), &list, &[layer]);
    (films.remove(0), counters)
}

/// The flat-coloured picture.
pub fn flat(studio: &Studio, flags: &str) -> Film {
    render(studio, flags, &FlatColor::new(&studio.scene)).0
}

/// The depth picture.
pub fn depth(studio: &Studio, min: f32, max: f32) -> Film {
    render(studio, "", &Depth { min, max }).0
}

/// The distances themselves, NaN where nothing was hit.
pub fn distances(studio: &Studio) -> Film {
    struct Distance;
    impl Layer for Distance {
        fn value(&self, sight: &a1_ray_casting::Sight, _: &mut Counters) -> Vec3 {
            Vec3::splat(sight.hit.map_or(f32::NAN, |hit| hit.t))
        }
    }
    render(studio, "", &Distance).0
}

/// The pixels of a square picture with their centres' positions on [−2, 2]².
pub fn positions(side: u32) -> impl Iterator<Item = (u32, u32, f64, f64)> {
    let at = move |i: u32| (f64::from(i) + 0.5) / f64::from(side) * 4.0 - 2.0;
    (0..side).flat_map(move |j| (0..side).map(move |i| (i, j, at(i), at(j))))
}
