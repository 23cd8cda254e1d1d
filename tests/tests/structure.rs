//! What the parser makes of a scene: the flat tree with the places its parts were written at.

use common::scene::{self, Node, NodeKind, Scene};
use std::fmt::Write;
use tests::workspace_file;

/// How many groups and transforms a node is inside of.
fn depth(scene: &Scene, node: &Node) -> usize {
    let parent = |node: &Node| node.parent.map(|i| &scene.nodes[i as usize]);
    std::iter::successors(parent(node), |node| parent(node)).count()
}

/// One line of text per node, indented by its depth.
fn outline(scene: &Scene) -> String {
    let mut text = String::new();
    for node in &scene.nodes {
        let (at, indent) = (node.position, 2 * depth(scene, node));
        let _ = write!(text, "{:>3}:{:<3}{:indent$}", at.line, at.column, "");
        let _ = match &node.kind {
            NodeKind::Group => writeln!(text, "Group"),
            NodeKind::Transform(list) => writeln!(text, "Transform {list:?}"),
            NodeKind::Shape { shape, material } => writeln!(text, "material {material}: {shape:?}"),
        };
    }
    text
}

/// Everything the file says, one thing a line.
fn structure(scene: &Scene) -> String {
    let mut text = format!("{:?}\n{:?}\n", scene.camera, scene.background);
    for light in &scene.lights {
        let _ = writeln!(text, "{light:?}");
    }
    for material in &scene.materials {
        let _ = writeln!(text, "{material:?}");
    }
    for mesh in &scene.meshes {
        let (vertices, triangles) = (mesh.positions.len(), mesh.triangles.len());
        let _ = writeln!(text, "mesh of {vertices} vertices, {triangles} triangles");
    }
    text + &outline(scene)
}

#[test]
fn nested_transforms() {
    let path = workspace_file("scenes/scene5_12_nested_transformations.txt");
    let scene = scene::load(&path).unwrap_or_else(|error| panic!("{error}"));
    insta::with_settings!({ snapshot_path => "../snapshots", omit_expression => true }, {
        insta::assert_snapshot!("nested_transforms", structure(&scene));
    });
}
