//! Distances against what is known of them: parallel and moved planes, concentric balls.

mod shapes;

use a9_simplification::measure::{Comparison, Original};
use common::math::Vec3;
use common::mesh::Mesh;
use shapes::{ball, beside, cube, mesh, moved, sheet, square};

const SAMPLES: usize = 20_000;

fn compare(original: &Mesh, other: &Mesh) -> Comparison {
    Original::new(original).compare(other, SAMPLES)
}

fn assert_near(value: f64, expected: f64, relative: f64) {
    assert!((value - expected).abs() <= relative * expected.abs(), "{value} is not {expected}");
}

#[test]
fn a9t4_a_mesh_is_at_no_distance_from_itself() {
    for shape in [cube(), ball(9, 3.0), square(7, 0.0, 2.0)] {
        let found = compare(&shape, &shape);
        assert!(found.distance.hausdorff() < 1e-15, "{found:?}");
        assert_eq!(found.flips.faces, 0);
        assert_eq!(found.boundary.is_some(), found.topology.boundary_edges > 0);
        assert!(found.boundary.is_none_or(|b| b.max == 0.0));
    }
}

/// The same surface cut otherwise is at no distance, however it is cut.
#[test]
fn a9t4_cutting_does_not_count() {
    let found = compare(&square(20, 0.0, 1.0), &square(1, 0.0, 1.0));
    assert!(found.distance.hausdorff() < 1e-7, "{:?}", found.distance);
    assert!(found.boundary.unwrap().max < 1e-7);
}

#[test]
fn a9t4_parallel_planes_are_apart_by_their_distance() {
    let found = compare(&square(8, 0.0, 0.0), &square(5, 0.0, 0.25));
    let expected = 0.25 / 2f64.sqrt();
    for way in [found.distance.forward, found.distance.backward, found.boundary.unwrap()] {
        assert_near(way.max, expected, 1e-9);
        assert_near(way.rms, expected, 1e-9);
        assert_near(way.mean, expected, 1e-9);
    }
    assert_near(found.distance.rms(), expected, 1e-9);
}

/// A unit square that slides by s leaves a strip behind, whose points are 0 to s away from it:
/// the mean square is s³/3, the mean s²/2, the largest s.
#[test]
fn a9t4_a_moved_plane_leaves_a_strip_behind() {
    let s = 0.25;
    let found = compare(&square(8, 0.0, 0.0), &square(8, s, 0.0));
    let s = f64::from(s);
    for way in [found.distance.forward, found.distance.backward] {
        assert_near(way.rms * 2f64.sqrt(), (s.powi(3) / 3.0).sqrt(), 0.01);
        assert_near(way.mean * 2f64.sqrt(), s * s / 2.0, 0.01);
        assert_near(way.max * 2f64.sqrt(), s, 1e-9);
    }
    assert_eq!(found.distance.forward.farthest.x, 0.0);
    assert_eq!(found.distance.backward.farthest.x, 1.25);
}

/// The two ways are not the same: a square has nothing that a larger one lacks.
#[test]
fn a9t4_either_way_is_measured_for_itself() {
    let found = compare(&square(4, 0.0, 0.0), &sheet(4, 2, |i, j| Vec3::new(i / 4.0, j / 2.0 * 3.0, 0.0)));
    assert!(found.distance.forward.max < 1e-14);
    assert_near(found.distance.backward.max, 2.0 / 2f64.sqrt(), 1e-9);
    assert_eq!(found.distance.hausdorff(), found.distance.backward.max);
}

/// Balls of radius 2 and 2.5, fine enough that flatness counts for less than a thousandth.
#[test]
fn a9t4_concentric_balls_are_apart_by_the_difference_of_their_radii() {
    let found = compare(&ball(40, 2.0), &ball(40, 2.5));
    let diagonal = Original::new(&ball(40, 2.0)).diagonal();
    assert_near(diagonal, 4.0 * 3f64.sqrt(), 1e-6);
    for way in [found.distance.forward, found.distance.backward] {
        assert_near(way.rms * diagonal, 0.5, 2e-3);
        assert_near(way.max * diagonal, 0.5, 3e-3);
    }
}

/// A single spike between samples of the area is met by its vertex, a single dent of the other
/// mesh by the middle of an edge.
#[test]
fn a9t4_vertices_and_middles_of_edges_are_looked_at() {
    let spike = |p: Vec3| if p == Vec3::new(0.5, 0.5, 0.0) { p + Vec3::Z * 0.1 } else { p };
    let plane = square(100, 0.0, 0.0);
    let found = Original::new(&plane).compare(&moved(square(100, 0.0, 0.0), spike), 10);
    assert_near(found.distance.backward.max * 2f64.sqrt(), 0.1, 1e-6);
    let roof = mesh(vec![Vec3::ZERO, Vec3::X * 2.0, Vec3::Y], vec![[0, 1, 2]]);
    let gap = mesh(
        vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::X * 2.0, Vec3::X + Vec3::Z * 0.5],
        vec![[0, 4, 2], [4, 3, 2]],
    );
    let found = Original::new(&roof).compare(&gap, 0);
    assert!(found.distance.forward.max > 0.1, "{:?}", found.distance.forward);
}

