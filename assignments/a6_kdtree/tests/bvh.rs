//! The hierarchy against the list: same primitive, same bits of t, on every scene and on
//! inputs made to break it.

use a6_kdtree::bvh::Bvh;
use common::accel::{Accel, List};
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::{Interval, Vec3};
use common::ray::Ray;
use common::scene::{load, parse_str};
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::path::{Path, PathBuf};

/// A scene without mesh files.
fn geometry(objects: &str, count: usize) -> Geometry {
    struct NoMeshes;
    impl common::scene::MeshSource for NoMeshes {
        fn mesh(
            &mut self,
            name: &str,
        ) -> Result<std::sync::Arc<common::mesh::Mesh>, common::mesh::MeshError> {
            Err(common::mesh::MeshError::new(format!("no mesh {name}")))
        }
    }
    let text = format!(
        "OrthographicCamera {{ center 0 0 5 direction 0 0 -1 up 0 1 0 size 5 }}
         Materials {{ numMaterials 1 Material {{ }} }}
         Group {{ numObjects {count} MaterialIndex 0 {objects} }}"
    );
    let scene = parse_str("test", &text, &mut NoMeshes).unwrap_or_else(|e| panic!("{e}"));
    Geometry::build(&scene).unwrap()
}

fn unit(random: &mut Pcg64Mcg) -> f32 {
    (random.next_u32() >> 8) as f32 / (1 << 24) as f32
}

/// Rays from around and inside the box in all directions, some along the axes.
fn rays(geometry: &Geometry, n: usize) -> Vec<Ray> {
    let mut random = Pcg64Mcg::seed_from_u64(6);
    let bounds = geometry.bounds().unwrap();
    let (center, size) = ((bounds.min + bounds.max) / 2.0, bounds.size());
    (0..n)
        .map(|i| {
            let mut point = || Vec3::from_array(std::array::from_fn(|_| unit(&mut random) * 2.0 - 1.0));
            let (origin, mut direction) = (center + point() * size, point());
            if i % 7 == 0 {
                direction[i % 3] = if i % 2 == 0 { 0.0 } else { -0.0 };
            }
            Ray::new(origin, direction)
        })
        .collect()
}

/// Both agree on `n` rays, forward and along the whole line; returns the number of hits.
fn agree(geometry: &Geometry, n: usize) -> usize {
    let (bvh, list) = (Bvh::new(geometry), List::new(geometry));
    bvh.validate().unwrap();
    let mut c = Counters::default();
    let mut hits = 0;
    for ray in rays(geometry, n) {
        for interval in [Interval::FORWARD, Interval::ALL, Interval::up_to(0.5)] {
            let expected = list.nearest(&ray, interval, &mut c);
            assert_eq!(bvh.nearest(&ray, interval, &mut c), expected, "{ray:?} {interval:?}");
            assert_eq!(bvh.any(&ray, interval, &mut c), expected.is_some(), "{ray:?} {interval:?}");
            hits += usize::from(expected.is_some());
        }
    }
    hits
}

#[test]
fn a6t2_equals_the_list_on_every_scene() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|f| f.unwrap().path()).collect();
    files.sort();
    let mut hits = 0;
    for file in files.iter().filter(|f| f.file_name().unwrap().to_string_lossy().starts_with("scene")) {
        let geometry = Geometry::build(&load(file).unwrap_or_else(|e| panic!("{e}"))).unwrap();
        if geometry.bounds().is_some() {
            hits += agree(&geometry, if geometry.len() > 10_000 { 200 } else { 1000 });
        }
    }
    assert!(hits > 10_000, "the rays should meet something: {hits}");
}

#[test]
fn a6t2_coincident_concentric_flat_and_single() {
    let equal = "Sphere { center 1 2 3 radius 0.5 } ".repeat(20_000);
    assert!(agree(&geometry(&equal, 20_000), 20) > 0);
    let concentric: String = (1..=20).map(|i| format!("Sphere {{ center 0 0 0 radius {i} }} ")).collect();
    assert!(agree(&geometry(&concentric, 20), 2000) > 0);
    let flat: String = (0..100)
        .map(|i| format!("Triangle {{ vertex0 {i} 0 0 vertex1 {i} 1 0 vertex2 {}.5 0 0 }} ", i))
        .collect();
    assert!(agree(&geometry(&flat, 100), 3000) > 0);
    assert!(agree(&geometry("Sphere { center 0 0 0 radius 1 }", 1), 500) > 0);
    let mixed = "Plane { normal 0 1 0 offset -1 } Sphere { center 0 0 0 radius 1 } \
                 Triangle { vertex0 -2 0 0 vertex1 2 0 0 vertex2 0 2 0 }";
    assert!(agree(&geometry(mixed, 3), 3000) > 0);
}

/// Sizes that halve for ever make the deepest trees.
#[test]
fn a6t2_geometric_series_stays_shallow_enough() {
    let series: String = (0..120)
        .map(|i| format!("Sphere {{ center {:e} 0 0 radius {:e} }} ", 2f64.powi(60 - i), 2f64.powi(58 - i)))
        .collect();
    let geometry = geometry(&series, 120);
    let bvh = Bvh::new(&geometry);
    bvh.validate().unwrap();
    assert!(bvh.counts().2 <= 92, "depth {}", bvh.counts().2);
    agree(&geometry, 2000);
}

#[test]
fn a6t2_nothing_and_planes_only() {
    let planes = geometry("Plane { normal 0 1 0 offset -1 }", 1);
    let (bvh, mut c) = (Bvh::new(&planes), Counters::default());
    bvh.validate().unwrap();
    let down = Ray::new(Vec3::ZERO, Vec3::NEG_Y);
    assert_eq!(bvh.nearest(&down, Interval::FORWARD, &mut c).map(|h| h.t), Some(1.0));
    let nan = Ray::new(Vec3::NAN, Vec3::NEG_Y);
    assert!(bvh.nearest(&nan, Interval::FORWARD, &mut c).is_none() && !bvh.any(&nan, Interval::ALL, &mut c));
}

#[test]
fn a6t2_the_tree_does_not_depend_on_threads() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/scene5_09_bunny_mesh_40k.txt");
    let geometry = Geometry::build(&load(&file).unwrap()).unwrap();
    let build = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| Bvh::new(&geometry).fingerprint())
    };
    let one = build(1);
    assert!([2, 3, 7].into_iter().all(|n| build(n) == one));
}
