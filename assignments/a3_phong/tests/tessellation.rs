//! A3T2: what becomes of shapes when they are cut into polygons.

mod world;

use a3_phong::Tessellation;
use common::math::DVec3;
use std::collections::HashMap;
use std::f64::consts::PI;
use world::{ORTHOGRAPHIC, polygons, studio};

const SPHERE: &str = "Sphere { center 1 2 3 radius 2 }";
/// Determinant −3/4: general and mirroring.
const EGG: &str = "Transform { Translate 1 0 0 XRotate 30 Scale -0.5 3 0.5 Rotate { 1 1 0 20 } Sphere { center 0.2 0 0 radius 1 } }";

fn cut(object: &str, theta: u32, phi: u32) -> Tessellation {
    polygons(&studio(ORTHOGRAPHIC, &[object], (4, 4)), theta, phi)
}

fn corners(t: &Tessellation) -> impl Iterator<Item = [DVec3; 3]> + '_ {
    t.faces.iter().flat_map(|f| f.split(f.corners.map(|k| t.vertices[k as usize].point)))
}

fn area(t: &Tessellation) -> f64 {
    corners(t).map(|[a, b, c]| (b - a).cross(c - a).length() / 2.0).sum()
}

/// By the divergence theorem; positive if faces look outwards.
fn volume(t: &Tessellation) -> f64 {
    corners(t).map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
}

/// How often each directed edge of a polygon occurs.
fn edges(t: &Tessellation) -> HashMap<(u32, u32), usize> {
    let mut edges = HashMap::new();
    for face in &t.faces {
        for k in 0..4 {
            let (from, to) = (face.corners[k], face.corners[(k + 1) % 4]);
            if from != to {
                *edges.entry((from, to)).or_default() += 1;
            }
        }
    }
    edges
}

#[test]
fn a3t2_spheres_are_closed_at_every_resolution() {
    for object in [SPHERE, EGG] {
        for (theta, phi) in [(3, 2), (10, 5), (5, 10), (100, 50)] {
            let t = cut(object, theta, phi);
            let edges = edges(&t);
            assert!(edges.iter().all(|(&(a, b), &n)| n == 1 && edges.get(&(b, a)) == Some(&1)));
            let euler = t.vertices.len() as i64 - edges.len() as i64 / 2 + t.faces.len() as i64;
            assert_eq!(euler, 2, "{theta} x {phi}");
            let triangles = t.faces.iter().filter(|f| f.split(f.corners).count() == 1).count();
            assert_eq!((t.faces.len(), triangles), ((theta * phi) as usize, 2 * theta as usize));
        }
    }
}

#[test]
fn a3t2_no_polygon_is_degenerate_or_bent() {
    for object in [SPHERE, EGG, "Plane { normal 1 2 3 offset 1 }"] {
        let t = cut(object, 12, 7);
        assert!(corners(&t).all(|[a, b, c]| (b - a).cross(c - a).length() > 1e-3));
        for f in &t.faces {
            let at = |k: usize| t.vertices[f.corners[k] as usize].point;
            let size = at(0).length() + at(2).length();
            assert!((1..4).all(|k| f.normal.dot(at(k) - at(0)).abs() < 1e-12 * size), "{f:?}");
        }
    }
}

#[test]
fn a3t2_corners_lie_on_the_sphere_and_their_normals_point_outwards() {
    let center = DVec3::new(1.0, 2.0, 3.0);
    for v in &cut(SPHERE, 16, 8).vertices {
        assert!((v.point.distance(center) - 2.0).abs() < 1e-14);
        assert!((v.point - center - v.normal * 2.0).length() < 1e-14);
    }
}

/// A tangent plane of an ellipsoid touches it from outside: no corner lies beyond it.
#[test]
fn a3t2_normals_of_ellipsoids_belong_to_supporting_planes() {
    let t = cut(EGG, 24, 12);
    for v in &t.vertices {
        assert!(t.vertices.iter().all(|w| v.normal.dot(w.point - v.point) < 1e-12));
    }
}