#[test]
fn a9t4_nothing_left_is_infinitely_far() {
    let found = compare(&cube(), &Mesh::default());
    assert_eq!(found.distance.forward.max, f64::INFINITY);
    assert_eq!(found.distance.backward.max, 0.0);
    assert_eq!(found.topology.faces, 0);
    let found = compare(&Mesh::default(), &cube());
    assert_eq!(found.distance.hausdorff(), f64::INFINITY);
}

#[test]
fn a9t5_flipped_faces_are_counted() {
    let mut flipped = square(4, 0.0, 0.01);
    for triangle in &mut flipped.triangles[..4] {
        triangle.swap(0, 1);
    }
    let found = compare(&square(16, 0.0, 0.0), &flipped);
    assert_eq!((found.flips.faces, found.flips.turned), (4, 4));
    assert_near(found.flips.area, 4.0 / 32.0, 1e-6);
    assert_eq!(found.topology.folded_edges, 0, "a fold is an edge that is sharp, not a wound one");
}

/// A speck of the original that looks down does not make what lies over it look up wrongly.
#[test]
fn a9t5_only_what_looks_against_all_around_it_is_turned_over() {
    let mut speckled = square(30, 0.0, 0.0);
    let coarse = square(1, 0.0, 0.001);
    let [a, b, c] = coarse.triangles[0].map(|v| coarse.positions[v as usize].as_dvec3());
    let under = Original::new(&speckled).tree().nearest((a + b + c) / 3.0, None).unwrap();
    let around = under.triangle as usize / 2;
    for triangle in &mut speckled.triangles[2 * (around - 1)..2 * (around + 2)] {
        triangle.swap(0, 1);
    }
    let flips = compare(&speckled, &coarse).flips;
    assert_eq!((flips.faces, flips.turned), (1, 0));
}

/// The bevel of a cube's edge agrees with both its sides; what lies across the edge of a thin
/// plate and faces in is flipped.
#[test]
fn a9t5_where_sides_meet_one_that_agrees_is_enough() {
    let corner = mesh(vec![Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y, -Vec3::Z, Vec3::Y - Vec3::Z], vec![]);
    let wall = [[3, 0, 4]];
    let original = Mesh { triangles: [[0, 1, 2]].into_iter().chain(wall).collect(), ..corner.clone() };
    let floor_outwards = Mesh { triangles: vec![[0, 1, 2]], ..corner };
    assert_eq!(compare(&original, &floor_outwards).flips.faces, 0);
}

#[test]
fn a9t4_the_number_of_threads_changes_nothing() {
    let (fine, coarse) = (beside(ball(30, 1.0), &cube()), beside(ball(7, 1.01), &cube()));
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| compare(&fine, &coarse))
    };
    let one = on(1);
    assert!(one.distance.hausdorff() > 0.0);
    for threads in [2, 3, 7] {
        assert_eq!(on(threads), one);
    }
}

/// All of it once more by asking every triangle for every point of a lattice on the surface.
#[test]
fn a9t4_agrees_with_brute_force() {
    let (one, other) = (ball(4, 1.0), moved(ball(3, 1.0), |p| p * Vec3::new(1.1, 0.9, 1.0)));
    let found = compare(&one, &other).distance.forward;
    let corners = |m: &Mesh| -> Vec<_> {
        m.triangles.iter().map(|t| t.map(|v| m.positions[v as usize].as_dvec3())).collect()
    };
    let targets = corners(&other);
    let (mut sum, mut weight, mut most) = (0.0, 0.0, 0.0f64);
    const STEPS: usize = 12;
    for [a, b, c] in corners(&one) {
        let area = (b - a).cross(c - a).length();
        for i in 0..STEPS {
            for j in 0..STEPS - i {
                let share = |k: usize| (k as f64 + 1.0 / 3.0) / STEPS as f64;
                let p = a + (b - a) * share(j) + (c - a) * share(i);
                let to = |t: &[_; 3]| a9_simplification::measure::nearest_on_triangle(p, *t).distance(p);
                let least = targets.iter().map(to).fold(f64::INFINITY, f64::min);
                sum += area * least * least;
                weight += area;
                most = most.max(least);
            }
        }
    }
    let diagonal = Original::new(&one).diagonal();
    assert_near(found.rms * diagonal, (sum / weight).sqrt(), 0.02);
    assert!(found.max * diagonal >= most * 0.999 && found.max * diagonal < most * 1.1);
}
