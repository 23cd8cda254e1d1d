//! Every triangle of a base mesh cut into n² smaller ones, and each new vertex put into place.

use super::{Generated, rounded};
use crate::mesh::Mesh;
use glam::DVec3;

/// New vertices are numbered corners first, then those on edges, then those inside triangles, so
/// that neighbours share theirs without any search for equal positions.
struct Numbering {
    /// Edges as (lower, higher) corner, sorted.
    edges: Vec<[u32; 2]>,
    corners: usize,
    parts: usize,
}

impl Numbering {
    fn new(base: &Mesh, parts: usize) -> Self {
        let both = |[a, b]: [u32; 2]| [a.min(b), a.max(b)];
        let sides = base.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        let mut edges: Vec<[u32; 2]> = sides.map(both).collect();
        edges.sort_unstable();
        edges.dedup();
        Self { edges, corners: base.positions.len(), parts }
    }

    /// The vertex `step` parts along the way from corner `a` to corner `b`, 0 < step < parts.
    fn on_edge(&self, a: u32, b: u32, step: usize) -> usize {
        let (key, step) = if a < b { ([a, b], step) } else { ([b, a], self.parts - step) };
        let edge = self.edges.binary_search(&key).expect("a side of a base triangle");
        self.corners + edge * (self.parts - 1) + step - 1
    }

    fn first_inside(&self, triangle: usize) -> usize {
        let before = triangle * (self.parts - 1) * self.parts.saturating_sub(2) / 2;
        self.corners + self.edges.len() * (self.parts - 1) + before
    }
}

/// Cuts every triangle of `base` into `parts`² and puts every vertex, given on the flat base
/// triangle, where `place` says.
///
/// # Panics
/// If there would be more than 2³² vertices.
pub fn refine(base: &Mesh, parts: usize, place: impl Fn(DVec3) -> DVec3) -> Generated {
    let numbering = Numbering::new(base, parts);
    let count = numbering.first_inside(base.triangles.len());
    assert!(u32::try_from(count).is_ok(), "too many vertices");
    let placed = |p: DVec3| rounded(place(p));
    let mut out = Generated { positions: Vec::with_capacity(count), triangles: Vec::new() };
    out.positions.extend(base.positions.iter().map(|p| placed(*p)));
    let corner = |v: u32| base.positions[v as usize];
    for &[a, b] in &numbering.edges {
        let along = |step: usize| corner(a) + (corner(b) - corner(a)) * (step as f64 / parts as f64);
        out.positions.extend((1..parts).map(|step| placed(along(step))));
    }
    for t in 0..base.triangles.len() {
        let [a, b, c] = base.corners(t);
        let inside = |i: usize, j: usize| a + ((b - a) * j as f64 + (c - a) * i as f64) / parts as f64;
        out.positions.extend(
            (1..parts).flat_map(|i| (1..parts - i).map(move |j| (i, j))).map(|(i, j)| placed(inside(i, j))),
        );
    }
    out.triangles.reserve_exact(base.triangles.len() * parts * parts);
    for t in 0..base.triangles.len() {
        cut(&numbering, t, base.triangles[t], &mut out.triangles);
    }
    out
}

/// The `parts`² triangles of one base triangle, row by row from its side a–b.
fn cut(numbering: &Numbering, triangle: usize, [a, b, c]: [u32; 3], out: &mut Vec<[u32; 3]>) {
    let parts = numbering.parts;
    let row = |i: usize| -> Vec<u32> {
        (0..=parts - i).map(|j| vertex(numbering, triangle, [a, b, c], i, j)).collect()
    };
    let mut lower = row(0);
    for i in 1..=parts {
        let upper = row(i);
        for j in 0..upper.len() {
            out.push([lower[j], lower[j + 1], upper[j]]);
            if j + 1 < upper.len() {
                out.push([lower[j + 1], upper[j + 1], upper[j]]);
            }
        }
        lower = upper;
    }
}

/// Number of the vertex `j` parts towards b and `i` parts towards c.
fn vertex(numbering: &Numbering, triangle: usize, [a, b, c]: [u32; 3], i: usize, j: usize) -> u32 {
    let n = numbering.parts;
    let index = match (i, j) {
        (0, 0) => return a,
        (0, j) if j == n => return b,
        (i, 0) if i == n => return c,
        (0, j) => numbering.on_edge(a, b, j),
        (i, 0) => numbering.on_edge(a, c, i),
        (i, j) if i + j == n => numbering.on_edge(b, c, i),
        // Rows 1, 2, … have n − 2, n − 3, … vertices inside.
        (i, j) => numbering.first_inside(triangle) + (i - 1) * (2 * n - 2 - i) / 2 + j - 1,
    };
    index as u32
}