/// A net inscribed into a smooth surface misses area and volume by O(h²): twice as fine is four
/// times as good.
#[test]
fn a3t2_area_and_volume_converge_with_the_square_of_the_step() {
    let sphere = |n| {
        let t = cut(SPHERE, 2 * n, n);
        [16.0 * PI - area(&t), 32.0 * PI / 3.0 - volume(&t)]
    };
    // |det| = 3/4; the volume is positive although the map mirrors.
    let egg = |n| [PI - volume(&cut(EGG, 2 * n, n))];
    for n in [8, 16, 32, 64] {
        let pairs = sphere(n).into_iter().zip(sphere(2 * n)).chain(egg(n).into_iter().zip(egg(2 * n)));
        for (coarse, fine) in pairs {
            assert!(fine > 0.0, "inscribed: too small");
            assert!((3.8..4.1).contains(&(coarse / fine)), "{n}: {coarse} {fine}");
        }
    }
}

#[test]
fn a3t2_a_disc_is_a_regular_polygon() {
    let disc = "Plane { normal 0 0 1 offset 2 center 1 1 0 radius 3 }";
    for (theta, phi) in [(3, 2), (10, 5), (64, 8)] {
        let n = f64::from(theta);
        let t = cut(disc, theta, phi);
        assert!((area(&t) - 9.0 * n / 2.0 * (2.0 * PI / n).sin()).abs() < 1e-12);
        assert!(t.faces.iter().all(|f| f.normal.distance(DVec3::Z) < 1e-12));
    }
}

#[test]
fn a3t2_a_plane_is_one_flat_sheet_that_reaches_far() {
    let plane = cut("Plane { normal 1 2 2 offset 6 }", 10, 5);
    let n = DVec3::new(1.0, 2.0, 2.0) / 3.0;
    let reach = plane.vertices.iter().map(|v| v.point.length()).fold(0.0, f64::max);
    assert!(reach > 1e5);
    assert!(plane.vertices.iter().all(|v| (v.point.dot(n) - 6.0).abs() < 1e-12 * reach));
    assert!(plane.faces.iter().all(|f| f.normal.distance(n) < 1e-9));
    // Only the outer rim is open: every inner edge has its counterpart.
    let edges = edges(&plane);
    let open = edges.keys().filter(|&&(a, b)| !edges.contains_key(&(b, a))).count();
    let side = plane.faces.len().isqrt();
    assert_eq!((side * side, open), (plane.faces.len(), 4 * side));
}

/// A mirrored cube is a cube: its polygons look outwards.
#[test]
fn a3t2_mirroring_does_not_turn_shapes_inside_out() {
    let cube = "TriangleMesh { obj_file cube.obj }";
    for scale in ["1 1 1", "-1 1 1", "-1 -2 -1", "1 1 -0.5"] {
        for shape in [cube, "Sphere { center 0 0 0 radius 1 }"] {
            let t = cut(&format!("Transform {{ YRotate 30 Scale {scale} {shape} }}"), 20, 10);
            assert!(volume(&t) > 1.0, "{scale} {shape}");
            assert!(t.faces.iter().all(|f| {
                let at = |k: usize| t.vertices[f.corners[k] as usize].point;
                f.normal.dot(at(0)) > 0.0 && f.normal.dot((at(1) - at(0)).cross(at(2) - at(0))) > 0.0
            }));
        }
    }
}

#[test]
fn a3t2_primitives_keep_their_order_and_material() {
    let objects = ["TriangleMesh { obj_file cube.obj }", SPHERE, "Plane { normal 0 1 0 offset 0 }", EGG];
    let t = polygons(&studio(ORTHOGRAPHIC, &objects, (4, 4)), 6, 4);
    assert!(t.faces.is_sorted_by_key(|f| f.primitive));
    let count = |p: u32| t.faces.iter().filter(|f| f.primitive == p).count();
    assert!((0..12).all(|p| count(p) == 1));
    assert_eq!((count(12), count(14)), (24, 24));
}
