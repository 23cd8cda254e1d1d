//! Scenes from text, and their pictures by rays, for the tests of this crate.
#![allow(dead_code)] // each test file uses its own part

use a1_ray_casting::{CastArgs, Layer, Studio};
use a3_phong::{PhongArgs, Resolution, Tessellation, Tessellator};
use common::accel::{Accel, List};
use common::camera::{Camera, screen_position};
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::Vec3;
use common::mesh::{Mesh, MeshError};
use common::picture::{Film, Size};
use common::scene::{MeshSource, parse_str};
use std::sync::Arc;

/// A colour that no light of these tests makes.
pub const NOTHING: Vec3 = Vec3::new(7.0, 0.0, 7.0);

pub const ORTHOGRAPHIC: &str =
    "OrthographicCamera { center -0.49 -0.98 5 direction 0.1 0.2 -1 up 0 1 0 size 4 }";
pub const PERSPECTIVE: &str =
    "PerspectiveCamera { center 0.3 0.5 5 direction -0.05 -0.1 -1 up 0 1 0 angle 50 }";

/// One material, one sun, and a background that tells misses from everything else.
const FRAME: &str = "
    Background { color 7 0 7 ambientLight 0.1 0.1 0.1 }
    Lights { numLights 1 DirectionalLight { direction -0.3 -0.5 -1 color 0.8 0.8 0.8 } }
    Materials { numMaterials 1 PhongMaterial { diffuseColor 1 0.5 0.25 } }";

#[derive(clap::Parser)]
#[command(version, rename_all = "snake_case")]
struct Program {
    #[command(flatten)]
    args: PhongArgs,
}

/// Flags as typed.
pub fn args(flags: &str) -> PhongArgs {
    let words = std::iter::once("test").chain("-input none".split(' ')).chain(flags.split_whitespace());
    common::cli::try_parse_from::<Program>(words).unwrap_or_else(|stop| panic!("{}", stop.text)).options.args
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

/// A scene of these objects (a mesh is a cube), whatever the frame does not say by itself.
pub fn studio(camera: &str, objects: &[&str], (width, height): (i64, i64)) -> Studio {
    let text = format!(
        "{camera}{FRAME} Group {{ numObjects {} MaterialIndex 0 {} }}",
        objects.len(),
        objects.join(" ")
    );
    let scene = parse_str("test", &text, &mut Cube).unwrap_or_else(|e| panic!("{e}"));
    let geometry = Geometry::build(&scene).expect("test scenes are sound");
    let camera = Camera::new(&scene.camera);
    Studio { scene, geometry, camera, size: Size::new(width, height).unwrap() }
}

/// The scene's polygons.
pub fn polygons(studio: &Studio, theta: u32, phi: u32) -> Tessellation {
    let viewpoint = studio.scene.camera.center;
    let resolution = Resolution { theta, phi };
    Tessellator { geometry: &studio.geometry, resolution, smooth: false, viewpoint }.run()
}

/// The preview with these flags.
pub fn preview(studio: &Studio, flags: &str) -> Film {
    let args = args(flags);
    args.preview_film(studio, &studio.scene, &args.tessellate(studio).expect("flags are sound"))
}

/// The ray-traced picture of assignment 3 with these flags.
pub fn traced(studio: &Studio, flags: &str) -> Film {
    let args = args(flags);
    layer(studio, args.cast(), &args.color(&studio.scene))
}

fn layer(studio: &Studio, args: &CastArgs, layer: &dyn Layer) -> Film {
    studio.render(args, &List::new(&studio.geometry), &[layer]).0.remove(0)
}

/// Whether the ray through each pixel's centre hits anything, row by row from the bottom.
pub fn hit_mask(studio: &Studio) -> Vec<bool> {
    let list = List::new(&studio.geometry);
    let hits = |x: u32, y: u32| {
        let ray = studio.camera.ray(screen_position(studio.size, f64::from(x) + 0.5, f64::from(y) + 0.5));
        list.any(&ray, studio.camera.interval, &mut Counters::default())
    };
    let (w, h) = (studio.size.width(), studio.size.height());
    (0..h).flat_map(|y| (0..w).map(move |x| (x, y))).map(|(x, y)| hits(x, y)).collect()
}

/// Whether anything was drawn on each pixel, row by row from the bottom.
pub fn drawn_mask(film: &Film) -> Vec<bool> {
    film.pixels().iter().map(|&c| c != NOTHING).collect()
}

/// Largest difference of a channel over the pixels for which `counts` holds.
pub fn largest_difference(a: &Film, b: &Film, counts: impl Fn(usize) -> bool) -> f32 {
    let pairs = a.pixels().iter().zip(b.pixels()).enumerate();
    pairs.filter(|(i, _)| counts(*i)).map(|(_, (p, q))| (*p - *q).abs().max_element()).fold(0.0, f32::max)
}

/// A stream of numbers in [−1, 1): Marsaglia's xorshift, enough for scattering corners.
pub fn scatter(mut state: u32) -> impl FnMut() -> f64 {
    move || {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        f64::from(state) / 2f64.powi(31) - 1.0
    }
}

/// Scattered triangles, some reaching behind every camera of these tests.
pub fn soup(count: usize, seed: u32) -> Vec<String> {
    let mut next = scatter(seed);
    let mut corner = |middle: [f64; 3], spread: f64| middle.map(|m| m + spread * next());
    (0..count)
        .map(|_| {
            let middle = corner([0.0; 3], 1.5);
            let [a, b, c] = std::array::from_fn(|_| corner(middle, 0.8));
            let text = |[x, y, z]: [f64; 3]| format!("{x} {y} {z}");
            format!("Triangle {{ vertex0 {} vertex1 {} vertex2 {} }}", text(a), text(b), text(c))
        })
        .collect()
}
