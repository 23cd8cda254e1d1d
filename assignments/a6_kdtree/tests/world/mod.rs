//! Scenes, rays and the comparison with the list that the tests of all trees share.
#![allow(dead_code, reason = "each test program uses its own part")]

use common::accel::{Accel, List};
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::{DVec3, Interval, Vec3};
use common::mesh::{Mesh, MeshError};
use common::ray::Ray;
use common::scene::{MeshSource, load, parse_str};
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::collections::HashMap;
use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Knows the meshes `lumpy N`: balls with hills, 12 N² triangles; makes each once.
#[derive(Default)]
struct Generated(HashMap<u32, Arc<Mesh>>);

impl MeshSource for Generated {
    fn mesh(&mut self, name: &str) -> Result<Arc<Mesh>, MeshError> {
        let side = name.strip_prefix("lumpy_").and_then(|n| n.parse().ok());
        let n: u32 = side.ok_or_else(|| MeshError::new(format!("no mesh {name}")))?;
        Ok(Arc::clone(self.0.entry(n).or_insert_with(|| Arc::new(lumpy(n)))))
    }
}

/// A closed ball with hills: a cube of `n` × `n` squares a side, blown up.
fn lumpy(n: u32) -> Mesh {
    let mut mesh = Mesh::default();
    let at = |k: u32| 2.0 * f64::from(k) / f64::from(n) - 1.0;
    for face in 0..6 {
        let first = mesh.positions.len() as u32;
        for j in 0..=n {
            for i in 0..=n {
                // The axes are turned so that every face is seen counter-clockwise from outside.
                let flat = if face < 3 { [at(i), at(j), 1.0] } else { [at(j), at(i), -1.0] };
                let p = DVec3::from_array(std::array::from_fn(|k| flat[(k + face) % 3])).normalize();
                let hill =
                    (9.0 * p.x).sin() * (7.0 * p.y).sin() + 0.4 * (31.0 * p.z).sin() * (23.0 * p.x).cos();
                mesh.positions.push((p * (1.0 + 0.1 * hill)).as_vec3());
            }
        }
        for j in 0..n {
            for i in 0..n {
                let a = first + j * (n + 1) + i;
                let [b, c, d] = [a + 1, a + n + 2, a + n + 1];
                mesh.triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
    }
    mesh
}

/// A scene of `count` objects.
pub fn geometry(objects: &str, count: usize) -> Geometry {
    let text = format!(
        "OrthographicCamera {{ center 0 0 5 direction 0 0 -1 up 0 1 0 size 5 }}
         Materials {{ numMaterials 1 Material {{ }} }}
         Group {{ numObjects {count} MaterialIndex 0 {objects} }}"
    );
    let scene = parse_str("test", &text, &mut Generated::default()).unwrap_or_else(|e| panic!("{e}"));
    Geometry::build(&scene).unwrap()
}

/// The ball with hills of 12 `n`² triangles.
pub fn lumpy_ball(n: u32) -> Geometry {
    geometry(&format!("TriangleMesh {{ obj_file lumpy_{n} }}"), 1)
}

/// The scene of a file of `scenes/`.
pub fn scene(name: &str) -> Geometry {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(name);
    Geometry::build(&load(&file).unwrap_or_else(|e| panic!("{e}"))).unwrap()
}

/// All ray-tracing scenes of `scenes/` that hold something finite, none twice: the course shows
/// its rabbit in many lights.
pub fn scenes() -> impl Iterator<Item = Geometry> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|f| f.unwrap().path()).collect();
    files.sort();
    let names = files.into_iter().map(|f| f.file_name().unwrap().to_string_lossy().into_owned());
    let mut seen = HashSet::new();
    let mut new = move |g: &Geometry| seen.insert(format!("{:?} {:?}", g.len(), g.bounds()));
    let all = names.filter(|n| n.starts_with("scene")).map(|n| scene(&n));
    all.filter(move |g| g.bounds().is_some() && new(g))
}

/// Between 0 and 1.
pub fn unit(random: &mut Pcg64Mcg) -> f32 {
    (random.next_u32() >> 8) as f32 / (1 << 24) as f32
}

