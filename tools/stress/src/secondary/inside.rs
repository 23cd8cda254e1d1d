//! Property 8: what is closed stays closed.

use crate::Stress;
use crate::kit::{aim, build, file_mesh, ray_bits, scene_of};
use a1_ray_casting::Sight;
use a2_transforms::LocalLight;
use a3_phong::Phong;
use a4_whitted::{NoRecord, Rules, Whitted, mirror};
use common::accel::{Accel, List};
use common::counters::Counters;
use common::geometry::Geometry;
use common::math::{Interval, Vec3};
use common::mesh::Mesh;
use common::ray::Ray;

/// A ray that is mirrored a thousand times inside a sphere always meets it from inside.
pub fn bounces(stress: &Stress) {
    stress.run("p08 1000 bounces in a sphere", 801, 1_000, |draw| {
        let radius = draw.magnitude(-3.0, 6.0);
        let center = draw.direction() * draw.pick(&[0.0, 0.5, 100.0]) * radius;
        let text = format!("Sphere {{ center {} {} {} radius {radius} }}", center.x, center.y, center.z);
        let geometry = build(&text, Mesh::default());
        let list = List::new(&geometry);
        let start = center + draw.direction() * radius * draw.pick(&[0.0, 0.5, 0.9, 0.9999]);
        let mut ray = Ray::new(start.as_vec3(), draw.direction().as_vec3());
        for bounce in 0..1000 {
            let fault = |what: &str| Err(format!("{what} at bounce {bounce} in {text}\n{}", ray_bits(&ray)));
            let Some(hit) = list.nearest(&ray, Interval::FORWARD, &mut Counters::default()) else {
                return fault("escaped");
            };
            let surface = geometry.surface(&ray, &hit);
            let incoming = ray.direction.as_dvec3();
            if incoming.dot(surface.geometric_normal) <= 0.0 {
                return fault("flipped");
            }
            let direction = mirror(incoming, surface.geometric_normal);
            ray = Ray::new(surface.leave(direction), direction.as_vec3());
        }
        Ok(0.0)
    });
}

const CLOSED: &str = "Transform { Rotate { 1 2 3 25 } UniformScale 3 TriangleMesh { obj_file box } }";

/// Inside a closed box no light of the outside is seen: not a single bit of it.
pub fn black_box(stress: &Stress) {
    let mut scene = scene_of(CLOSED, file_mesh("cube.obj"));
    let lamp = "PerspectiveCamera { center 0 0 5 direction 0 0 -1 up 0 1 0 angle 40 }
        Lights { numLights 3 PointLight { position 9 0 0 color 1 1 1 } PointLight { position 0 5 5 color 1 1 1 }
            DirectionalLight { direction 1 1 1 color 1 1 1 } }
        Materials { numMaterials 1 Material { reflectiveColor 0.9 0.9 0.9 } } Group { numObjects 0 }";
    let lit = common::scene::parse_str("lit", lamp, &mut NoMesh).unwrap_or_else(|e| panic!("{e}"));
    (scene.lights, scene.materials, scene.background) = (lit.lights, lit.materials, lit.background);
    assert_eq!(scene.background.ambient_light, Vec3::ZERO);
    let geometry = Geometry::build(&scene).unwrap_or_else(|e| panic!("{e}"));
    let list = List::new(&geometry);
    let light = LocalLight { scene: &scene, shade_back: true };
    let rules = Rules { shadows: true, bounces: 4, ..Rules::default() };
    let whitted = Whitted { scene: &scene, accel: &list, light, phong: Phong::default(), rules };
    stress.run("p08 closed box", 802, 50_000, |draw| {
        let origin = (draw.cube() * 1.5).as_vec3();
        let mut counters = Counters::default();
        let ray = aim(draw, geometry.triangles(), origin);
        let ray = Ray::new(ray.origin, ray.direction.normalize());
        let hit = list.nearest(&ray, Interval::FORWARD, &mut counters);
        let color = whitted.radiance(&Sight::new(&geometry, ray, hit), &mut counters, &mut NoRecord);
        if color == Vec3::ZERO { Ok(0.0) } else { Err(format!("{color}\n{}", ray_bits(&ray))) }
    });
    // The check can fail: from outside the box is lit.
    let ray = Ray::new(Vec3::new(9.0, 0.5, 0.5), -Vec3::X);
    let hit = list.nearest(&ray, Interval::FORWARD, &mut Counters::default());
    let color = whitted.radiance(&Sight::new(&geometry, ray, hit), &mut Counters::default(), &mut NoRecord);
    let least = f64::from(color.min_element());
    stress.expect("p08 from outside the box is lit", least, |least| least > 0.1);
}

struct NoMesh;

impl common::scene::MeshSource for NoMesh {
    fn mesh(&mut self, name: &str) -> Result<std::sync::Arc<Mesh>, common::mesh::MeshError> {
        Err(common::mesh::MeshError::new(format!("no {name}")))
    }
}
