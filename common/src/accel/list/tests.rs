//! What is left out and what is asked.

use super::*;
use crate::math::Vec3;
use crate::mesh::{Mesh, MeshError};
use crate::scene::{MeshSource, parse_str};
use std::sync::Arc;

struct NoMesh;

impl MeshSource for NoMesh {
    fn mesh(&mut self, name: &str) -> Result<Arc<Mesh>, MeshError> {
        Err(MeshError::new(format!("no mesh `{name}` here")))
    }
}

/// Two triangles, one behind the other, and a ball behind them.
fn geometry() -> Geometry {
    let text = "OrthographicCamera { center 0 0 5 direction 0 0 -1 up 0 1 0 size 5 }
        Materials { numMaterials 1 Material { } }
        Group { numObjects 3 MaterialIndex 0
            Triangle { vertex0 -1 -1 0 vertex1 1 -1 0 vertex2 0 1 0 }
            Triangle { vertex0 -1 -1 -1 vertex1 1 -1 -1 vertex2 0 1 -1 }
            Sphere { center 0 0 -3 radius 1 } }";
    let scene = parse_str("test", text, &mut NoMesh).unwrap_or_else(|e| panic!("{e}"));
    Geometry::build(&scene).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn a_ray_does_not_ask_the_triangle_it_leaves_and_asks_every_other_shape() {
    let (geometry, mut c) = (geometry(), Counters::default());
    let list = List::new(&geometry);
    let mut first = |home, z: f32, interval| {
        let ray = Ray::leaving(home, Vec3::Z * z, Vec3::NEG_Z);
        let hit = list.nearest(&ray, interval, &mut c);
        assert_eq!(list.any(&ray, interval, &mut c), hit.is_some());
        hit.map(|hit| (hit.primitive, hit.t))
    };
    let forward = Interval::FORWARD;
    assert_eq!(first(Ray::ANYWHERE, 1.0, forward), Some((0, 1.0)));
    assert_eq!(first(0, 1.0, forward), Some((1, 2.0)));
    assert_eq!(first(1, 1.0, forward), Some((0, 1.0)));
    assert_eq!(first(0, 1.0, Interval::up_to(1.5)), None);
    assert_eq!(first(2, -2.5, forward), Some((2, 1.5)), "from inside the ball");
}
