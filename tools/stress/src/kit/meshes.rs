//! Closed meshes.

use super::{Draw, repository};
use common::math::{DVec3, Vec3};
use common::mesh::{Mesh, read_obj};
use std::collections::HashMap;

/// An octahedron, every triangle cut into four `level` times, corners at unit distance.
fn octahedron(level: u32) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let mut points = vec![DVec3::X, DVec3::Y, DVec3::Z, -DVec3::X, -DVec3::Y, -DVec3::Z];
    let mut triangles =
        vec![[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]];
    for _ in 0..level {
        let mut middles = HashMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                points.push((points[a as usize] + points[b as usize]).normalize());
                points.len() as u32 - 1
            })
        };
        triangles = triangles
            .iter()
            .flat_map(|&[a, b, c]| {
                let [x, y, z] = [middle(a, b), middle(b, c), middle(c, a)];
                [[a, x, z], [x, b, y], [z, y, c], [x, y, z]]
            })
            .collect();
    }
    (points, triangles)
}

/// A convex sphere of 8·4^level triangles; no two neighbours lie in one plane, so that it stays
/// convex when its corners are rounded.
pub fn convex_sphere(level: u32) -> Mesh {
    let (points, triangles) = octahedron(level);
    Mesh { positions: points.iter().map(|p| p.as_vec3()).collect(), triangles, ..Mesh::default() }
}

/// A sphere of 8·4^level triangles with lumps: no two edges have the same direction.
pub fn lumpy_sphere(level: u32, seed: u64) -> Mesh {
    let (points, triangles) = octahedron(level);
    let mut draw = Draw::new(seed);
    let positions = points.iter().map(|p| (*p * draw.between(0.8, 1.2)).as_vec3()).collect();
    Mesh { positions, triangles, ..Mesh::default() }
}

/// The same with corners on a lattice of 1/64: rays can be aimed at corners exactly.
pub fn lattice_sphere(level: u32, seed: u64) -> Mesh {
    let mut mesh = lumpy_sphere(level, seed);
    for p in &mut mesh.positions {
        *p = (*p * 64.0).round() / 64.0;
    }
    mesh
}

/// A cube whose six sides are fans of `spokes` triangles around a point near their middle:
/// thousands of thin triangles meet in one corner.
pub fn fan(spokes: usize, seed: u64) -> Mesh {
    let mut draw = Draw::new(seed);
    let per_edge = (spokes / 4).max(1);
    let mut positions = Vec::new();
    let mut known: HashMap<[u32; 3], u32> = HashMap::new();
    let mut triangles = Vec::new();
    for (axis, side) in (0..3).flat_map(|a| [(a, -1.0), (a, 1.0)]) {
        let place = |u: f64, v: f64| {
            let mut p = DVec3::ZERO;
            (p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]) = (side, u, v);
            p.as_vec3()
        };
        let mut number = |p: Vec3, positions: &mut Vec<Vec3>| {
            // +0.0 joins −0.0 with 0.0.
            *known.entry((p + 0.0).to_array().map(f32::to_bits)).or_insert_with(|| {
                positions.push(p);
                positions.len() as u32 - 1
            })
        };
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        let rim: Vec<(f64, f64)> = (0..4)
            .flat_map(|k| (0..per_edge).map(move |i| (k, 2.0 * i as f64 / per_edge as f64)))
            .map(|(k, s)| {
                let ((u, v), (u2, v2)) = (corners[k], corners[(k + 1) % 4]);
                (u + (u2 - u) / 2.0 * s, v + (v2 - v) / 2.0 * s)
            })
            .collect();
        let hub = number(place(draw.between(-0.5, 0.5), draw.between(-0.5, 0.5)), &mut positions);
        let ring: Vec<u32> = rim.iter().map(|&(u, v)| number(place(u, v), &mut positions)).collect();
        for i in 0..ring.len() {
            let [a, b] = [ring[i], ring[(i + 1) % ring.len()]];
            triangles.push(if side > 0.0 { [hub, a, b] } else { [hub, b, a] });
        }
    }
    Mesh { positions, triangles, ..Mesh::default() }
}

/// A mesh of `scenes/meshes`.
///
/// # Panics
/// If it cannot be read.
pub fn file_mesh(name: &str) -> Mesh {
    let path = repository().join("scenes/meshes").join(name);
    read_obj(&path).unwrap_or_else(|e| panic!("{e}"))
}

/// Every closed mesh that the watertight properties run on, with its name.
pub fn closed_meshes() -> Vec<(&'static str, Mesh)> {
    let files = ["cube", "diamond", "vase", "bunny_200", "bunny_1k", "bunny_5k", "bunny_40k"];
    let mut meshes: Vec<_> = files.iter().map(|name| (*name, file_mesh(&format!("{name}.obj")))).collect();
    meshes.push(("lumpy sphere", lumpy_sphere(3, 1)));
    meshes.push(("lattice sphere", lattice_sphere(2, 2)));
    meshes.push(("split square fans", fan(64, 3)));
    meshes
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every edge is walked once each way, so the mesh has no border.
    #[test]
    fn meshes_are_closed() {
        for (name, mesh) in closed_meshes() {
            let mut balance: HashMap<(u32, u32), i32> = HashMap::new();
            for [a, b, c] in &mesh.triangles {
                for (p, q) in [(*a, *b), (*b, *c), (*c, *a)] {
                    *balance.entry((p.min(q), p.max(q))).or_default() += if p < q { 1 } else { -1 };
                }
            }
            assert!(balance.values().all(|&n| n == 0), "{name} has a border");
        }
    }
}
