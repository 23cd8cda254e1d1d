//! Small scenes as text, one-pixel pictures and repeatable random numbers.
#![allow(dead_code)]

use common::math::{DVec3, Vec3};
use common::mesh::{Mesh, MeshError};
use common::scene::{MeshSource, Scene, parse_str};
use oracle::{Options, Range, Ray, World, render};
use std::sync::Arc;

/// The mesh of a test, whatever name the scene asks for.
struct Only(Arc<Mesh>);

impl MeshSource for Only {
    fn mesh(&mut self, _name: &str) -> Result<Arc<Mesh>, MeshError> {
        Ok(self.0.clone())
    }
}

/// Parses a scene; it must be right.
pub fn scene(text: &str) -> Scene {
    scene_with_mesh(text, Mesh::default())
}

/// Parses a scene whose every mesh file is `mesh`.
pub fn scene_with_mesh(text: &str, mesh: Mesh) -> Scene {
    parse_str("test", text, &mut Only(Arc::new(mesh))).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// A mesh from corners.
pub fn mesh(triangles: &[[DVec3; 3]]) -> Mesh {
    let positions: Vec<Vec3> = triangles.as_flattened().iter().map(|v| v.as_vec3()).collect();
    let triangles = (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    Mesh { positions, triangles, ..Mesh::default() }
}

/// `objects` (the contents of the Group after numObjects) in a file with one white material,
/// an orthographic camera at (0, 0, 10) that looks along −z at a square of side 4.
pub fn simple(count: u32, objects: &str) -> Scene {
    let camera = "OrthographicCamera { center 0 0 10 direction 0 0 -1 up 0 1 0 size 4 }";
    let material = "Materials { numMaterials 1 Material { diffuseColor 1 1 1 } }";
    let group = format!("Group {{ numObjects {count} MaterialIndex 0 {objects} }}");
    scene(&format!("{camera} {material} {group}"))
}

/// The world of [`simple`].
pub fn world(count: u32, objects: &str) -> World {
    World::new(&simple(count, objects)).expect("a world")
}

/// A ray from `origin` in the direction of `towards`, made unit.
pub fn ray(origin: DVec3, towards: DVec3) -> Ray {
    Ray { origin, direction: towards.normalize() }
}

/// t of the nearest hit in front.
pub fn distance(world: &World, ray: &Ray) -> Option<f64> {
    world.nearest(ray, Range::FORWARD).map(|hit| hit.t)
}

/// The colour of the one ray from `eye` along `look`; `rest` is the file without its camera.
pub fn see(options: &Options, eye: DVec3, look: DVec3, rest: &str) -> DVec3 {
    see_scene(options, &scene(&looking(eye, look, rest)))
}

/// The text of a file whose perspective camera looks along `look`.
pub fn looking(eye: DVec3, look: DVec3, rest: &str) -> String {
    let up = if look.cross(DVec3::Y).length() > 0.1 { DVec3::Y } else { DVec3::X };
    let say = |v: DVec3| format!("{:?} {:?} {:?}", v.x, v.y, v.z);
    let (eye, look, up) = (say(eye), say(look), say(up));
    format!("PerspectiveCamera {{ center {eye} direction {look} up {up} angle 30 }} {rest}")
}

/// The one pixel of a scene.
pub fn see_scene(options: &Options, scene: &Scene) -> DVec3 {
    let options = Options { width: 1, height: 1, ..options.clone() };
    render(scene, &options).expect("a picture").colour.pixel(0, 0)
}

/// Asserts that two vectors agree to `tolerance` in every component.
#[track_caller]
pub fn close(actual: DVec3, expected: DVec3, tolerance: f64) {
    let worst = (actual - expected).abs().max_element();
    assert!(worst <= tolerance, "{actual} is not {expected}: off by {worst:e}");
}

/// Asserts that two numbers agree to `tolerance`.
#[track_caller]
pub fn near(actual: f64, expected: f64, tolerance: f64) {
    let off = (actual - expected).abs();
    assert!(off <= tolerance, "{actual} is not {expected}: off by {off:e}");
}

/// Numbers that look random and are the same every time (splitmix64, Steele et al. 2014).
pub struct Random(pub u64);

impl Random {
    /// Uniform in [0, 1).
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Uniform in the cube [−1, 1)³.
    pub fn cube(&mut self) -> DVec3 {
        DVec3::from_array(std::array::from_fn(|_| 2.0 * self.unit() - 1.0))
    }

    /// A unit vector.
    pub fn direction(&mut self) -> DVec3 {
        loop {
            let v = self.cube();
            if (0.01..=1.0).contains(&v.length_squared()) {
                return v.normalize();
            }
        }
    }
}
