//! Who comes first; smooth normals and texture coordinates on placed shapes.

use super::{Abreast, Geometry, Hit, Round, Surface, facing, hit_triangle};
use crate::accel::{Accel, List};
use crate::math::{DMat4, DVec3, Interval, Vec2, Vec3};
use crate::mesh::{Mesh, MeshError};
use crate::ray::Ray;
use crate::scene::{MeshSource, parse_str};
use crate::shape::ExactRay;
use crate::simd::{self, Simd, SimdBase, dispatch, f64x8};
use std::path::PathBuf;
use std::sync::Arc;

/// Every name stands for the same mesh, every picture exists.
struct TheMesh(Arc<Mesh>);

impl MeshSource for TheMesh {
    fn mesh(&mut self, _: &str) -> Result<Arc<Mesh>, MeshError> {
        Ok(Arc::clone(&self.0))
    }

    fn picture(&mut self, name: &str) -> Result<PathBuf, String> {
        Ok(PathBuf::from(name))
    }
}

/// An octahedron around the origin, counter-clockwise from outside.
fn octahedron() -> Mesh {
    let positions = vec![Vec3::X, Vec3::Y, Vec3::Z, -Vec3::X, -Vec3::Y, -Vec3::Z];
    let triangles =
        vec![[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]];
    Mesh { positions, triangles, ..Mesh::default() }
}

/// Objects of material 0, which has a picture, or of material 1, which has none.
fn geometry(mesh: Mesh, material: u32, objects: &[&str]) -> Geometry {
    let text = format!(
        "OrthographicCamera {{ center 0 0 5 direction 0 0 -1 up 0 1 0 size 5 }}
         Materials {{ numMaterials 2 Material {{ ImageTexture {{ file a.png }} }} Material {{ }} }}
         Group {{ numObjects {} MaterialIndex {material} {} }}",
        objects.len(),
        objects.join(" ")
    );
    let scene = parse_str("test", &text, &mut TheMesh(Arc::new(mesh))).unwrap_or_else(|e| panic!("{e}"));
    Geometry::build(&scene).unwrap_or_else(|e| panic!("{e}"))
}

/// What a ray finds first of all triangles, solids and planes.
fn surface(geometry: &Geometry, origin: Vec3, direction: Vec3) -> Surface {
    let ray = Ray::new(origin, direction);
    let (exact, interval, counters) = (ExactRay::new(&ray), Interval::FORWARD, &mut Default::default());
    let numbered = geometry.triangles().iter().zip(geometry.triangle_numbers());
    let triangles = numbered.filter_map(|(t, &n)| hit_triangle(t, n, &exact, interval));
    let first = triangles.reduce(|best, hit| if hit.precedes(Some(&best)) { hit } else { best });
    let first = first.or_else(|| geometry.nearest_sheet(&ray, interval, counters));
    let all = 0..geometry.solids().len() as u32;
    let hit = geometry.nearest_solid(all, &exact, interval, first, counters);
    geometry.surface(&ray, &hit.unwrap_or_else(|| panic!("{origin} {direction} hits nothing")))
}

const SMOOTH: &str = "TriangleMesh { obj_file it smooth 1 }";

/// The directions from the corners of a cube around the origin, and some more.
fn directions() -> impl Iterator<Item = Vec3> {
    (0..500).map(|i| {
        let (a, b) = (0.37 * i as f32, 0.73 * i as f32);
        Vec3::new(a.sin() * b.cos(), a.sin() * b.sin(), a.cos()) + Vec3::splat(0.01)
    })
}

/// All of these are met at t = 4, and each shape is there twice.
#[test]
fn of_equally_near_things_the_first_of_the_file_is_hit() {
    let shapes = [
        "Triangle { vertex0 -1 -1 1 vertex1 1 -1 1 vertex2 0 2 1 }",
        "Sphere { center 0 0 0 radius 1 }",
        "Plane { normal 0 0 1 offset 1 }",
        "Transform { Scale 1 2 1 Sphere { center 0 0 0 radius 1 } }",
    ];
    for first in 0..shapes.len() {
        let mut turned = shapes.repeat(2);
        turned.rotate_left(first);
        let geometry = geometry(octahedron(), 1, &turned);
        let ray = Ray::new(Vec3::Z * 5.0, -Vec3::Z);
        let hit = List::new(&geometry).nearest(&ray, Interval::FORWARD, &mut Default::default());
        assert_eq!(hit.map(|hit| (hit.primitive, hit.t)), Some((0, 4.0)), "{}", turned[0]);
    }
}