/// Rays from around and inside the box in all directions, some along the axes.
pub fn rays(geometry: &Geometry, n: usize) -> Vec<Ray> {
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

/// Both give the same answers to one ray, forward, along the whole line and for a part of it, and to
/// the same ray if it leaves what it would hit; returns the number of hits.
pub fn agree_on(tree: &dyn Accel, list: &List, ray: &Ray) -> usize {
    let mut c = Counters::default();
    let part = Interval { min: -0.5, max: 0.75 };
    let mut hits = 0;
    for interval in [Interval::FORWARD, Interval::ALL, Interval::up_to(0.5), part] {
        let mut same = |ray: &Ray| {
            let expected = list.nearest(ray, interval, &mut c);
            assert_eq!(tree.nearest(ray, interval, &mut c), expected, "{ray:?} {interval:?}");
            assert_eq!(tree.any(ray, interval, &mut c), expected.is_some(), "{ray:?} {interval:?}");
            expected
        };
        let Some(hit) = same(ray) else { continue };
        same(&Ray::leaving(hit.primitive, ray.origin, ray.direction));
        hits += 1;
    }
    hits
}

/// The tree is valid and agrees with the list on `n` rays; returns the number of hits.
pub fn agree(tree: &dyn Accel, n: usize) -> usize {
    tree.validate().unwrap();
    let list = List::new(tree.geometry());
    rays(tree.geometry(), n).iter().map(|ray| agree_on(tree, &list, ray)).sum()
}

/// Bundles of rays that run alongside each other, of all lengths up to 30, some with stray rays
/// and rays that hit nothing in them, from far, near and inside.
pub fn bundles(geometry: &Geometry, n: usize) -> Vec<Vec<Ray>> {
    let mut random = Pcg64Mcg::seed_from_u64(8);
    let starts = rays(geometry, n);
    let size = geometry.bounds().unwrap().size();
    let bundle = |(i, first): (usize, &Ray)| {
        let spread = [0.0, 0.001, 0.02, 0.5][i % 4];
        let mut near =
            |v: Vec3, by: f32| v + Vec3::from_array([(); 3].map(|()| unit(&mut random) - 0.5)) * by;
        // One after the other they leave one triangle after the other.
        let ray = |home| {
            let origin = near(first.origin, size.max_element() * spread);
            Ray::leaving(home, origin, near(first.direction, spread))
        };
        let mut bundle: Vec<Ray> = (0..1 + i as u32 % 30).map(ray).collect();
        let len = bundle.len();
        match i % 11 {
            0 => bundle[len / 2] = Ray::new(first.origin, Vec3::ZERO),
            1 => bundle[len / 2].direction = -first.direction,
            2 => bundle[len / 2].origin = Vec3::splat(1e30),
            3 => bundle[len - 1].direction *= 1e-30,
            _ => {}
        }
        bundle
    };
    starts.iter().enumerate().map(bundle).collect()
}

/// Many rays asked at once get the answers that each gets alone; returns the number of hits.
pub fn agree_together(tree: &dyn Accel, n: usize) -> usize {
    let mut hits = 0;
    let mut c = Counters::default();
    for rays in bundles(tree.geometry(), n) {
        for interval in [Interval::FORWARD, Interval::ALL, Interval::up_to(0.5)] {
            let (mut together, mut any) = (vec![None; rays.len()], vec![true; rays.len()]);
            tree.nearest_many(&rays, interval, &mut together, &mut c);
            tree.any_many(&rays, interval, &mut any, &mut c);
            for ((ray, hit), any) in rays.iter().zip(together).zip(any) {
                assert_eq!(hit, tree.nearest(ray, interval, &mut c), "{ray:?} {interval:?}");
                assert_eq!(any, hit.is_some(), "{ray:?} {interval:?}");
                hits += usize::from(any);
            }
        }
    }
    hits
}

/// Squares in one plane that lie upon each other in different arrangements, two triangles each,
/// and rays from far away: every ray has several hits of equal or neighbouring t, which stand in
/// different leaves.
pub fn ties() -> (Geometry, Vec<Ray>) {
    let mut random = Pcg64Mcg::seed_from_u64(7);
    let mut objects = String::new();
    for i in 0..300 {
        let size = 0.05 + unit(&mut random) * 0.8;
        let (x, y) = (unit(&mut random) * 2.0 - 1.0, unit(&mut random) * 2.0 - 1.0);
        let z = 1.0 + (i % 3) as f32 * f32::EPSILON;
        let corner = |dx: f32, dy: f32| format!("{:?} {:?} {z:?}", x + dx * size, y + dy * size);
        let [a, b, c, d] = [corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)];
        objects += &format!("Triangle {{ vertex0 {a} vertex1 {b} vertex2 {c} }} ");
        objects += &format!("Triangle {{ vertex0 {a} vertex1 {c} vertex2 {d} }} ");
    }
    let rays = (0..20_000).map(|i| {
        let mut point =
            |reach: f32| Vec3::from_array(std::array::from_fn(|_| (unit(&mut random) - 0.5) * reach));
        let origin = point(2000.0);
        let target = point(2.0) * Vec3::new(1.0, 1.0, 0.0) + Vec3::Z;
        // Every other ray looks away: it meets the squares at t = -1.
        Ray::new(origin, if i % 2 == 0 { target - origin } else { origin - target })
    });
    (geometry(&objects, 600), rays.collect())
}
