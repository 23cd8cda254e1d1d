//! What `-stats` says of structures.

use crate::world::{lumpy_ball, scene};
use crate::{file, number, out_of_sight, printed};
use a6_kdtree::kdtree::{KdTree, MET, Options, Rule, STEP};
use common::accel::Accel;
use common::math::{Bounds, DVec3};
use std::fs;

#[test]
fn a6t5_the_tree_is_described_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let name = "scene5_08_bunny_mesh_5k.txt";
    let geometry = scene(name);
    for (rule, word) in Rule::ALL.into_iter().zip(["textbook", "median", "objects", "sah"]) {
        let all = format!("-input {} -size 30 30 -stats -kdtree {word}", file(name).display());
        let stats = printed(folder.path(), &all);
        let tree = KdTree::new(&geometry, Options { rule, ..Options::default() });
        let (s, n) = (tree.summary(), geometry.len() as f64);
        assert!(stats.contains(&format!("kd-tree ({word})")), "{stats}");
        assert!(stats.contains(&format!("planes, {} leaves, {} of them empty", s.leaves, s.empty)));
        assert_eq!(number(&stats, "  nodes  "), s.nodes as f64);
        assert_eq!(number(&stats, "from root to leaf, at most"), f64::from(s.depth));
        assert_eq!(number(&stats, "  references  "), s.references as f64);
        let near = |shown: f64, true_value: f64, digits: f64| (shown - true_value).abs() <= 0.51 * digits;
        assert!(near(number(&stats, "cost of a ray (SAH)"), s.cost, 0.01));
        assert!(near(number(&stats, " KiB"), tree.bytes() as f64 / n, 0.1), "{stats}");
        let rays = number(&stats, "non-shadow rays") + number(&stats, "num shadow rays");
        assert!(near(number(&stats, "of a ray  "), number(&stats, "total cells traversed") / rays, 0.01));
        assert!(number(&stats, "time: build") > 0.0);
    }
}

/// Beyond two blocks there are boxes around them, but in the textbook's tree.
fn leaf_price(triangles: usize, rule: Rule) -> f64 {
    match triangles.div_ceil(8) {
        many @ 3.. if rule != Rule::Textbook => 1.0 + f64::from(MET) * (many - 1) as f64,
        blocks => blocks as f64,
    }
}

/// Σ over planes and leaves of surface / surface of the root × price, from the nodes themselves.
#[test]
fn a6t5_expected_cost_is_that_of_the_formula() {
    let area = |b: &Bounds| {
        let s: DVec3 = b.max.as_dvec3() - b.min.as_dvec3();
        s.x * s.y + s.y * s.z + s.z * s.x
    };
    let geometry = lumpy_ball(14);
    for rule in Rule::ALL {
        let tree = KdTree::new(&geometry, Options { rule, ..Options::default() });
        let (mut cost, mut empty) = (0.0, 0);
        let mut waiting = vec![(0, tree.root_box())];
        while let Some((place, bounds)) = waiting.pop() {
            let node = tree.nodes()[place];
            let price = if node.is_leaf() { leaf_price(tree.held_by(node), rule) } else { f64::from(STEP) };
            cost += price * area(&bounds) / area(&tree.root_box());
            if node.is_leaf() {
                empty += usize::from(tree.held_by(node) == 0);
                continue;
            }
            let (mut low, mut high) = (bounds, bounds);
            low.max[node.axis()] = node.at();
            high.min[node.axis()] = node.at();
            waiting.extend([(node.child(), low), (node.child() + 1, high)]);
        }
        assert!((cost / tree.summary().cost - 1.0).abs() < 1e-9, "{cost} {:?}", tree.summary());
        assert_eq!(empty, tree.summary().empty);
        tree.validate().unwrap();
    }
}

#[test]
fn a6t5_what_is_not_needed_is_not_built() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("scene.txt"), out_of_sight()).unwrap();
    for (flags, name) in
        [("-kdtree objects", "kd-tree (objects)"), ("-accel bvh", "hierarchy"), ("", "hierarchy")]
    {
        let all = format!("-input @/scene.txt -size 40 40 -shadows -stats {flags}");
        let stats = printed(folder.path(), &all);
        assert!(stats.contains(&format!("{name}, not built: no ray asked")), "{stats}");
        assert_eq!(number(&stats, "camera rays of empty tiles"), 1600.0);
        let stats = printed(folder.path(), &format!("{all} -noskip tile"));
        assert!(!stats.contains("not built"), "{stats}");
        // The tree of one pixel's rays asks, too.
        let stats = printed(folder.path(), &format!("{all} -trace 3 4"));
        assert!(!stats.contains("not built") && number(&stats, "time: build") > 0.0, "{stats}");
    }
}

#[test]
fn a6t5_a_handful_needs_no_tree() {
    let folder = tempfile::tempdir().unwrap();
    let stats = |flags: &str| {
        let scene = file("scene5_04_plane_test.txt");
        printed(folder.path(), &format!("-input {} -size 20 20 -stats {flags}", scene.display()))
    };
    let geometry = scene("scene5_04_plane_test.txt");
    let (finite, planes) = (geometry.triangles().len() + geometry.solids().len(), geometry.sheets().len());
    let line = format!("list, no tree; finite primitives {finite}, planes and discs {planes}");
    assert!(finite < 16 && planes > 0 && stats("").contains(&line), "{}", stats(""));
    let grid = stats("-grid 3 4 5");
    assert!(grid.contains("grid, 60 cells") && grid.contains("60 (3x4x5)"), "{grid}");
    assert!(stats("-accel bvh").contains("eight boxes to a node"));
}

/// Six copies of a mesh in a row, and one of another behind them all.
#[test]
fn a6t2_copies_are_described_and_change_no_picture() {
    let folder = tempfile::tempdir().unwrap();
    let meshes = file("meshes");
    let mesh = |name: &str, x: usize, z: i32| {
        let path = meshes.join(name);
        format!(
            "Transform {{ Translate {x} 0 {z} UniformScale 2 TriangleMesh {{ obj_file {} }} }} ",
            path.display()
        )
    };
    let copies: String = (0..3).map(|x| mesh("bunny_40k.obj", x, 0)).collect();
    let hidden = mesh("bunny_5k.obj", 90, -50);
    let scene = format!(
        "OrthographicCamera {{ center 1 0.2 5 direction 0 0 -1 up 0 1 0 size 3 }}
         Materials {{ numMaterials 1 PhongMaterial {{ diffuseColor 1 1 1 }} }}
         Group {{ numObjects 4 MaterialIndex 0 {copies} {hidden} }}"
    );
    fs::write(folder.path().join("scene.txt"), scene).unwrap();
    let render = |flags: &str, name: &str| {
        let all = format!("-input @/scene.txt -size 60 60 -output @/{name} -stats {flags}");
        (printed(folder.path(), &all), fs::read(folder.path().join(name)).unwrap())
    };
    let (stats, picture) = render("-accel instances", "two.tga");
    assert!(stats.contains("hierarchy in two levels"), "{stats}");
    assert!(stats.contains("1 of 2") && stats.contains("3, 1 trees"), "{stats}");
    assert_eq!(number(&stats, "uses of large meshes"), 4.0);
    assert_eq!(number(&stats, "uses that no ray reached"), 1.0);
    assert!(number(&stats, "time: build") > 0.0);
    assert!(picture == render("-kdtree sah", "kd.tga").1, "the same picture");
    assert!(picture == render("-accel bvh", "bvh.tga").1);
    // Two repeated copies are not worth it.
    assert!(render("-accel auto", "auto.tga").0.contains("eight boxes to a node"));
}
