//! From a function to triangles: marching tetrahedra.
//!
//! Every cell of a regular lattice is split into the six tetrahedra round its main diagonal (Kuhn's
//! subdivision). They fit face to face from cell to cell, so the triangles of all of them close up
//! to a manifold, which marching cubes does not promise. Source: Doi and Koide, "An efficient
//! method of triangulating equi-valued surfaces by using tetrahedral cells" (1991).

use crate::mesh::{Bounds, Mesh};
use glam::DVec3;

/// A lattice of nodes and the function's values there.
struct Lattice {
    origin: DVec3,
    step: f64,
    nodes: [usize; 3],
    values: Vec<f64>,
}

/// The six ways from a cell's lowest corner to its highest along three edges: each is a
/// tetrahedron. Bits 0, 1, 2 of a corner are its x, y, z. Ordered so that all six have positive
/// volume.
const TETRAHEDRA: [[usize; 4]; 6] =
    [[0, 1, 3, 7], [0, 5, 1, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 4, 5, 7], [0, 6, 4, 7]];

/// The surface on which `f` is zero, as seen on a lattice of cells of size `step` that covers
/// `bounds`. Triangles face towards positive values.
///
/// # Panics
/// If the solid reaches the rim of the lattice, where its surface would be left open.
pub fn polygonise(f: impl Fn(DVec3) -> f64, bounds: Bounds, step: f64) -> Mesh {
    let lattice = sample(f, bounds, step);
    assert!(!lattice.is_cut_off(), "the solid is larger than {bounds:?}");
    // One slot for each edge that leaves a node towards a higher one: seven directions, of which
    // number 0 stays unused.
    let mut vertex_on_edge = vec![u32::MAX; lattice.values.len() * 8];
    let mut mesh = Mesh::default();
    for k in 0..lattice.nodes[2] - 1 {
        for j in 0..lattice.nodes[1] - 1 {
            for i in 0..lattice.nodes[0] - 1 {
                let cell = lattice.index([i, j, k]);
                if lattice.is_crossed(cell) {
                    let mut vertex =
                        |a, b| lattice.vertex(&mut mesh.positions, &mut vertex_on_edge, cell, a, b);
                    for tetrahedron in TETRAHEDRA {
                        let inside = tetrahedron.map(|c| lattice.values[cell + lattice.offset(c)] < 0.0);
                        triangulate(tetrahedron, inside, &mut vertex, &mut mesh.triangles);
                    }
                }
            }
        }
    }
    mesh
}

fn sample(f: impl Fn(DVec3) -> f64, bounds: Bounds, step: f64) -> Lattice {
    let nodes = (bounds.size() / step).to_array().map(|cells| cells.ceil() as usize + 1);
    let mut lattice = Lattice { origin: bounds.min, step, nodes, values: Vec::new() };
    let count = nodes.iter().product();
    lattice.values = (0..count).map(|node| f(lattice.position(node))).collect();
    lattice
}

impl Lattice {
    fn index(&self, [i, j, k]: [usize; 3]) -> usize {
        (k * self.nodes[1] + j) * self.nodes[0] + i
    }

    fn position(&self, node: usize) -> DVec3 {
        let [nx, ny, _] = self.nodes;
        let [i, j, k] = [node % nx, node / nx % ny, node / (nx * ny)].map(|n| n as f64);
        self.origin + self.step * DVec3::new(i, j, k)
    }

    /// From a cell's lowest node to its corner number `corner`.
    fn offset(&self, corner: usize) -> usize {
        self.index([corner & 1, corner >> 1 & 1, corner >> 2])
    }

    /// Whether some node on the rim is inside the solid.
    fn is_cut_off(&self) -> bool {
        let [nx, ny, nz] = self.nodes;
        let rim = |node: usize| {
            let place = [(node % nx, nx), (node / nx % ny, ny), (node / (nx * ny), nz)];
            place.iter().any(|&(i, n)| i == 0 || i + 1 == n)
        };
        (0..self.values.len()).any(|node| self.values[node] < 0.0 && rim(node))
    }

