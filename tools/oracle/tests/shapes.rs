//! Hits against geometry worked out by hand.

mod support;

use common::math::DVec3;
use oracle::{Range, World};
use support::{Random, close, distance, mesh, near, ray, scene_with_mesh, world};

#[test]
fn sphere_roots_at_every_distance() {
    let world = world(1, "Sphere { center 0 0 0 radius 1 }");
    for exponent in 0..9 {
        let away = 10f64.powi(exponent) + 1.0;
        let t = distance(&world, &ray(DVec3::new(0.6, 0.0, away), -DVec3::Z)).expect("a hit");
        near(t, away - 0.8, 4.0 * f64::EPSILON * away);
    }
    let inside = ray(DVec3::new(0.0, 0.6, 0.0), DVec3::X);
    near(distance(&world, &inside).unwrap(), 0.8, 1e-15);
    assert_eq!(distance(&world, &ray(DVec3::new(0.0, 1.0 + 1e-12, -5.0), DVec3::Z)), None);
    assert!(distance(&world, &ray(DVec3::new(0.0, 1.0 - 1e-12, -5.0), DVec3::Z)).is_some());
}

#[test]
fn plane_is_where_its_equation_holds() {
    let world = world(1, "Plane { normal 0 3 4 offset 2 }");
    let normal = DVec3::new(0.0, 0.6, 0.8);
    let mut random = Random(1);
    for _ in 0..1000 {
        let ray = ray(10.0 * random.cube(), random.direction());
        let expected = (2.0 - ray.origin.dot(normal)) / ray.direction.dot(normal);
        let hit = world.nearest(&ray, Range::LINE).expect("a hit");
        near(hit.t, expected, 1e-12 * expected.abs().max(1.0));
        close(hit.normal, normal, 1e-15);
    }
    assert_eq!(distance(&world, &ray(DVec3::ZERO, DVec3::X)), None);
}

#[test]
fn disc_ends_at_its_radius() {
    // The centre is projected onto the plane z = 1.
    let world = world(1, "Plane { normal 0 0 1 offset 1 center 2 0 7 radius 0.5 }");
    let down = |x: f64, y: f64| distance(&world, &ray(DVec3::new(x, y, 3.0), -DVec3::Z));
    assert_eq!(down(2.0, 0.5), Some(2.0));
    assert_eq!(down(1.5, 0.0), Some(2.0));
    assert_eq!(down(2.4, 0.4), None);
    assert_eq!(down(2.0, 0.51), None);
}

#[test]
fn triangle_holds_the_points_of_nonnegative_barycentrics() {
    let world = world(1, "Triangle { vertex0 1 0 0 vertex1 0 2 0 vertex2 0 0 3 }");
    let [a, b, c] = [DVec3::X, 2.0 * DVec3::Y, 3.0 * DVec3::Z];
    let normal = (b - a).cross(c - a).normalize();
    let mut random = Random(2);
    for _ in 0..10_000 {
        let (u, v) = (2.0 * random.unit() - 0.5, 2.0 * random.unit() - 0.5);
        let target = a + u * (b - a) + v * (c - a);
        let origin = 5.0 * random.cube();
        let found = world.nearest(&ray(origin, target - origin), Range::FORWARD);
        let inside = u > 1e-12 && v > 1e-12 && u + v < 1.0 - 1e-12;
        let on_line = u.min(v).min(1.0 - u - v).abs() < 1e-12;
        assert!(on_line || inside == found.is_some(), "u = {u}, v = {v}");
        if let Some(hit) = found {
            near(hit.t, origin.distance(target), 1e-12);
            close(hit.normal, normal, 1e-15);
        }
    }
}

#[test]
fn edges_and_corners_belong_to_a_triangle() {
    let world = world(1, "Triangle { vertex0 0 0 0 vertex1 1 0 0 vertex2 0 1 0 }");
    for (x, y) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.5, 0.0), (0.0, 0.25), (0.5, 0.5)] {
        for side in [1.0, -1.0] {
            let ray = ray(DVec3::new(x, y, side), -side * DVec3::Z);
            assert_eq!(distance(&world, &ray), Some(1.0), "at ({x}, {y})");
        }
    }
    assert_eq!(distance(&world, &ray(DVec3::new(-1e-15, 0.5, 1.0), -DVec3::Z)), None);
    assert_eq!(distance(&world, &ray(DVec3::new(0.2, 0.5, 0.0), DVec3::X)), None, "edge-on");
}

