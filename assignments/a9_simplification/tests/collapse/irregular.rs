//! Meshes that are no surface, or hardly: handled or refused, never a panic or a loop.

use crate::shapes::{METHODS, cube, generated, grid, mesh, one};
use crate::topology::counts;
use a9_simplification::{Goal, Irregular, Method, Settings, SimplifyError, Stopped, simplify};
use common::math::{Vec2, Vec3};
use common::mesh::Mesh;

fn refused(mesh: &Mesh, goal: Goal) -> SimplifyError {
    simplify(mesh, &[goal], &Settings::default()).unwrap_err()
}

/// Two meshes as one, welded where `join` says so.
fn both(a: &Mesh, b: &Mesh) -> Mesh {
    let first = a.positions.len() as u32;
    let moved = b.triangles.iter().map(|t| t.map(|i| i + first));
    mesh([&a.positions[..], &b.positions].concat(), a.triangles.iter().copied().chain(moved).collect())
}

#[test]
fn what_makes_no_sense_is_refused_with_its_place() {
    let good = grid(3, |u, v| Vec3::new(u, v, 0.0));
    let mut bad = good.clone();
    bad.positions[5].y = f32::NAN;
    assert_eq!(refused(&bad, Goal::Faces(2)), SimplifyError::NotFinite { vertex: 5 });
    let mut bad = good.clone();
    bad.triangles[7][2] = 99;
    let error = refused(&bad, Goal::Faces(2));
    assert_eq!(error, SimplifyError::NoSuchVertex { triangle: 7, corner: 99, vertices: 16 });
    assert_eq!(error.to_string(), "triangle 7 has corner 99, but there are 16 vertices");
    let mut bad = good.clone();
    bad.uvs = vec![Vec2::ZERO; 3];
    assert!(matches!(refused(&bad, Goal::Faces(2)), SimplifyError::Unaligned { given: 3, vertices: 16, .. }));
    for goal in
        [Goal::Ratio(f64::NAN), Goal::Ratio(-0.1), Goal::Ratio(1.5), Goal::Error(-1.0), Goal::Error(f64::NAN)]
    {
        assert!(matches!(refused(&good, goal), SimplifyError::BadGoal { goal: 0, .. }), "{goal:?}");
    }
}

#[test]
fn nothing_comes_of_nothing() {
    for method in METHODS {
        for goal in [Goal::Faces(0), Goal::Ratio(0.5), Goal::Error(0.1)] {
            let simplified = one(&Mesh::default(), goal, method);
            assert_eq!((simplified.mesh, simplified.stopped), (Mesh::default(), Stopped::Reached));
        }
        let loose = mesh(vec![Vec3::ZERO, Vec3::X, Vec3::Y], vec![]);
        assert_eq!(one(&loose, Goal::Faces(1), method).becomes, [u32::MAX; 3]);
        let point = mesh(vec![Vec3::ONE; 3], vec![[0, 1, 2]; 4]);
        let simplified = one(&point, Goal::Faces(1), method);
        assert_eq!(simplified.irregular, Irregular { collapsed: 4, ..Irregular::default() });
        assert!(simplified.mesh.triangles.is_empty());
    }
}

