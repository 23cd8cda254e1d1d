//! accuracy.md, properties 7 and 8: a ray that leaves a surface does not meet it again, and what
//! is closed stays closed.

use a1_ray_casting::Sight;
use a2_transforms::LocalLight;
use a3_phong::Phong;
use a4_whitted::{NoRecord, Rules, Whitted, mirror};
use common::accel::{Accel, List};
use common::counters::Counters;
use common::geometry::{Geometry, Surface};
use common::math::{DVec3, Interval, Vec3};
use common::mesh::Mesh;
use common::ray::Ray;
use tests::property::{Draw, build, convex_sphere, file_mesh, ray_bits, run, scene_of};

/// 2⁻²³.
const EPS: f64 = 1.0 / (1u64 << 23) as f64;

/// A direction on the outer side of the surface, grazing in a third of all cases. It is an `f32`
/// direction already: what a caller rounds afterwards may point elsewhere.
fn outward(draw: &mut Draw, n: DVec3) -> Option<Vec3> {
    let d = draw.direction();
    let up = if d.dot(n) < 0.0 { -d } else { d };
    let along = up - n * up.dot(n);
    let tilted = if draw.chance(0.33) { along + n * draw.magnitude(-9.0, 0.0) } else { up };
    let direction = tilted.normalize_or_zero().as_vec3();
    (direction.as_dvec3().dot(n) > 0.0).then_some(direction)
}

/// Finds a point of the surface and leaves it outward: nothing may be hit again. The value is
/// the offset as a share of 64 eps·S, S the largest coordinate of the shape.
fn leaves(draw: &mut Draw, geometry: &Geometry, ray: &Ray, reach: f64) -> Result<f64, String> {
    let list = List::new(geometry);
    let mut counters = Counters::default();
    let Some(hit) = list.nearest(ray, Interval::FORWARD, &mut counters) else { return Ok(0.0) };
    let surface = geometry.surface(ray, &hit);
    // Both sides of a flat shape are its outside; of a body only the outer one.
    let body = !geometry.solids().is_empty() || geometry.triangles().len() > 1;
    let turned = !body && draw.chance(0.5);
    let n = if turned { -surface.geometric_normal } else { surface.geometric_normal };
    let Some(direction) = outward(draw, n) else { return Ok(0.0) };
    let away = Ray::new(surface.leave(direction.as_dvec3()), direction);
    if let Some(again) = list.nearest(&away, Interval::FORWARD, &mut counters) {
        return Err(format!("{again:?} again\nfound by {}\nleft by {}", ray_bits(ray), ray_bits(&away)));
    }
    let share = offset(&surface, away.origin) / (64.0 * EPS * reach);
    if share <= 1.0 { Ok(share) } else { Err(format!("offset {share} of the bound\n{}", ray_bits(ray))) }
}

fn offset(surface: &Surface, start: Vec3) -> f64 {
    (start.as_dvec3() - surface.point).length()
}

/// Size and place of a shape: sizes 10⁻⁶ … 10⁹, up to 10⁷ away, never so far that `f32` cannot
/// tell its two sides apart.
fn place(draw: &mut Draw) -> (f64, DVec3) {
    let size = draw.magnitude(-6.0, 9.0);
    let most = (size * 1e4).min(1e7);
    let center = draw.direction() * draw.pick(&[0.0, 1.0, most.max(1e-30)]).min(most);
    (size, center)
}

/// One geometry per few hundred rays: building it costs more than tracing it.
const RAYS: usize = 256;

fn many(draw: &mut Draw, geometry: &Geometry, size: f64, center: DVec3, reach: f64) -> Result<f64, String> {
    let mut worst: f64 = 0.0;
    for _ in 0..RAYS {
        let origin = (center + draw.direction() * size * draw.between(0.0, 6.0)).as_vec3();
        let target = center + draw.cube() * size * 0.8;
        let direction = (target - origin.as_dvec3()).normalize_or(DVec3::X).as_vec3();
        worst = worst.max(leaves(draw, geometry, &Ray::new(origin, direction), reach)?);
    }
    Ok(worst)
}

fn shape_text(kind: usize, draw: &mut Draw, size: f64, c: DVec3) -> String {
    let d = draw.direction();
    let at = format!(
        "Translate {} {} {} Rotate {{ {} {} {} {} }}",
        c.x,
        c.y,
        c.z,
        d.x,
        d.y,
        d.z,
        draw.between(0.0, 360.0)
    );
    match kind {
        0 => format!("Sphere {{ center {} {} {} radius {size} }}", c.x, c.y, c.z),
        1 => {
            let s = [size, size * draw.between(0.1, 1.0), -size * draw.between(0.01, 1.0)];
            format!(
                "Transform {{ {at} Scale {} {} {} Sphere {{ center 0 0 0 radius 1 }} }}",
                s[0], s[1], s[2]
            )
        }
        2 => {
            let p: Vec<String> = (0..3)
                .map(|_| c + draw.cube() * size * draw.pick(&[1.0, 1.0, 1e-3]))
                .enumerate()
                .map(|(i, p)| format!("vertex{i} {} {} {}", p.x, p.y, p.z))
                .collect();
            format!("Triangle {{ {} }}", p.join(" "))
        }
        3 => format!("Plane {{ normal {} {} {} offset {} }}", d.x, d.y, d.z, d.dot(c)),
        _ => format!("Transform {{ {at} UniformScale {size} TriangleMesh {{ obj_file cube }} }}"),
    }
}

