//! A9T5: how the triangles of a mesh hang together.

use super::edges::{Edge, Edges, Side};
use super::surface::Surface;
use super::union::Union;
use common::mesh::has_area;
use std::collections::HashSet;

/// Cosine of the angle between the normals of two triangles from which on the edge between them
/// counts as folded: 150°.
const FOLDED: f64 = -0.866_025_403_784_438_6;

/// Counts that tell whether a mesh is whole; vertices at one place count as one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Topology {
    /// Triangles.
    pub faces: usize,
    /// Vertices that a triangle uses.
    pub vertices: usize,
    /// Pairs of vertices that a triangle joins.
    pub edges: usize,
    /// Parts between which no edge leads.
    pub components: usize,
    /// Vertices − edges + triangles: for closed surfaces 2 for each part less 2 for each handle.
    pub euler: i64,
    /// Edges with a triangle on one side only.
    pub boundary_edges: usize,
    /// Closed chains that those form.
    pub boundary_loops: usize,
    /// Edges of three triangles or more.
    pub non_manifold_edges: usize,
    /// Vertices whose triangles form more than one fan.
    pub non_manifold_vertices: usize,
    /// Edges whose two triangles disagree about which side is the front.
    pub inconsistent_edges: usize,
    /// Edges whose two triangles lie nearly on each other: more than 150° between their normals.
    pub folded_edges: usize,
    /// Triangles with the same three corners as an earlier one.
    pub duplicate_faces: usize,
    /// Triangles without area.
    pub zero_area_faces: usize,
}

impl Topology {
    /// Counts everything.
    pub fn of(surface: &Surface, edges: &Edges) -> Self {
        let triangles = &surface.welded.triangles;
        let mut counts = Self { faces: triangles.len(), ..Self::default() };
        let mut parts = Union::new(triangles.len());
        let mut fans = Union::new(3 * triangles.len());
        for edge in edges.iter() {
            counts.add_edge(&edge, surface);
            join_across(&edge, triangles, &mut parts, &mut fans);
        }
        let whole = |t: &u32| has_three_corners(&triangles[*t as usize]);
        let faces = (0..triangles.len() as u32).filter(whole);
        counts.vertices = count_used(surface);
        counts.components = faces.clone().filter(|&t| parts.is_root(t)).count();
        counts.euler = counts.vertices as i64 - counts.edges as i64 + faces.count() as i64;
        counts.non_manifold_vertices = vertices_of_several_fans(surface, &fans);
        counts.boundary_loops = count_loops(edges, &mut fans);
        let mut seen = HashSet::with_capacity(triangles.len());
        counts.duplicate_faces = triangles.iter().filter(|t| !seen.insert(sorted(**t))).count();
        let flat = |t: &&[u32; 3]| !has_area(t.map(|v| surface.welded.positions[v as usize]));
        counts.zero_area_faces = triangles.iter().filter(flat).count();
        counts
    }

    fn add_edge(&mut self, edge: &Edge, surface: &Surface) {
        self.edges += 1;
        self.boundary_edges += usize::from(edge.triangles() == 1);
        self.non_manifold_edges += usize::from(edge.triangles() > 2);
        self.inconsistent_edges += usize::from(edge.is_wound_badly());
        let Some(pair) = edge.pair() else { return };
        let [a, b] = pair.map(|side| surface.normals[side.triangle as usize]);
        let cosine = if edge.is_wound_badly() { -a.dot(b) } else { a.dot(b) };
        self.folded_edges += usize::from(cosine < FOLDED);
    }

    /// Whether every edge has at most two triangles that agree about the front, and every vertex
    /// one fan.
    pub fn is_manifold(&self) -> bool {
        self.non_manifold_edges + self.non_manifold_vertices + self.inconsistent_edges == 0
    }

