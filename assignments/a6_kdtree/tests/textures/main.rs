//! A6T3, A6T4: textured scenes, traced.

mod blends;
mod pictures;
mod program;
mod smooth;

use a1_ray_casting::{Sight, World};
use a2_transforms::LocalLight;
use a3_phong::Phong;
use a4_whitted::{RayTree, Rules, Whitted};
use a6_kdtree::texture::{TextureError, TexturedScene};
use common::accel::{Accel, List};
use common::counters::Counters;
use common::geometry::{Geometry, Surface};
use common::math::{DVec3, Interval, Vec3};
use common::mesh::{Mesh, MeshError};
use common::ray::Ray;
use common::scene::{MeshSource, Scene, parse_str};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Every mesh is a ball of 8 n² triangles; pictures lie in a folder.
struct Files<'a>(&'a Path);

impl MeshSource for Files<'_> {
    fn mesh(&mut self, _: &str) -> Result<Arc<Mesh>, MeshError> {
        Ok(Arc::new(ball(6)))
    }

    fn picture(&mut self, name: &str) -> Result<PathBuf, String> {
        Ok(self.0.join(name))
    }
}

/// A unit ball: the faces of an octahedron, each cut into n² triangles and blown up.
fn ball(n: i32) -> Mesh {
    let mut mesh = Mesh::default();
    for octant in 0..8 {
        let sign = |bit: i32| if octant & bit == 0 { 1.0 } else { -1.0 };
        let at = |i: i32, j: i32| {
            let p = Vec3::new(i as f32, j as f32, (n - i - j) as f32);
            (p * Vec3::new(sign(1), sign(2), sign(4))).normalize()
        };
        let inward = sign(1) * sign(2) * sign(4) < 0.0;
        let mut add = |corners: [Vec3; 3]| {
            let first = mesh.positions.len() as u32;
            mesh.positions.extend(corners);
            let [a, b, c] = [first, first + 1, first + 2];
            mesh.triangles.push(if inward { [a, c, b] } else { [a, b, c] });
        };
        for (i, j) in (0..n).flat_map(|i| (0..n - i).map(move |j| (i, j))) {
            add([at(i, j), at(i + 1, j), at(i, j + 1)]);
            if i + j + 2 <= n {
                add([at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
            }
        }
    }
    mesh
}

/// A scene of these blocks, whose pictures lie in `folder`.
fn scene_in(folder: &Path, blocks: &str) -> Scene {
    let camera = "PerspectiveCamera { center 0 0 5 direction 0 0 -1 up 0 1 0 angle 40 }";
    let text = format!("{camera} {blocks}");
    parse_str("test", &text, &mut Files(folder)).unwrap_or_else(|e| panic!("{e}"))
}

/// A scene without pictures.
fn scene(blocks: &str) -> Scene {
    scene_in(Path::new(""), blocks)
}

/// The scene made ready.
fn load<'a>(scene: &'a Scene, geometry: &'a Geometry) -> Result<TexturedScene<'a>, TextureError> {
    TexturedScene::load(scene, geometry, Path::new("test.txt"))
}

/// A point of no particular shape.
fn somewhere(point: DVec3, material: u32) -> Surface {
    let normal = DVec3::Y;
    Surface {
        point,
        error: DVec3::ZERO,
        normal: normal.as_vec3(),
        geometric_normal: normal,
        material,
        primitive: 0,
        weights: [0.0; 2],
    }
}

/// What came back along one ray.
struct Traced {
    color: Vec3,
    tree: RayTree,
    counters: Counters,
}

/// Traces one ray from `origin` through `target`; both sides of surfaces are lit.
fn trace(scene: &Scene, rules: Rules, origin: Vec3, target: Vec3) -> Traced {
    let geometry = Geometry::build(scene).unwrap_or_else(|e| panic!("{e}"));
    let textured = load(scene, &geometry).unwrap_or_else(|e| panic!("{e}"));
    let list = List::new(&geometry);
    let light = LocalLight { scene: textured.as_scene(), shade_back: true };
    let whitted = Whitted { scene: &textured, accel: &list, light, phong: Phong::default(), rules };
    let (mut counters, mut tree) = (Counters::default(), RayTree::default());
    let ray = Ray::new(origin, (target - origin).normalize());
    counters.rays += 1;
    let hit = list.nearest(&ray, Interval::FORWARD, &mut counters);
    let color = whitted.radiance(&Sight::new(&geometry, ray, hit), &mut counters, &mut tree);
    Traced { color, tree, counters }
}

/// Rules without shadows.
fn rules(bounces: u32) -> Rules {
    Rules { bounces, skip_behind: true, skip_dark: true, skip_black: true, ..Rules::default() }
}

/// Equal but for rounding.
fn near(a: Vec3, b: Vec3) -> bool {
    (a - b).abs().max_element() < 1e-5
}
