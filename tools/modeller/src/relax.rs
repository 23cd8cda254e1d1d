//! Spreads a mesh's vertices evenly over an implicit surface.

use crate::implicit::Solid;
use crate::mesh::Mesh;
use glam::DVec3;

/// Moves each vertex `rounds` times towards the middle of its neighbours, along the surface only,
/// and back onto the surface of `solid`. Triangles become alike in size and shape; their number and
/// connections stay.
pub fn relax(mesh: &mut Mesh, solid: &Solid, rounds: usize) {
    for _ in 0..rounds {
        let middles = neighbour_middles(mesh);
        for (p, middle) in mesh.positions.iter_mut().zip(middles) {
            let normal = normal_at(solid, *p);
            let pull = middle - *p;
            *p = onto_surface(solid, *p + 0.6 * (pull - normal * normal.dot(pull)));
        }
    }
}

/// The mean of each vertex's neighbours. In a closed mesh each neighbour follows the vertex in
/// exactly one triangle.
fn neighbour_middles(mesh: &Mesh) -> Vec<DVec3> {
    let mut sums = vec![(DVec3::ZERO, 0.0); mesh.positions.len()];
    for t in &mesh.triangles {
        for k in 0..3 {
            let (sum, count) = &mut sums[t[k] as usize];
            *sum += mesh.positions[t[(k + 1) % 3] as usize];
            *count += 1.0;
        }
    }
    sums.into_iter().map(|(sum, count)| sum / count).collect()
}

/// Step for the gradient's differences, small beside every detail of the models (their unit is a
/// tenth of the scene's).
const DIFFERENCE: f64 = 1e-4;

fn normal_at(solid: &Solid, p: DVec3) -> DVec3 {
    solid.gradient(p, DIFFERENCE).normalize_or_zero()
}

/// One Newton step along the gradient: enough, since the function is almost a distance and `p` is
/// close.
fn onto_surface(solid: &Solid, p: DVec3) -> DVec3 {
    let gradient = solid.gradient(p, DIFFERENCE);
    // Where parts meet under a blend the gradient may be short; a step from there must not shoot
    // far.
    p - gradient * (solid.distance(p) / gradient.length_squared().max(0.25))
}
