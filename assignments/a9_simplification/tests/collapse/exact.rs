//! Shapes whose simplification is known.

use crate::shapes::{METHODS, cube, generated, grid, mesh, normal, one};
use crate::topology::counts;
use a9_simplification::{Goal, Method, Stopped};
use common::math::{DVec3, Vec3};
use common::mesh::Mesh;

fn volume(mesh: &Mesh) -> f64 {
    let six = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| mesh.positions[i as usize].as_dvec3());
        a.dot(b.cross(c))
    };
    mesh.triangles.iter().map(six).sum::<f64>() / 6.0
}

#[test]
fn a_cube_of_many_triangles_becomes_one_of_twelve() {
    for method in METHODS {
        let simplified = one(&cube(8), Goal::Faces(12), method);
        assert_eq!(simplified.mesh.triangles.len(), 12, "{method:?}");
        let corner = |p: &Vec3| p.abs() == Vec3::splat(0.5);
        assert!(simplified.mesh.positions.iter().all(corner), "{method:?} {:?}", simplified.mesh.positions);
        assert_eq!(simplified.mesh.positions.len(), 8);
        assert_eq!(volume(&simplified.mesh), 1.0);
        assert!(simplified.error.unwrap() < 1e-6);
    }
}

#[test]
fn a_square_becomes_two_triangles_without_error() {
    let squares = [
        grid(16, |u, v| Vec3::new(u, v, 0.0)),
        grid(16, |u, v| Vec3::new(100.0 + u * u, 7.0, v)),
        grid(16, |u, v| Vec3::new(u, v, u + v)),
    ];
    for square in &squares {
        for method in METHODS {
            let simplified = one(square, Goal::Faces(2), method);
            assert_eq!(simplified.mesh.triangles.len(), 2, "{method:?}");
            let area = |mesh: &Mesh| mesh.triangles.iter().map(|&t| normal(mesh, t)).sum::<Vec3>();
            let (now, then) = (area(&simplified.mesh), area(square));
            assert!((now - then).length() < 1e-4 * then.length(), "{method:?} {now} {then}");
            // Half a unit in the last place of 100.
            assert!(simplified.error.unwrap() < 1e-5, "{method:?} {:?}", simplified.error);
        }
    }
}

/// However long its edges have become: in a corner of this sheet there is a bump a two-thousandth high.
#[test]
fn what_is_flat_goes_before_what_is_hardly_bent() {
    let bump = |x: f32| if x < 0.3 { (x / 0.3 * std::f32::consts::PI).sin().powi(2) } else { 0.0 };
    let sheet = grid(60, |u, v| Vec3::new(u, v, 5e-4 * bump(u) * bump(v)));
    let simplified = one(&sheet, Goal::Ratio(0.5), Method::Memoryless);
    // Three times as much where the length of edges counts a hundred times as much.
    assert!(simplified.error.unwrap() < 8e-6, "{:?}", simplified.error);
}

#[test]
fn error_goes_down_with_better_methods() {
    let ball = grid(40, |u, v| {
        let (u, v) = (2.0 * u - 1.0, 2.0 * v - 1.0);
        Vec3::new(u, v, (4.0 - u * u - v * v).sqrt())
    });
    let off = |method| {
        let simplified = one(&ball, Goal::Faces(100), method).mesh;
        let distances = simplified.triangles.iter().map(|t| {
            let middle = t.iter().map(|&i| simplified.positions[i as usize].as_dvec3()).sum::<DVec3>() / 3.0;
            (middle.length() - 2.0).powi(2)
        });
        (distances.sum::<f64>() / simplified.triangles.len() as f64).sqrt()
    };
    let [qem, memoryless, melax] = METHODS.map(off);
    assert!(memoryless < qem && qem < melax, "{memoryless} {qem} {melax}");
}

#[test]
fn a_tetrahedron_and_a_triangle_are_as_simple_as_can_be() {
    let p = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
    let tetrahedron = mesh(p.to_vec(), vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]);
    let triangle = mesh(p[..3].to_vec(), vec![[0, 1, 2]]);
    for method in METHODS {
        for shape in [&tetrahedron, &triangle] {
            let simplified = one(shape, Goal::Faces(0), method);
            assert_eq!(simplified.stopped, Stopped::Stuck);
            assert_eq!(counts(&simplified.mesh), counts(shape));
            assert_eq!(simplified.mesh.triangles.len(), shape.triangles.len());
        }
    }
}

#[test]
fn a_ball_ends_as_a_tetrahedron() {
    let simplified = one(&generated("sphere2000"), Goal::Faces(0), Method::Qem);
    assert_eq!(simplified.stopped, Stopped::Stuck);
    assert!(simplified.mesh.triangles.len() <= 12, "{}", simplified.mesh.triangles.len());
    assert_eq!(counts(&simplified.mesh).euler, 2);
}
