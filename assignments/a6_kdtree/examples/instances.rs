//! One mesh of 40,000 triangles used 64 times, and others like it: one tree for all copies against
//! one flat tree. Prints how long one thread builds, bytes, and rays per second of both (medians).
//!
//!     cargo run --release -p a6_kdtree --example instances [ROUNDS]

use a6_kdtree::bvh::Bvh;
use a6_kdtree::instances::{Instances, Options};
use common::accel::Accel;
use common::counters::Counters;
use common::geometry::{Geometry, Hit};
use common::math::{Interval, Vec3};
use common::ray::Ray;
use common::scene::load;
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::path::Path;
use std::time::Instant;

/// `side`³ copies of a mesh, each turned its own way, two apart in a cube.
fn scene(mesh: &str, side: usize) -> Geometry {
    let meshes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let copies: String = (0..side.pow(3))
        .map(|i| {
            let (x, y, z) = (2 * (i % side), 2 * (i / side % side), 2 * (i / side / side));
            format!(
                "Transform {{ Translate {x} {y} {z} UniformScale 6 YRotate {} XRotate {} TriangleMesh {{ obj_file {mesh} }} }}\n",
                37 * i,
                11 * i
            )
        })
        .collect();
    let text = format!(
        "PerspectiveCamera {{ center 0 0 9 direction 0 0 -1 up 0 1 0 angle 30 }}
         Materials {{ numMaterials 1 Material {{ }} }}
         Group {{ numObjects {} MaterialIndex 0 {copies} }}",
        side.pow(3)
    );
    let folder = tempfile::tempdir().expect("a folder for the scene");
    let file = folder.path().join("copies.txt");
    std::fs::write(&file, text.replace("obj_file ", &format!("obj_file {}/", meshes.display())))
        .expect("the scene is written");
    Geometry::build(&load(&file).unwrap_or_else(|e| panic!("{e}"))).expect("the copies can be placed")
}

fn unit(random: &mut Pcg64Mcg) -> f32 {
    (random.next_u32() >> 8) as f32 / (1 << 24) as f32
}

/// Rays from one point far outside through a grid of pixels, or from points inside to anywhere.
fn rays(geometry: &Geometry, coherent: bool) -> Vec<Ray> {
    let bounds = geometry.bounds().expect("there are copies");
    let (center, size) = ((bounds.min + bounds.max) / 2.0, bounds.size());
    let mut random = Pcg64Mcg::seed_from_u64(64);
    let mut ray = |i: usize| {
        let mut point = || Vec3::from_array(std::array::from_fn(|_| unit(&mut random) - 0.5));
        if !coherent {
            return Ray::new(center + point() * size, point());
        }
        let pixel = Vec3::new((i % 512) as f32 / 512.0 - 0.5, (i / 512) as f32 / 512.0 - 0.5, 0.0);
        let eye = center + Vec3::Z * size.max_element() * 1.5;
        Ray::new(eye, (center + pixel * size - eye).normalize())
    };
    (0..512 * 512).map(&mut ray).collect()
}

/// Million rays per second of `ask` on these rays, and the hits.
fn rate(rays: &[Ray], mut ask: impl FnMut(&[Ray], &mut [Option<Hit>])) -> (f64, Vec<Option<Hit>>) {
    let mut hits = vec![None; rays.len()];
    let started = Instant::now();
    for (rays, hits) in rays.chunks(256).zip(hits.chunks_mut(256)) {
        ask(rays, hits);
    }
    (rays.len() as f64 / started.elapsed().as_secs_f64() / 1e6, hits)
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn compare(name: &str, geometry: &Geometry, rounds: usize) {
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("one thread");
    let timed = |build: &mut (dyn FnMut() + Send)| {
        let started = Instant::now();
        one.install(build);
        started.elapsed().as_secs_f64() * 1e3
    };
    let (mut flat, mut two) = (None, None);
    let flat_build = timed(&mut || flat = Some(Bvh::new(geometry)));
    let mut instances_build = timed(&mut || two = Some(Instances::new(geometry, 1)));
    let (flat, two) = (flat.expect("built"), two.expect("built"));
    let all = rays(geometry, false);
    rate(&all, |r, h| two.nearest_many(r, Interval::FORWARD, h, &mut Counters::default()));
    instances_build += two.summary().time.as_secs_f64() * 1e3;
    println!(
        "{name}: {} triangles\n  build: flat {flat_build:.1} ms, {} bytes; two levels {instances_build:.1} ms, {} bytes; {:?}",
        geometry.len(),
        flat.bytes(),
        two.summary().bytes,
        two.summary(),
    );
    // No copy is fine enough to share: two levels, all in the world.
    let apart = Instances::with(geometry, 1, Options { coarsest: 0.0, ..Options::default() });
    for coherent in [true, false] {
        let rays = rays(geometry, coherent);
        let mut rates = [const { Vec::new() }; 5];
        for _ in 0..rounds {
            let mut c = Counters::default();
            let (flat_many, a) = rate(&rays, |r, h| flat.nearest_many(r, Interval::FORWARD, h, &mut c));
            let (two_many, b) = rate(&rays, |r, h| two.nearest_many(r, Interval::FORWARD, h, &mut c));
            assert!(a == b, "both must see the same");
            let apart_many = rate(&rays, |r, h| apart.nearest_many(r, Interval::FORWARD, h, &mut c)).0;
            let mut any = vec![false; 256];
            let mut any_of = |tree: &dyn Accel| {
                rate(&rays, |r, _| {
                    tree.any_many(r, Interval::FORWARD, &mut any[..r.len()], &mut Counters::default())
                })
                .0
            };
            for (list, value) in
                rates.iter_mut().zip([flat_many, two_many, any_of(&flat), any_of(&two), apart_many])
            {
                list.push(value);
            }
        }
        let [flat_many, two_many, flat_any, two_any, apart_many] = rates.map(median);
        let kind = if coherent { "coherent" } else { "random" };
        println!(
            "  {kind} Mrays/s: nearest flat {flat_many:.3}, two levels {two_many:.3} ({:.2}), not shared {apart_many:.3}; any {flat_any:.3}, {two_any:.3} ({:.2})",
            two_many / flat_many,
            two_any / flat_any
        );
    }
}

fn main() {
    let rounds = std::env::args().nth(1).and_then(|n| n.parse().ok()).unwrap_or(3);
    for (mesh, side) in
        [("bunny_200", 2), ("bunny_1k", 3), ("bunny_5k", 4), ("bunny_40k", 2), ("bunny_40k", 4)]
    {
        let name = format!("{} of {mesh}", side * side * side);
        compare(&name, &scene(&format!("meshes/{mesh}.obj"), side), rounds);
    }
}