fn leave_convex(name: &str, kind: usize, rays: u64) {
    let cube = if kind == 4 { convex_sphere(2) } else { Mesh::default() };
    let worst =
        run(&format!("p07 {name} (256 rays each), offset / 64 eps·S"), 701, rays / RAYS as u64, |draw| {
            let (size, center) = place(draw);
            let text = shape_text(kind, draw, size, center);
            let geometry = build(&text, cube.clone());
            let reach = center.abs().max_element() + 2.0 * size;
            // Rays meet a plane at a distance of their own; its points are as large as that.
            let reach = if kind == 3 { reach * 1e6 } else { reach };
            many(draw, &geometry, size, center, reach).map_err(|e| format!("{text}\n{e}"))
        });
    assert!(worst > 0.0, "no ray hit");
}

#[test]
fn p07_leaving_spheres() {
    leave_convex("sphere", 0, 3_000_000);
}

#[test]
fn p07_leaving_ellipsoids() {
    leave_convex("ellipsoid", 1, 2_000_000);
}

#[test]
fn p07_leaving_triangles() {
    leave_convex("triangle", 2, 2_000_000);
}

#[test]
fn p07_leaving_planes() {
    leave_convex("plane", 3, 2_000_000);
}

#[test]
fn p07_leaving_convex_meshes() {
    leave_convex("convex mesh", 4, 1_000_000);
}

/// Two planes 64 eps·S apart: what leaves the lower one upward meets the upper one, and what
/// leaves the upper one upward meets nothing.
#[test]
fn p07_close_planes_leak_nothing() {
    run("p07 two planes", 702, 100_000, |draw| {
        let n = draw.direction();
        let reach = draw.magnitude(-6.0, 7.0);
        let low = draw.between(-1.0, 1.0) * reach;
        let gap = 64.0 * EPS * reach;
        let plane = |offset: f64| format!("Plane {{ normal {} {} {} offset {offset} }}", n.x, n.y, n.z);
        let geometry =
            build(&format!("Group {{ numObjects 2 {} {} }}", plane(low), plane(low + gap)), Mesh::default());
        let list = List::new(&geometry);
        let onto = n * low + n.any_orthonormal_vector() * reach * draw.unit() / 2.0;
        let from_below = Ray::new((onto - n * reach).as_vec3(), n.as_vec3());
        let hits = [Interval::FORWARD, Interval { min: reach as f32, max: f32::INFINITY }];
        let find = |ray: &Ray, i: Interval| list.nearest(ray, i, &mut Counters::default());
        let lower = find(&from_below, hits[0]).filter(|h| h.primitive == 0);
        let Some(lower) = lower else { return Err(format!("lower plane missed\n{}", ray_bits(&from_below))) };
        let direction = (n + n.any_orthonormal_vector() * draw.between(0.0, 3.0)).normalize().as_vec3();
        let surface = geometry.surface(&from_below, &lower);
        let between = Ray::new(surface.leave(direction.as_dvec3()), direction);
        let Some(upper) = find(&between, Interval::FORWARD).filter(|h| h.primitive == 1) else {
            return Err(format!("the upper plane leaks\n{}", ray_bits(&between)));
        };
        let above = geometry.surface(&between, &upper).leave(direction.as_dvec3());
        let free = find(&Ray::new(above, direction), Interval::FORWARD);
        if free.is_some() { Err(format!("false shadow\n{}", ray_bits(&between))) } else { Ok(0.0) }
    });
}

/// A ray that is mirrored a thousand times inside a sphere always meets it from inside.
#[test]
fn p08_a_thousand_bounces_stay_inside() {
    run("p08 1000 bounces in a sphere", 801, 1_000, |draw| {
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
#[test]
fn p08_a_closed_box_is_exactly_black() {
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
    run("p08 closed box", 802, 50_000, |draw| {
        let origin = (draw.cube() * 1.5).as_vec3();
        let mut counters = Counters::default();
        let ray = tests::property::aim(draw, geometry.triangles(), origin);
        let ray = Ray::new(ray.origin, ray.direction.normalize());
        let hit = list.nearest(&ray, Interval::FORWARD, &mut counters);
        let color = whitted.radiance(&Sight::new(&geometry, ray, hit), &mut counters, &mut NoRecord);
        if color == Vec3::ZERO { Ok(0.0) } else { Err(format!("{color}\n{}", ray_bits(&ray))) }
    });
    // The test can fail: from outside the box is lit.
    let ray = Ray::new(Vec3::new(9.0, 0.5, 0.5), -Vec3::X);
    let hit = list.nearest(&ray, Interval::FORWARD, &mut Counters::default());
    let color = whitted.radiance(&Sight::new(&geometry, ray, hit), &mut Counters::default(), &mut NoRecord);
    assert!(color.min_element() > 0.1, "{color}");
}

struct NoMesh;

impl common::scene::MeshSource for NoMesh {
    fn mesh(&mut self, name: &str) -> Result<std::sync::Arc<Mesh>, common::mesh::MeshError> {
        Err(common::mesh::MeshError::new(format!("no {name}")))
    }
}
