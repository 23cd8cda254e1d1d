//! How much work a command line is, so that tests can stay quick.

use crate::CommandLine;
use common::scene::{self, NodeKind, Scene, ShapeSpec};

/// Primitives of a scene: a mesh counts triangle by triangle, and again wherever it is placed.
pub fn primitives(scene: &Scene) -> usize {
    let of_shape = |shape: &ShapeSpec| match shape {
        ShapeSpec::Mesh { mesh, .. } => scene.meshes[*mesh as usize].triangles.len(),
        _ => 1,
    };
    let of_node = |kind: &NodeKind| match kind {
        NodeKind::Shape { shape, .. } => of_shape(shape),
        NodeKind::Group | NodeKind::Transform(_) => 0,
    };
    scene.nodes.iter().map(|node| of_node(&node.kind)).sum()
}

/// Whether brute force draws the line in a fraction of a second: few primitives, and a picture
/// of few cells.
pub fn is_small(line: &CommandLine) -> bool {
    const FEW_PRIMITIVES: usize = 64;
    const FEW_CELLS: u32 = 1000;
    let scene = scene::load(&line.scene_file()).unwrap_or_else(|error| panic!("{line}\n{error}"));
    let cells: u32 = line.numbers::<u32, 3>("-grid").map_or(0, |n| n.iter().product());
    primitives(&scene) <= FEW_PRIMITIVES && cells <= FEW_CELLS
}