#[test]
fn a_smooth_octahedron_has_the_normals_of_a_ball_at_its_corners() {
    let geometry = geometry(octahedron(), 1, &[SMOOTH]);
    for axis in [Vec3::X, -Vec3::Y, Vec3::Z] {
        let inside = Vec3::splat(0.001);
        let seen = surface(&geometry, axis * 3.0 + inside, -axis);
        assert!((seen.normal - axis).length() < 0.01, "{axis} {}", seen.normal);
        assert!(seen.is_smooth() && seen.geometric_normal.as_vec3().dot(axis).abs() < 0.6);
    }
    let middle = surface(&geometry, Vec3::ONE, -Vec3::ONE);
    assert!((middle.normal - Vec3::ONE.normalize()).length() < 1e-6);
}

#[test]
fn smooth_normals_go_with_the_inverse_transpose() {
    let list = "Translate 0.5 0 -1 Scale -1 2 0.5 Rotate { 1 2 3 40 }";
    let matrix = DMat4::from_translation(DVec3::new(0.5, 0.0, -1.0))
        * DMat4::from_scale(DVec3::new(-1.0, 2.0, 0.5))
        * DMat4::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 40f64.to_radians());
    let to_world = matrix.inverse().transpose();
    let plain = geometry(octahedron(), 1, &[SMOOTH]);
    let placed = geometry(octahedron(), 1, &[&format!("Transform {{ {list} {SMOOTH} }}")]);
    for way in directions() {
        let before = surface(&plain, way * 3.0, -way);
        let origin = matrix.transform_point3((way * 3.0).as_dvec3()).as_vec3();
        let direction = matrix.transform_vector3(-way.as_dvec3()).as_vec3();
        let after = surface(&placed, origin, direction);
        assert_eq!(before.primitive, after.primitive);
        // On the octahedron |x| + |y| + |z| = 1: these are the weights of the corners, which lie
        // on the axes, and so do their normals.
        let corner = |i: usize| {
            let outward = DVec3::AXES[i] * before.point[i].signum();
            to_world.transform_vector3(outward).normalize() * before.point[i].abs()
        };
        let sum = (corner(0) + corner(1) + corner(2)).normalize();
        let expected = facing(sum, direction.as_dvec3().normalize(), false);
        assert!((after.normal.as_dvec3() - expected).length() < 1e-4, "{} {expected}", after.normal);
    }
}

#[test]
fn a_smooth_surface_faces_whoever_its_triangle_faces() {
    let geometry = geometry(octahedron(), 1, &[SMOOTH]);
    for (a, b) in directions().zip(directions().skip(17)) {
        for origin in [Vec3::splat(0.05), a.normalize() * 4.0] {
            let direction = b * 0.4 - origin;
            let seen = surface(&geometry, origin, direction);
            let (smooth, flat) =
                (seen.normal.dot(direction), seen.geometric_normal.dot(direction.as_dvec3()));
            assert_eq!(smooth > 0.0, flat > 0.0, "{origin} {direction}");
            assert!((seen.normal.length() - 1.0).abs() < 1e-6);
        }
    }
}

#[test]
fn only_smooth_meshes_pay_and_copies_share() {
    let flat = "TriangleMesh { obj_file it }";
    let moved = format!("Transform {{ Translate 9 0 0 {SMOOTH} }}");
    let geometry = geometry(octahedron(), 1, &[flat, SMOOTH, &moved, flat]);
    let normals: Vec<_> = geometry.runs.iter().map(|r| r.smooth.as_ref().map(|s| &s.normals)).collect();
    assert!(normals[0].is_none() && normals[3].is_none());
    assert!(Arc::ptr_eq(normals[1].unwrap(), normals[2].unwrap()));
    assert!(geometry.runs.iter().all(|run| run.uv.is_none()));
}

#[test]
fn flat_surfaces_are_shaded_with_their_own_normal_to_the_bit() {
    let geometry = geometry(octahedron(), 1, &["TriangleMesh { obj_file it }"]);
    for way in directions() {
        let seen = surface(&geometry, way * 3.0, -way);
        assert!(!seen.is_smooth());
        assert_eq!(seen.shading_normal(), seen.geometric_normal);
    }
}