#[test]
fn vertices_are_welded() {
    let soup = |m: &Mesh| {
        let positions = m.triangles.as_flattened().iter().map(|&i| m.positions[i as usize]).collect();
        mesh(positions, (0..m.triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect())
    };
    for method in METHODS {
        assert_eq!(one(&soup(&cube(4)), Goal::Faces(12), method).mesh.positions.len(), 8);
    }
    let mut minus = grid(4, |u, v| Vec3::new(u - 0.5, v, 0.0));
    let twin = grid(4, |u, v| Vec3::new(0.5 - u, -v, -0.0));
    minus = both(&minus, &twin);
    assert_eq!(counts(&one(&minus, Goal::Faces(40), Method::Qem).mesh).components, 1, "-0 is 0");
}

#[test]
fn repeated_triangles_are_left_out() {
    let mut twice = generated("sphere1000");
    let count = twice.triangles.len();
    let turned: Vec<_> = twice.triangles[..100].iter().map(|&[a, b, c]| [b, c, a]).collect();
    twice.triangles.extend(turned);
    let simplified = one(&twice, Goal::Faces(200), Method::Memoryless);
    assert_eq!(simplified.irregular, Irregular { repeated: 100, ..Irregular::default() });
    assert_eq!(counts(&simplified.mesh).euler, 2);
    assert!(count > 900 && simplified.mesh.triangles.len() <= 200);
}

/// Two balls that touch in a point, in an edge; a fin on a ball; a Möbius band; a ball of which
/// a half is inside out; two sheets back to back.
fn odd() -> Vec<(&'static str, Mesh)> {
    let ball = generated("sphere1000");
    let [a, b, _] = ball.triangles[0].map(|i| ball.positions[i as usize]);
    let mut beside = ball.clone();
    // A half turn about the vertex, and about the edge.
    beside.positions.iter_mut().for_each(|p| *p = a * 2.0 - *p);
    beside.triangles.iter_mut().for_each(|t| t.swap(1, 2));
    let mut along = ball.clone();
    let axis = (b - a).normalize();
    for p in &mut along.positions {
        let from = *p - a;
        *p = if *p == a || *p == b { *p } else { a + axis * (2.0 * axis.dot(from)) - from };
    }
    let mut fin = ball.clone();
    fin.positions.push((a + b) * 1.5);
    fin.triangles.push([ball.triangles[0][0], ball.triangles[0][1], ball.positions.len() as u32]);
    let mobius = grid(40, |u, v| {
        let (turn, width) = (std::f32::consts::TAU * u, v - 0.5);
        let (turn, width) = if u == 1.0 { (0.0, -width) } else { (turn, width) };
        let (s, c) = (turn / 2.0).sin_cos();
        Vec3::new(turn.cos() * (2.0 + width * c), turn.sin() * (2.0 + width * c), width * s)
    });
    let mut inverted = ball.clone();
    inverted.triangles.iter_mut().step_by(2).for_each(|t| t.swap(0, 1));
    let sheet = grid(10, |u, v| Vec3::new(u, v, u * v));
    let mut back = sheet.clone();
    back.triangles.iter_mut().for_each(|t| t.swap(0, 1));
    vec![
        ("point", both(&ball, &beside)),
        ("edge", both(&ball, &along)),
        ("fin", fin),
        ("mobius", mobius),
        ("inverted", inverted),
        ("back to back", both(&sheet, &back)),
    ]
}

#[test]
fn what_is_no_surface_is_held_and_reported() {
    for (name, mesh) in odd() {
        for method in METHODS {
            let simplified = one(&mesh, Goal::Ratio(0.2), method);
            assert!(simplified.irregular.held > 0, "{name} {method:?}");
            let whole = one(&mesh, Goal::Ratio(1.0), method);
            let (before, after) = (counts(&whole.mesh), counts(&simplified.mesh));
            assert_eq!(after.bad_edges, before.bad_edges, "{name} {method:?}");
            assert_eq!(after.euler, before.euler, "{name} {method:?}");
            assert_eq!((after.repeated, after.without_area), (before.repeated, 0), "{name} {method:?}");
        }
    }
    let simplified = one(&odd()[0].1, Goal::Ratio(0.2), Method::Memoryless);
    assert_eq!((simplified.irregular.held, simplified.stopped), (1, Stopped::Reached), "one point of 1000");
}

#[test]
fn flat_thin_and_huge_meshes_come_to_an_end() {
    let shapes: Vec<(f32, Mesh)> = [1e-30f32, 1e-3, 1.0, 1e6, 1e30]
        .into_iter()
        .flat_map(|size| {
            let wave = move |u: f32, v: f32| Vec3::new(u, v, 0.1 * (9.0 * u * v).sin()) * size;
            let line = move |u: f32, _: f32| Vec3::new(u, 0.0, 0.0) * size;
            let needle = move |u: f32, v: f32| Vec3::new(u, v * 1e-6, 0.0) * size;
            [(size, grid(20, wave)), (size, grid(5, line)), (size, grid(12, needle))]
        })
        .collect();
    for (size, shape) in &shapes {
        for method in METHODS {
            let simplified = one(shape, Goal::Ratio(0.1), method);
            assert!(simplified.mesh.positions.iter().all(|p| p.is_finite()), "{size} {method:?}");
            assert!(simplified.error.unwrap() <= f64::from(*size) * 2.0, "{size} {method:?}");
        }
    }
    let far = grid(20, |u, v| Vec3::new(1e4 + u, v - 1e4, 1e4 + u * v));
    let simplified = one(&far, Goal::Ratio(0.1), Method::Memoryless);
    assert_eq!(counts(&simplified.mesh).without_area, 0);
}
