//! What a run holds in memory.

use super::*;
use crate::collapse::accumulated::Accumulated;
use crate::collapse::build::build;
use crate::collapse::melax::Curvature;
use crate::collapse::memoryless::Memoryless;
use crate::collapse::nearby::Nearby;

/// Bytes of a surface.
fn of_surface(surface: &Surface) -> usize {
    surface.faces.capacity() * size_of_val(&surface.faces[0])
        + surface.points.capacity() * size_of_val(&surface.points[0])
}

/// Bytes for each triangle that are held at once by the mesh's points, the original surface, a run, and
/// what looks for faces that are against the original.
fn bytes<C: Cost>(n: u32, cost: impl Fn(&Surface) -> C) -> f64 {
    let height = |i: u32| ((i % 97) * (i % 89)) as f32 / 8633.0;
    let places: Vec<Vec3> =
        (0..n * n).map(|i| Vec3::new((i % n) as f32, height(i), (i / n) as f32)).collect();
    let square = |i: u32| [[i, i + n, i + 1], [i + 1, i + n, i + n + 1]];
    let triangles = (0..n * (n - 1)).filter(|i| i % n < n - 1).flat_map(square);
    let built = build(&places, triangles);
    let count = built.surface.faces.len();
    let mut run = Run::new(built.clone(), None, cost);
    let full = |run: &Run<C>| {
        let points = run.parent.capacity() * 4 + run.cut.capacity() + run.copies.capacity() * 4;
        of_surface(&run.surface) + points + run.queue.bytes() + run.cost.bytes()
    };
    let before = full(&run);
    run.until(count / 10);
    let looking = Nearby::new(&built.surface, 0.0).bytes();
    let original = of_surface(&built.surface) + built.cut.capacity() + size_of_val(&places[..]);
    (before.max(full(&run)) + original + looking) as f64 / count as f64
}

#[test]
fn no_more_than_250_bytes_are_held_for_a_triangle() {
    let all = [bytes(300, Memoryless::new), bytes(300, Accumulated::new), bytes(300, |_| Curvature)];
    // A run that held less than its faces would not have been counted right.
    assert!(all.iter().all(|&bytes| (64.0..250.0).contains(&bytes)), "{all:?}");
}