fn near([u, v]: [f64; 2], expected: [f64; 2]) -> bool {
    (u - expected[0]).abs() < 1e-5 && (v - expected[1]).abs() < 1e-5
}

#[test]
fn a_picture_turns_with_its_sphere() {
    let ball = "Sphere { center 1 0 0 radius 2 }";
    let turned = format!("Transform {{ YRotate 90 {ball} }}");
    let squashed = format!("Transform {{ Scale 1 0.25 1 {ball} }}");
    let uv = |object: &str, origin: Vec3, direction: Vec3| {
        let geometry = geometry(octahedron(), 0, &[object]);
        geometry.uv(&surface(&geometry, origin, direction))
    };
    let front = Vec3::new(1.0, 0.0, 9.0);
    assert!(near(uv(ball, front, -Vec3::Z), [0.5, 0.5]));
    assert!(near(uv(ball, Vec3::new(1.0, 9.0, 0.0), -Vec3::Y), [0.5, 1.0]), "the pole");
    assert!(near(uv(ball, Vec3::X * 9.0, -Vec3::X), [0.75, 0.5]));
    // The picture's middle looks along +x now, and the centre is at (0, 0, −1).
    assert!(near(uv(&turned, Vec3::new(9.0, 0.0, -1.0), -Vec3::X), [0.5, 0.5]));
    assert!(near(uv(&squashed, Vec3::new(1.0, 9.0, 0.0), -Vec3::Y), [0.5, 1.0]));
}

#[test]
fn a_picture_on_a_plane_is_scaled_and_moved_with_it() {
    let floor = "Transform { Translate 1 -2 0 UniformScale 4 Plane { normal 0 1 0 offset 0.25 } }";
    let geometry = geometry(octahedron(), 0, &[floor]);
    let seen = surface(&geometry, Vec3::new(3.0, 5.0, 1.0), -Vec3::Y);
    assert!(near(geometry.uv(&seen), [0.5, -0.25]), "{:?}", geometry.uv(&seen));
}

#[test]
fn coordinates_of_a_mesh_are_interpolated_also_when_it_is_mirrored() {
    let uvs = octahedron().positions.iter().map(|p| Vec2::new(p.x * 2.0, p.y - p.z)).collect();
    let mesh = Mesh { uvs, ..octahedron() };
    let object = "TriangleMesh { obj_file it }";
    let mirrored = format!("Transform {{ Scale -1 1 1 {object} }}");
    let geometry = geometry(mesh, 0, &[&mirrored]);
    for way in directions() {
        let seen = surface(&geometry, way * 3.0, -way);
        let p = DVec3::new(-seen.point.x, seen.point.y, seen.point.z);
        assert!(near(geometry.uv(&seen), [p.x * 2.0, p.y - p.z]), "{p}");
    }
}

#[test]
fn a_mesh_without_coordinates_is_wrapped_as_a_ball() {
    let object = "Transform { Translate 0 5 0 TriangleMesh { obj_file it } }";
    let geometry = geometry(octahedron(), 0, &[object]);
    let seen = surface(&geometry, Vec3::new(0.3, 5.0, 4.0), -Vec3::Z);
    let longitude = 0.3f64.atan2(0.7) / std::f64::consts::TAU;
    assert!(near(geometry.uv(&seen), [0.5 + longitude, 0.5]), "{:?}", geometry.uv(&seen));
}

#[test]
fn a_triangle_shows_half_of_the_picture() {
    let object = "Triangle { vertex0 0 0 0 vertex1 2 0 0 vertex2 0 2 0 }";
    let mirrored = format!("Transform {{ Scale 1 1 -1 {object} }}");
    for object in [object, &mirrored] {
        let geometry = geometry(octahedron(), 0, &[object]);
        let seen = surface(&geometry, Vec3::new(0.5, 1.0, 4.0), -Vec3::Z);
        assert!(near(geometry.uv(&seen), [0.25, 0.5]), "{:?}", geometry.uv(&seen));
    }
}

