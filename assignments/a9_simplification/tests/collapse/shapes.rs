//! Meshes to simplify.

use a9_simplification::{Goal, Method, Settings, Simplified, simplify};
use common::math::Vec3;
use common::mesh::Mesh;
use modeller::generated::Recipe;

pub const METHODS: [Method; 3] = [Method::Qem, Method::Memoryless, Method::Melax];

/// `sphere5000` and the like.
pub fn generated(recipe: &str) -> Mesh {
    let made = recipe.parse::<Recipe>().unwrap().make();
    mesh(made.positions.into_iter().map(Vec3::from_array).collect(), made.triangles)
}

pub fn mesh(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Mesh {
    Mesh { positions, triangles, ..Mesh::default() }
}

/// A grid of n×n squares over [0, 1]²; `place` bends it.
pub fn grid(n: u32, place: impl Fn(f32, f32) -> Vec3) -> Mesh {
    let at = |i: u32| place((i % (n + 1)) as f32 / n as f32, (i / (n + 1)) as f32 / n as f32);
    let square = |i: u32| {
        let corner = i / n * (n + 1) + i % n;
        [[corner, corner + 1, corner + n + 2], [corner, corner + n + 2, corner + n + 1]]
    };
    mesh((0..(n + 1) * (n + 1)).map(at).collect(), (0..n * n).flat_map(square).collect())
}

/// A cube of side 1 whose faces are grids; the vertices of its edges are there once for each face.
pub fn cube(n: u32) -> Mesh {
    let mut cube = Mesh::default();
    for axis in 0..3 {
        for far in [false, true] {
            let side = grid(n, |u, v| {
                let (u, v) = if far { (u, v) } else { (v, u) };
                let mut p = [0.0; 3];
                p[axis] = if far { 0.5 } else { -0.5 };
                p[(axis + 1) % 3] = u - 0.5;
                p[(axis + 2) % 3] = v - 0.5;
                Vec3::from_array(p)
            });
            let first = cube.positions.len() as u32;
            cube.positions.extend(side.positions);
            cube.triangles.extend(side.triangles.iter().map(|t| t.map(|i| i + first)));
        }
    }
    cube
}

pub fn one(mesh: &Mesh, goal: Goal, method: Method) -> Simplified {
    simplify(mesh, &[goal], &Settings { method, bound: true }).unwrap().remove(0)
}

/// Normal of a triangle, as long as twice its area.
pub fn normal(mesh: &Mesh, triangle: [u32; 3]) -> Vec3 {
    let [a, b, c] = triangle.map(|i| mesh.positions[i as usize]);
    (b - a).cross(c - a)
}