/// A closed surface of triangles: an octahedron split `levels` times and pushed out to a lumpy
/// sphere.
fn lumpy(levels: u32) -> Vec<[DVec3; 3]> {
    let mut triangles = Vec::new();
    for i in 0..8 {
        let sign = |bit: i32| if i >> bit & 1 == 0 { 1.0 } else { -1.0 };
        let (x, y, z) = (DVec3::X * sign(0), DVec3::Y * sign(1), DVec3::Z * sign(2));
        triangles.push(if sign(0) * sign(1) * sign(2) > 0.0 { [x, y, z] } else { [x, z, y] });
    }
    for _ in 0..levels {
        let split = |[a, b, c]: [DVec3; 3]| {
            let [ab, bc, ca] = [(a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0];
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        };
        triangles = triangles.into_iter().flat_map(split).collect();
    }
    let push = |v: DVec3| {
        let unit = v.normalize();
        // Rounded as a mesh keeps it, so that tests can aim at the very vertex.
        (unit * (1.0 + 0.2 * (5.0 * unit).sin().element_product())).as_vec3().as_dvec3()
    };
    triangles.into_iter().map(|t| t.map(push)).collect()
}

fn mesh_world(triangles: &[[DVec3; 3]], around: &str) -> World {
    let text = "OrthographicCamera { center 0 0 9 direction 0 0 -1 up 0 1 0 size 4 }
        Materials { numMaterials 1 Material { } } Group { numObjects 1 MaterialIndex 0 ";
    let text = format!("{text} {} }}", around.replace('@', "TriangleMesh { obj_file m.obj }"));
    World::new(&scene_with_mesh(&text, mesh(triangles))).unwrap()
}

#[test]
fn a_closed_mesh_has_no_gaps() {
    let triangles = lumpy(3);
    let world = mesh_world(&triangles, "@");
    let mut random = Random(3);
    for round in 0..40 {
        for [a, b, _] in &triangles {
            let along = if round == 0 { 0.0 } else { random.unit() };
            let target = *a + along * (*b - *a);
            let origin = 0.3 * random.cube();
            let hit = world.nearest(&ray(origin, target - origin), Range::FORWARD);
            near(hit.expect("no gap").t, origin.distance(target), 1e-12);
        }
    }
}

#[test]
fn bounding_spheres_lose_no_triangle() {
    let triangles = lumpy(4);
    let whole = mesh_world(&triangles, "@");
    let mut random = Random(4);
    for _ in 0..300 {
        let ray = ray(3.0 * random.cube(), random.cube());
        let one = |triangle: &[DVec3; 3]| {
            let [a, b, c] = triangle;
            let normal = (b - a).cross(c - a);
            let t = (a - ray.origin).dot(normal) / ray.direction.dot(normal);
            let p = ray.at(t);
            let left = |u: DVec3, v: DVec3| (v - u).cross(p - u).dot(normal) >= 0.0;
            (t > 0.0 && left(*a, *b) && left(*b, *c) && left(*c, *a)).then_some(t)
        };
        let expected = triangles.iter().filter_map(one).reduce(f64::min);
        match (distance(&whole, &ray), expected) {
            (Some(t), Some(e)) => near(t, e, 1e-11),
            (found, expected) => assert_eq!(found, expected),
        }
    }
}

#[test]
fn nearest_wins_and_ties_go_to_the_first() {
    let world = world(
        3,
        "Sphere { center 0 0 -5 radius 1 } Sphere { center 0 0 0 radius 1 }
         Sphere { center 0 0 0 radius 1 }",
    );
    let hit = world.nearest(&ray(9.0 * DVec3::Z, -DVec3::Z), Range::FORWARD).unwrap();
    // Node 0 is the group.
    assert_eq!((hit.t, hit.node, hit.triangle), (8.0, 2, 0));
}