    /// What a simplification of this mesh into `after` broke, in words; empty if nothing. Faults
    /// may not be more. Parts, boundaries and the Euler characteristic of a manifold must be the
    /// same; of what is none they depend on what is left out of it.
    pub fn broken_by(&self, after: &Self) -> Vec<String> {
        let mut broken = Vec::new();
        let whole = self.is_manifold() && self.duplicate_faces + self.zero_area_faces == 0;
        for (what, before, now) in [
            ("components", self.components as i64, after.components as i64),
            ("Euler characteristic", self.euler, after.euler),
            ("boundary loops", self.boundary_loops as i64, after.boundary_loops as i64),
        ] {
            if whole && before != now {
                broken.push(format!("{what}: {before} before, {now} now"));
            }
        }
        for (what, before, now) in [
            ("non-manifold edges", self.non_manifold_edges, after.non_manifold_edges),
            ("non-manifold vertices", self.non_manifold_vertices, after.non_manifold_vertices),
            ("edges wound inconsistently", self.inconsistent_edges, after.inconsistent_edges),
            ("duplicate faces", self.duplicate_faces, after.duplicate_faces),
            ("faces without area", self.zero_area_faces, after.zero_area_faces),
        ] {
            if now > before {
                broken.push(format!("{what}: {before} before, {now} now"));
            }
        }
        broken
    }
}

fn sorted(mut triangle: [u32; 3]) -> [u32; 3] {
    triangle.sort_unstable();
    triangle
}

/// The number of a triangle's corner at vertex `v`.
fn corner_at(triangles: &[[u32; 3]], side: Side, v: u32) -> u32 {
    let corners = triangles[side.triangle as usize];
    3 * side.triangle + (0..3).find(|&k| corners[k as usize] == v).unwrap_or(side.corner)
}

/// Triangles that share an edge are of one part; if just two do, their corners at either end are
/// of one fan.
fn join_across(edge: &Edge, triangles: &[[u32; 3]], parts: &mut Union, fans: &mut Union) {
    let mut sides = edge.sides();
    let first = sides.next().map_or(0, |side| side.triangle);
    sides.for_each(|side| parts.join(first, side.triangle));
    let Some([one, other]) = edge.pair() else { return };
    for v in edge.vertices() {
        fans.join(corner_at(triangles, one, v), corner_at(triangles, other, v));
    }
}

/// A triangle that names a vertex twice joins nothing and counts for nothing but itself.
fn has_three_corners([a, b, c]: &[u32; 3]) -> bool {
    a != b && b != c && c != a
}

fn count_used(surface: &Surface) -> usize {
    let mut used = vec![false; surface.welded.positions.len()];
    let whole = surface.welded.triangles.iter().filter(|t| has_three_corners(t));
    whole.flatten().for_each(|&v| used[v as usize] = true);
    used.into_iter().filter(|&used| used).count()
}

fn vertices_of_several_fans(surface: &Surface, fans: &Union) -> usize {
    let mut count = vec![0u32; surface.welded.positions.len()];
    for (triangle, corners) in (0..).zip(&surface.welded.triangles).filter(|(_, t)| has_three_corners(t)) {
        for (k, &v) in (0..).zip(corners) {
            count[v as usize] += u32::from(fans.is_root(3 * triangle + k));
        }
    }
    count.into_iter().filter(|&fans| fans > 1).count()
}

/// At either end of a boundary edge stands an open fan, which one other boundary edge ends; so
/// edges that share a fan follow each other. Where two holes touch at a vertex, one rim goes round
/// both, as it would if the vertex were drawn apart.
fn count_loops(edges: &Edges, fans: &mut Union) -> usize {
    let mut starts = Vec::new();
    for edge in edges.iter().filter(|edge| edge.triangles() == 1) {
        let Some(side) = edge.sides().next() else { continue };
        let (from, to) = (3 * side.triangle + side.corner, 3 * side.triangle + (side.corner + 1) % 3);
        // The fans are not needed for anything else any more.
        fans.join(from, to);
        starts.push(from);
    }
    let roots: HashSet<u32> = starts.into_iter().map(|corner| fans.root(corner)).collect();
    roots.len()
}
