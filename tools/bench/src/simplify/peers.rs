//! The door to meshopt: what others reach.

use super::contender::{Contender, Outcome};
use common::cli::AppError;
use common::math::Vec3;
use common::mesh::Mesh;
use meshopt::{SimplifyOptions, VertexDataAdapter, simplify, simplify_with_update, typed_to_bytes};

/// As it is called without options, and with vertices moved, halving again and again as its
/// documentation recommends.
pub const ALL: [Contender; 2] =
    [Contender { name: "meshopt", run: plain }, Contender { name: "meshopt-update", run: updated }];

/// No bound of the error: the number of triangles decides.
const ANY_ERROR: f32 = f32::MAX;

fn positions(mesh: &Mesh) -> Vec<[f32; 3]> {
    mesh.positions.iter().map(|p| p.to_array()).collect()
}

fn target(mesh: &Mesh, ratio: f64) -> usize {
    3 * (mesh.triangles.len() as f64 * ratio) as usize
}

/// The triangles that are left, over all of the vertices.
fn outcome(positions: Vec<[f32; 3]>, indices: &[u32]) -> Outcome {
    let positions = positions.into_iter().map(Vec3::from_array).collect();
    let (triangles, _) = indices.as_chunks::<3>();
    let mesh = Mesh { positions, triangles: triangles.to_vec(), ..Mesh::default() };
    // It does not say why it stopped.
    Outcome { mesh, stuck: true, bound: None }
}

fn plain(mesh: &Mesh, ratio: f64, _: bool) -> Result<Outcome, AppError> {
    let positions = positions(mesh);
    let vertices = VertexDataAdapter::new(typed_to_bytes(&positions), 12, 0)?;
    let indices = mesh.triangles.as_flattened();
    let options = SimplifyOptions::None;
    let left = simplify(indices, &vertices, target(mesh, ratio), ANY_ERROR, options, None);
    Ok(outcome(positions, &left))
}

fn updated(mesh: &Mesh, ratio: f64, _: bool) -> Result<Outcome, AppError> {
    let mut positions = positions(mesh);
    let mut indices = mesh.triangles.as_flattened().to_vec();
    let target = target(mesh, ratio);
    while indices.len() > target {
        let half = target.max(indices.len() / 6 * 3);
        let options = SimplifyOptions::None;
        let left = simplify_with_update(
            &mut indices,
            &mut positions,
            &mut [],
            &[],
            0,
            None,
            half,
            ANY_ERROR,
            options,
            None,
        );
        if left >= indices.len() {
            break;
        }
        indices.truncate(left);
    }
    Ok(outcome(positions, &indices))
}
