//! The reported error bounds what can be measured, and goals by error are kept.

use crate::shapes::{METHODS, cube, generated, mesh, one};
use a9_simplification::{Goal, Method, Simplified};
use common::math::{Bounds, DVec3, Vec3};
use common::mesh::Mesh;

/// Distance to a triangle: to its plane if that point is inside, else to the nearest side.
fn distance(p: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let n = (b - a).cross(c - a);
    let inside = [(a, b), (b, c), (c, a)].iter().all(|(s, t)| (t - s).cross(p - s).dot(n) >= 0.0);
    if inside {
        return (p - a).dot(n).abs() / n.length();
    }
    let side = |(s, t): (DVec3, DVec3)| {
        let along = ((p - s).dot(t - s) / (t - s).length_squared()).clamp(0.0, 1.0);
        (p - s - (t - s) * along).length()
    };
    [(a, b), (b, c), (c, a)].map(side).into_iter().fold(f64::MAX, f64::min)
}

/// Largest distance of a lattice of points on each triangle.
fn sampled(simplified: &Mesh, original: &Mesh, n: u32) -> f64 {
    let corners = |mesh: &Mesh, t: [u32; 3]| t.map(|i| mesh.positions[i as usize].as_dvec3());
    let triangles: Vec<_> = original.triangles.iter().map(|&t| corners(original, t)).collect();
    let nearest = |p: DVec3| triangles.iter().map(|&t| distance(p, t)).fold(f64::MAX, f64::min);
    let mut largest = 0.0f64;
    for &t in &simplified.triangles {
        let [a, b, c] = corners(simplified, t);
        for (i, j) in (0..=n).flat_map(|i| (0..=n - i).map(move |j| (i, j))) {
            let (u, v) = (f64::from(i) / f64::from(n), f64::from(j) / f64::from(n));
            largest = largest.max(nearest(a + (b - a) * u + (c - a) * v));
        }
    }
    largest
}

fn diagonal(mesh: &Mesh) -> f64 {
    Bounds::of_points(mesh.positions.iter().copied()).size().as_dvec3().length()
}

#[test]
fn the_error_bounds_what_is_sampled() {
    for recipe in ["sphere700", "terrain700", "gyroid1000"] {
        let original = generated(recipe);
        for method in METHODS {
            for ratio in [0.4, 0.1] {
                let Simplified { mesh, error, .. } = one(&original, Goal::Ratio(ratio), method);
                let found = sampled(&mesh, &original, 3).max(sampled(&original, &mesh, 2));
                let error = error.unwrap();
                assert!(error >= found * (1.0 - 1e-9), "{recipe} {method:?} {ratio}: {error} < {found}");
            }
        }
    }
}

#[test]
fn the_bound_is_close() {
    let original = generated("sphere4000");
    let Simplified { mesh, error, .. } = one(&original, Goal::Ratio(0.2), Method::Memoryless);
    assert!(error.unwrap() < 1.3 * sampled(&mesh, &original, 3).max(sampled(&original, &mesh, 2)));
}

#[test]
fn the_bound_is_close_where_few_large_faces_meet_at_sharp_edges() {
    let mut part = cube(24);
    // Twisted and bulging, but for the underside.
    for p in &mut part.positions {
        let (s, c) = (0.2 * (p.y + 0.5)).sin_cos();
        let wide = 1.0 + 0.3 * (p.y + 0.5) * (0.5 - p.y);
        *p = Vec3::new((c * p.x - s * p.z) * wide, p.y, (s * p.x + c * p.z) * wide);
    }
    for method in METHODS {
        let Simplified { mesh, error, .. } = one(&part, Goal::Ratio(0.01), method);
        let found = sampled(&mesh, &part, 8).max(sampled(&part, &mesh, 1));
        let error = error.unwrap();
        assert!(error >= found * (1.0 - 1e-9) && error < 1.3 * found, "{method:?}: {error} for {found}");
    }
}

#[test]
fn goals_by_error_are_kept_and_used() {
    let original = generated("sphere4000");
    let mut last = usize::MAX;
    for most in [1e-3, 3e-3, 1e-2] {
        let Simplified { mesh, error, .. } = one(&original, Goal::Error(most), Method::Memoryless);
        assert!(error.unwrap() <= most * diagonal(&original));
        assert!(error.unwrap() > 0.3 * most * diagonal(&original), "{most}");
        assert!(mesh.triangles.len() < last, "a larger error for fewer triangles");
        last = mesh.triangles.len();
    }
}

#[test]
fn without_error_what_is_flat_still_goes() {
    let flat = crate::shapes::grid(10, |u, v| Vec3::new(u, v, 0.0));
    assert_eq!(
        one(&mesh(flat.positions, flat.triangles), Goal::Error(1e-6), Method::Memoryless)
            .mesh
            .triangles
            .len(),
        2
    );
}
