//! Counts of meshes whose counts are known: closed, open, with holes, and broken ones.

mod shapes;

use a9_simplification::measure::{Original, Topology};
use common::math::Vec3;
use common::mesh::Mesh;
use shapes::{ball, beside, cube, mesh, moved, sheet, square, torus};

fn topology(mesh: &Mesh) -> Topology {
    *Original::new(mesh).topology()
}

#[test]
fn a9t5_a_cube() {
    let expected =
        Topology { faces: 12, vertices: 8, edges: 18, components: 1, euler: 2, ..Topology::default() };
    assert_eq!(topology(&cube()), expected);
    assert!(expected.is_manifold());
}

#[test]
fn a9t5_places_that_are_named_several_times_count_once() {
    let ball = topology(&ball(5, 1.0));
    let expected =
        Topology { faces: 200, vertices: 102, edges: 300, components: 1, euler: 2, ..Topology::default() };
    assert_eq!(ball, expected);
}

#[test]
fn a9t5_handles_and_parts() {
    let ring = topology(&torus(12, 7));
    assert_eq!((ring.euler, ring.components, ring.boundary_edges), (0, 1, 0));
    let pair = topology(&beside(cube(), &moved(cube(), |p| p + Vec3::X * 2.0)));
    assert_eq!((pair.euler, pair.components), (4, 2));
    assert!(ring.is_manifold() && pair.is_manifold());
}

#[test]
fn a9t5_rims_and_holes() {
    let sheet = square(5, 0.0, 0.0);
    let whole = topology(&sheet);
    assert_eq!((whole.boundary_edges, whole.boundary_loops, whole.euler), (20, 1, 1));
    // Without the square in the middle there is a hole of four edges.
    let mut holed = sheet.clone();
    holed.triangles.drain(24..26);
    let hole = topology(&holed);
    assert_eq!((hole.boundary_edges, hole.boundary_loops, hole.euler), (24, 2, 0));
    // Two holes that touch at a vertex: it has two fans, and one rim goes round both.
    holed.triangles.drain(34..36);
    let touching = topology(&holed);
    assert_eq!((touching.boundary_edges, touching.boundary_loops), (28, 2));
    assert_eq!((touching.non_manifold_vertices, touching.euler), (1, -1));
}

#[test]
fn a9t5_three_pages_of_a_book() {
    let points = vec![Vec3::ZERO, Vec3::Z, Vec3::X, Vec3::Y, -Vec3::X];
    let book = topology(&mesh(points, vec![[0, 1, 2], [0, 1, 3], [0, 1, 4]]));
    assert_eq!((book.non_manifold_edges, book.boundary_edges, book.components), (1, 6, 1));
    assert!(!book.is_manifold());
}

#[test]
fn a9t5_a_bow_tie() {
    let points = vec![Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y, -Vec3::X, -Vec3::X - Vec3::Y];
    let tie = topology(&mesh(points, vec![[0, 1, 2], [0, 3, 4]]));
    assert_eq!((tie.non_manifold_vertices, tie.components, tie.boundary_loops), (1, 2, 2));
    assert_eq!(tie.non_manifold_edges, 0);
}

/// A strip with half a turn: one loop, Euler characteristic 0, and somewhere front meets back.
#[test]
fn a9t5_a_moebius_strip() {
    let n = 9;
    let place = |i: f32, j: f32| {
        let (turn, across) = (std::f32::consts::TAU * i / n as f32, (j - 0.5) * 0.5);
        let r = 1.0 + across * (turn / 2.0).cos();
        Vec3::new(r * turn.cos(), r * turn.sin(), across * (turn / 2.0).sin())
    };
    let mut strip = sheet(n, 1, place);
    // The last column is the first one, upside down.
    let glue = |v: u32| match v {
        v if v == n => n + 1,
        v if v == 2 * n + 1 => 0,
        v => v,
    };
    strip.triangles.iter_mut().for_each(|t| *t = t.map(glue));
    let found = topology(&strip);
    assert_eq!((found.euler, found.boundary_loops, found.inconsistent_edges), (0, 1, 1));
    assert!(!found.is_manifold());
}

#[test]
fn a9t5_faults_of_single_triangles() {
    let mut faulty = cube();
    faulty.triangles.push([1, 0, 2]);
    faulty.triangles.push([3, 3, 4]);
    faulty.positions.push(Vec3::new(0.5, 0.0, 0.0));
    faulty.triangles.push([0, 8, 1]);
    let found = topology(&faulty);
    assert_eq!((found.duplicate_faces, found.zero_area_faces), (0, 2));
    faulty.triangles.push([2, 0, 1]);
    assert_eq!(topology(&faulty).duplicate_faces, 1);
}

#[test]
fn a9t5_folds_are_edges_whose_sides_lie_on_each_other() {
    let points = |z: f32| vec![Vec3::ZERO, Vec3::X, Vec3::new(0.5, 1.0, 0.0), Vec3::new(0.5, 1.0, z)];
    let hinge = |z: f32| topology(&mesh(points(z), vec![[0, 1, 2], [1, 0, 3]])).folded_edges;
    // Half an angle of 15° between the two is the limit: the normals are 150° apart at 30°.
    assert_eq!((hinge(0.5), hinge(0.6)), (1, 0));
}

#[test]
fn a9t5_what_is_broken_is_said() {
    let (closed, sheet) = (topology(&cube()), topology(&square(3, 0.0, 0.0)));
    assert_eq!(closed.broken_by(&topology(&ball(2, 1.0))), Vec::<String>::new());
    let broken = closed.broken_by(&sheet);
    assert!(broken.contains(&"Euler characteristic: 2 before, 1 now".to_owned()), "{broken:?}");
    assert!(broken.contains(&"boundary loops: 0 before, 1 now".to_owned()), "{broken:?}");
    let mut doubled = cube();
    doubled.triangles.push(doubled.triangles[0]);
    let broken = closed.broken_by(&topology(&doubled));
    assert!(broken.iter().any(|b| b.starts_with("duplicate faces: 0 before, 1 now")), "{broken:?}");
    assert!(broken.iter().any(|b| b.starts_with("non-manifold edges: 0")), "{broken:?}");
    assert_eq!(topology(&doubled).broken_by(&closed), Vec::<String>::new(), "a fault less");
}
