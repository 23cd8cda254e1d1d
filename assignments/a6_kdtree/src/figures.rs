//! What `-stats` says of a structure, line by line.

use crate::bvh::Bvh;
use crate::instances::Instances;
use crate::kdtree::{KdTree, MET, Options, STEP};
use crate::tracer::finite;
use a5_grid::Grid;
use common::accel::Accel;
use common::counters::Counters;
use common::geometry::Geometry;
use common::shape::triangle_block::LANES;

/// A line of the report, its value in the column of the others.
fn line(name: &str, value: impl std::fmt::Display) -> String {
    format!("{name:<36} {value}")
}

/// `None` if there is nothing to divide by.
fn share(part: usize, whole: usize) -> Option<f64> {
    (whole > 0).then(|| part as f64 / whole as f64)
}

/// Bytes, and how many for each finite primitive.
fn size(bytes: usize, geometry: &Geometry) -> String {
    let each = share(bytes, finite(geometry)).map(|n| format!(", {n:.1} bytes per primitive"));
    line("size", format!("{} KiB{}", bytes.div_ceil(1024), each.unwrap_or_default()))
}

fn references(held: usize, geometry: &Geometry) -> String {
    let each = share(held, finite(geometry)).map(|n| format!(", {n:.2} per primitive"));
    line("references", format!("{held}{}", each.unwrap_or_default()))
}

/// How kd-trees with these options are called.
pub fn tree_name(options: &Options) -> String {
    format!("kd-tree ({})", format!("{:?}", options.rule).to_lowercase())
}

/// The line of a structure that nothing has asked for.
pub fn not_built(name: &str) -> Vec<String> {
    vec![line("structure", format!("{name}, not built: no ray asked"))]
}

/// The list of all primitives, for which nothing was built.
pub fn of_list(geometry: &Geometry) -> Vec<String> {
    let (finite, sheets) = (finite(geometry), geometry.sheets().len());
    vec![line("structure", format!("list, no tree; finite primitives {finite}, planes and discs {sheets}"))]
}

/// The grid of assignment 5.
pub fn of_grid(grid: &Grid) -> Vec<String> {
    let geometry = grid.geometry();
    let cells = grid.cells().len();
    vec![
        line("structure", format!("grid, {cells} cells")),
        references(grid.references(), geometry),
        size(grid.bytes(), geometry),
    ]
}

/// A kd-tree.
pub fn of_tree(tree: &KdTree) -> Vec<String> {
    let (s, geometry) = (tree.summary(), tree.geometry());
    let planes = s.nodes - s.leaves;
    vec![
        line("structure", tree_name(&tree.options())),
        line(
            "nodes",
            format!("{}: {planes} planes, {} leaves, {} of them empty", s.nodes, s.leaves, s.empty),
        ),
        line("planes from root to leaf, at most", s.depth),
        references(s.references, geometry),
        line(
            "expected cost of a ray (SAH)",
            format!(
                "{:.2} blocks of {LANES}; a plane costs {STEP}, a solid 1, a block of many {MET}",
                s.cost
            ),
        ),
        size(tree.bytes(), geometry),
    ]
}

/// The hierarchy.
pub fn of_bvh(bvh: &Bvh) -> Vec<String> {
    let ((nodes, blocks, depth), geometry) = (bvh.counts(), bvh.geometry());
    let full = share(geometry.triangles().len(), blocks * LANES);
    let full = full.map(|n| format!(", {:.0} % full", n * 100.0)).unwrap_or_default();
    vec![
        line("structure", "hierarchy, eight boxes to a node"),
        line("nodes", nodes),
        line("blocks of triangles", format!("{blocks}{full}")),
        line("nodes from root to leaf, at most", depth),
        line("expected cost of a ray (SAH)", format!("{:.2}; a node, a block, a solid cost 1", bvh.cost())),
        size(bvh.bytes(), geometry),
    ]
}

/// The hierarchy in two levels.
pub fn of_instances(levels: &Instances) -> Vec<String> {
    let s = levels.summary();
    vec![
        line("structure", "hierarchy in two levels, eight boxes to a node"),
        line("trees built", format!("{} of {}", s.built, s.trees)),
        line("uses of large meshes", s.uses),
        line("uses that share a tree", format!("{}, {} trees", s.sharing, s.shared)),
        line("uses that no ray reached", s.unreached),
        size(s.bytes, levels.geometry()),
    ]
}

/// What the rays, shadow rays included, cost on average; nothing if there were none.
pub fn per_ray(counters: &Counters) -> Option<String> {
    let rays = counters.rays + counters.shadow_rays;
    let each = |count: u64| count as f64 / rays as f64;
    (rays > 0).then(|| {
        let (steps, tests) = (each(counters.cells), each(counters.intersections));
        let exact = each(counters.exact_tests);
        line("of a ray", format!("{steps:.2} steps, {tests:.2} tests, {exact:.2} in double precision"))
    })
}
