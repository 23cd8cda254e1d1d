//! Meshes whose measures are known.
#![allow(dead_code, reason = "each test uses some")]

use common::math::Vec3;
use common::mesh::Mesh;

/// A mesh of positions and triangles.
pub fn mesh(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Mesh {
    Mesh { positions, triangles, ..Mesh::default() }
}

/// A rectangle of `columns` × `rows` squares, each cut in two, seen from above (+z): the point of
/// column i and row j is `place(i, j)`.
pub fn sheet(columns: u32, rows: u32, place: impl Fn(f32, f32) -> Vec3) -> Mesh {
    let points = (0..=rows).flat_map(|j| (0..=columns).map(move |i| (i as f32, j as f32)));
    let positions = points.map(|(i, j)| place(i, j)).collect();
    let mut triangles = Vec::new();
    for j in 0..rows {
        for i in 0..columns {
            let a = j * (columns + 1) + i;
            let [b, c, d] = [a + 1, a + columns + 2, a + columns + 1];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    mesh(positions, triangles)
}

/// The unit square at height `z`, of n × n squares, its corner at (x, 0).
pub fn square(n: u32, x: f32, z: f32) -> Mesh {
    sheet(n, n, |i, j| Vec3::new(x + i / n as f32, j / n as f32, z))
}

/// A closed ring: the sheet of n × m squares with opposite sides joined, laid on a torus.
pub fn torus(n: u32, m: u32) -> Mesh {
    let number = |i: u32, j: u32| (j % m) * n + i % n;
    let turn = |k: u32, of: u32| std::f32::consts::TAU * k as f32 / of as f32;
    let place = |i: u32, j: u32| {
        let (around, across) = (turn(i, n), turn(j, m));
        let r = 2.0 + across.cos();
        Vec3::new(r * around.cos(), r * around.sin(), across.sin())
    };
    let positions = (0..m).flat_map(|j| (0..n).map(move |i| (i, j))).map(|(i, j)| place(i, j)).collect();
    let square = |(i, j): (u32, u32)| {
        let [a, b, c, d] = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    mesh(positions, (0..m).flat_map(|j| (0..n).map(move |i| (i, j))).flat_map(square).collect())
}

/// A ball of radius `r` about the origin: an octahedron whose sides are cut into n² and blown up.
pub fn ball(n: u32, r: f32) -> Mesh {
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for octant in 0..8 {
        let sign = |bit: u32| if octant >> bit & 1 == 0 { 1.0 } else { -1.0 };
        let [x, y, z] = [Vec3::X * sign(0), Vec3::Y * sign(1), Vec3::Z * sign(2)];
        let outwards = sign(0) * sign(1) * sign(2) > 0.0;
        let first = positions.len() as u32;
        let row_start = |i: u32| first + i * (n + 1) - i * i.saturating_sub(1) / 2;
        for i in 0..=n {
            for j in 0..=n - i {
                let p = x * (n - i - j) as f32 + y * j as f32 + z * i as f32;
                positions.push(p.normalize() * r);
            }
        }
        for i in 0..n {
            for j in 0..n - i {
                let (lower, upper) = (row_start(i) + j, row_start(i + 1) + j);
                let turned = |t: [u32; 3]| if outwards { t } else { [t[0], t[2], t[1]] };
                triangles.push(turned([lower, lower + 1, upper]));
                if j + 1 < n - i {
                    triangles.push(turned([lower + 1, upper + 1, upper]));
                }
            }
        }
    }
    // Octants name the places on their borders each for itself; to measures that is one place.
    mesh(positions, triangles)
}

/// The cube [0, 1]³ with 12 triangles that look outwards.
pub fn cube() -> Mesh {
    let corner = |i: u32| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2 & 1) as f32);
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = quads.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    mesh((0..8).map(corner).collect(), triangles)
}

/// Both, without anything shared.
pub fn beside(mut one: Mesh, other: &Mesh) -> Mesh {
    let shift = one.positions.len() as u32;
    one.positions.extend(&other.positions);
    one.triangles.extend(other.triangles.iter().map(|t| t.map(|v| v + shift)));
    one
}

/// The mesh with every position changed.
pub fn moved(mut mesh: Mesh, place: impl Fn(Vec3) -> Vec3) -> Mesh {
    mesh.positions.iter_mut().for_each(|p| *p = place(*p));
    mesh
}
