//! One ray through a small scene.

use a1_ray_casting::Sight;
use a2_transforms::LocalLight;
use a3_phong::Phong;
use a4_whitted::{RayTree, Rules, Whitted};
use common::accel::{Accel, List};
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::{Interval, Vec3};
use common::mesh::{Mesh, MeshError};
use common::ray::Ray;
use common::scene::{MeshSource, Scene, parse_str};
use std::sync::Arc;

struct NoMesh;

impl MeshSource for NoMesh {
    fn mesh(&mut self, name: &str) -> Result<Arc<Mesh>, MeshError> {
        Err(MeshError::new(format!("no mesh `{name}` here")))
    }
}

/// A scene from its blocks; the camera is not used.
pub fn scene(blocks: &str) -> Scene {
    let camera = "PerspectiveCamera { center 0 0 5 direction 0 0 -1 up 0 1 0 angle 40 }";
    parse_str("a4.txt", &format!("{camera} {blocks}"), &mut NoMesh).unwrap_or_else(|e| panic!("{e}"))
}

/// What came back along one ray.
pub struct Traced {
    pub color: Vec3,
    pub tree: RayTree,
    pub counters: Counters,
}

/// Traces one ray, its direction made unit first; both sides of surfaces are lit.
pub fn trace(scene: &Scene, rules: Rules, origin: Vec3, direction: Vec3) -> Traced {
    let geometry = Geometry::build(scene).unwrap_or_else(|e| panic!("{e}"));
    let list = List::new(&geometry);
    let light = LocalLight { scene, shade_back: true };
    let whitted = Whitted { scene, accel: &list, light, phong: Phong::default(), rules };
    let (mut counters, mut tree) = (Counters::default(), RayTree::default());
    let ray = Ray::new(origin, direction.normalize());
    counters.rays += 1;
    let hit = list.nearest(&ray, Interval::FORWARD, &mut counters);
    let color = whitted.radiance(&Sight::new(&geometry, ray, hit), &mut counters, &mut tree);
    Traced { color, tree, counters }
}

/// Equal but for rounding.
pub fn near(a: Vec3, b: Vec3) -> bool {
    (a - b).abs().max_element() < 1e-5
}

/// Rules without shadows.
pub fn rules(bounces: u32) -> Rules {
    Rules { bounces, skip_behind: true, skip_dark: true, skip_black: true, ..Rules::default() }
}