/// What is worked out beforehand for few triangles and what is worked out at a hit are the same.
#[test]
fn surface_points_have_the_same_bits_with_and_without_facets() {
    let text = "Transform { XRotate 17 Scale 1 2.5 0.3 Translate 3 0.1 -7 TriangleMesh { obj_file it } }";
    let with = geometry(octahedron(), 1, &[text]);
    assert_eq!(with.facets.len(), with.triangles.len());
    let mut without = with.clone();
    without.facets.clear();
    let ray = Ray::new(Vec3::ZERO, Vec3::X);
    for primitive in 0..8 {
        // Inside, on edges, at corners.
        for (u, v) in [(0.25, 0.5), (0.0, 0.3), (0.5, 0.5), (1.0, 0.0), (0.0, 0.0), (1e-7, 0.2)] {
            let hit = Hit { t: 1.0, primitive, u, v };
            assert_eq!(with.surface(&ray, &hit), without.surface(&ray, &hit));
        }
    }
}

/// Balls and planes, eight rays at a time, on every instruction set: what each ray sees alone.
#[test]
fn points_side_by_side_are_those_of_each() {
    let objects = [
        "Sphere { center 1 2 3 radius 0.7 }",
        "Transform { UniformScale 3 Sphere { center -40 0.1 7 radius 2.5 } }",
        "Plane { normal 0.3 1 -0.2 offset -1.7 }",
        "Plane { normal 0 1 0 offset 0 }",
        "TriangleMesh { obj_file octahedron }",
    ];
    let geometry = geometry(octahedron(), 0, &objects);
    let mut checked = 0;
    for name in ["baseline", "sse4", "avx2"] {
        let Some(level) = simd::by_name(name) else { continue };
        for (first, primitive) in (0..400u32).zip((0..4).cycle()) {
            checked += dispatch!(level, s => compare_eight(s, &geometry, first, primitive));
        }
    }
    assert!(checked >= 3200);
    assert!(matches!(geometry.round(4).0, Round::Other));
}

/// Compares eight made-up hits of a primitive; returns how many.
fn compare_eight<S: Simd>(simd: S, geometry: &Geometry, first: u32, primitive: u32) -> usize {
    let number = |i: u32| (i.wrapping_mul(2_654_435_761) >> 8) as f32 / (1 << 23) as f32 - 1.0;
    let vector = |i: u32| Vec3::new(number(i), number(i + 7919), number(i + 104_729));
    let rays: Vec<Ray> =
        (0..8).map(|k| Ray::new(vector(first * 8 + k) * 9.0, vector(first * 8 + k + 77_777))).collect();
    let t = |k: usize| 1.0 + number(k as u32 + first);
    let surfaces: Vec<Surface> = rays
        .iter()
        .enumerate()
        .map(|(k, ray)| geometry.surface(ray, &Hit { t: t(k), primitive, u: 0.0, v: 0.0 }))
        .collect();
    let near: Vec<DVec3> = rays.iter().enumerate().map(|(k, ray)| ray.at(f64::from(t(k)))).collect();
    let near = [0, 1, 2].map(|axis| {
        let all: [f64; 8] = std::array::from_fn(|k| near[k][axis]);
        f64x8::from_slice(simd, &all)
    });
    let of = |v: DVec3| [v.x, v.y, v.z].map(|x| f64x8::splat(simd, x));
    let (abreast, error) = match geometry.round(primitive).0 {
        Round::Ball(ball) => Abreast::on_balls(simd, of(ball.center), f64x8::splat(simd, ball.radius), near),
        Round::Plane(plane) => {
            Abreast::on_planes(simd, of(plane.normal), f64x8::splat(simd, plane.offset), near)
        }
        Round::Other => unreachable!("only balls and planes are asked for"),
    };
    let starts = [1.0, -1.0].map(|sign| abreast.beside(simd, f64x8::splat(simd, sign)));
    for (k, surface) in surfaces.iter().enumerate() {
        let lane = |v: &[f64x8<S>; 3]| DVec3::new(v[0][k], v[1][k], v[2][k]);
        assert_eq!(lane(&abreast.point), surface.point);
        assert_eq!(lane(&abreast.normal), surface.geometric_normal);
        assert_eq!(lane(&error), surface.error);
        assert_eq!(abreast.away[k], surface.away());
        for (start, side) in starts.iter().zip([surface.geometric_normal, -surface.geometric_normal]) {
            assert_eq!(Vec3::new(start[0][k], start[1][k], start[2][k]), surface.leave(side));
        }
    }
    surfaces.len()
}