    fn is_crossed(&self, cell: usize) -> bool {
        let first = self.values[cell] < 0.0;
        (1..8).any(|corner| (self.values[cell + self.offset(corner)] < 0.0) != first)
    }

    /// The vertex on the edge between corners `a` and `b` of a cell, made when it is first asked
    /// for.
    fn vertex(&self, positions: &mut Vec<DVec3>, slots: &mut [u32], cell: usize, a: usize, b: usize) -> u32 {
        // Along every edge of the subdivision one corner's bits contain the other's.
        let (low, high) = (a & b, a | b);
        let (p, q) = (cell + self.offset(low), cell + self.offset(high));
        let slot = &mut slots[p * 8 + (high - low)];
        if *slot == u32::MAX {
            let part = self.values[p] / (self.values[p] - self.values[q]);
            *slot = positions.len() as u32;
            // Kept off the lattice nodes, where several edges meet, so that no triangle shrinks to
            // nothing.
            positions.push(self.position(p).lerp(self.position(q), part.clamp(0.05, 0.95)));
        }
        *slot
    }
}

/// Adds the one or two triangles that part the inner corners of a positively oriented tetrahedron
/// from the outer ones.
fn triangulate(
    corners: [usize; 4],
    inside: [bool; 4],
    vertex: &mut impl FnMut(usize, usize) -> u32,
    triangles: &mut Vec<[u32; 3]>,
) {
    let mut on = |i: usize, j: usize| vertex(corners[i], corners[j]);
    let inner = inside.iter().filter(|&&is| is).count();
    match inner {
        1 | 3 => {
            let lone = inside.iter().position(|&is| is == (inner == 1)).expect("one corner differs");
            // Even permutations that put the lone corner first: the triangle then faces away from
            // it.
            let [i, j, k, l] = [[0, 1, 2, 3], [1, 0, 3, 2], [2, 3, 0, 1], [3, 2, 1, 0]][lone];
            let [a, b, c] = [on(i, j), on(i, k), on(i, l)];
            triangles.push(if inner == 1 { [a, b, c] } else { [a, c, b] });
        }
        2 => {
            const EVEN: [[usize; 4]; 6] =
                [[0, 1, 2, 3], [0, 2, 3, 1], [0, 3, 1, 2], [1, 2, 0, 3], [1, 3, 2, 0], [2, 3, 0, 1]];
            let [i, j, k, l] =
                *EVEN.iter().find(|p| inside[p[0]] && inside[p[1]]).expect("two corners are inside");
            let [a, b, c, d] = [on(i, k), on(i, l), on(j, l), on(j, k)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check;

    #[test]
    fn a_ball_comes_out_closed_round_and_facing_outwards() {
        let box_round = Bounds { min: DVec3::splat(-1.3), max: DVec3::splat(1.3) };
        let mesh = polygonise(|p| p.length() - 1.0, box_round, 0.1);
        check::closed_manifold(&mesh).unwrap();
        assert_eq!(check::euler_characteristic(&mesh), 2);
        let ball = 4.0 / 3.0 * std::f64::consts::PI;
        assert!((check::volume(&mesh) / ball - 1.0).abs() < 0.01, "volume {}", check::volume(&mesh));
    }

    #[test]
    fn a_ring_keeps_its_hole() {
        let ring = |p: DVec3| (p.truncate().length() - 1.0).hypot(p.z) - 0.3;
        let box_round = Bounds { min: DVec3::splat(-1.5), max: DVec3::splat(1.5) };
        let mesh = polygonise(ring, box_round, 0.1);
        check::closed_manifold(&mesh).unwrap();
        assert_eq!(check::euler_characteristic(&mesh), 0);
    }

    #[test]
    fn tetrahedra_fill_the_cell() {
        let corner = |c: usize| DVec3::new((c & 1) as f64, (c >> 1 & 1) as f64, (c >> 2) as f64);
        let volumes = TETRAHEDRA.map(|t| {
            let [a, b, c, d] = t.map(corner);
            (b - a).cross(c - a).dot(d - a) / 6.0
        });
        assert!(volumes.iter().all(|v| (v - 1.0 / 6.0).abs() < 1e-15), "{volumes:?}");
    }
}
