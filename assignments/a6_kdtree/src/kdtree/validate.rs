//! The invariants of the tree, checked one by one, with overlap tests of their own (separating
//! axes) where the build clipped.

use super::MAX_DEPTH;
use super::clip::halves;
use super::reference::padded;
use super::tree::{KdTree, Node};
use crate::bvh::validate::contains;
use crate::bvh::wide::Held;
use a5_grid::overlap::{TriangleOverlap, sphere_meets_box};
use common::geometry::SolidShape;
use common::math::{Bounds, Vec3};
use common::shape::triangle_block::TriangleBlock;

/// How far a primitive must reach into a leaf, in parts of its largest coordinate, for the leaf
/// to have to hold it: what only touches may be left to the neighbour.
const SURELY: f64 = 1.0 / (1u64 << 30) as f64;

impl KdTree<'_> {
    /// Every node is reached once, planes lie within their boxes, leaves hold what is theirs,
    /// unchanged and in order, and every primitive is in every leaf that it reaches into.
    pub(super) fn check(&self) -> Result<(), String> {
        if self.nodes.is_empty() {
            let finite = self.geometry.triangles().len() + self.geometry.solids().len();
            return if finite == 0 { Ok(()) } else { Err("there are primitives but no tree".to_owned()) };
        }
        self.check_shape()?;
        for (i, vertices) in self.geometry.triangles().iter().enumerate() {
            let own = Bounds::of_points(*vertices);
            let slack = f64::from(own.reach_from(Vec3::ZERO)) * SURELY;
            let overlap = TriangleOverlap::new(vertices.map(|v| v.as_dvec3()), -slack);
            let must = |b: &Bounds| {
                surely_overlaps(&own, b, slack) && overlap.meets_box(b.min.as_dvec3(), b.max.as_dvec3())
            };
            let number = self.geometry.triangle_numbers()[i];
            self.check_held(&own, must, |leaf| holds_triangle(self.content(leaf).0, number))
                .map_err(|what| format!("triangle {i} {what}"))?;
        }
        for (i, solid) in self.geometry.solids().iter().enumerate() {
            let own = padded(solid);
            let slack = f64::from(own.reach_from(Vec3::ZERO)) * SURELY;
            let must = |b: &Bounds| match &solid.shape {
                SolidShape::Sphere(s) => {
                    sphere_meets_box(s.center, s.radius, b.min.as_dvec3(), b.max.as_dvec3(), -slack)
                }
                SolidShape::Ellipsoid(_) => surely_overlaps(&own, b, slack),
            };
            self.check_held(&own, must, |leaf| self.content(leaf).1.binary_search(&(i as u32)).is_ok())
                .map_err(|what| format!("solid {i} {what}"))?;
        }
        Ok(())
    }

    /// Walks all nodes once.
    fn check_shape(&self) -> Result<(), String> {
        let (mut reached, mut blocks, mut solids) = (0, 0, 0);
        let (mut leaves, mut references, mut deepest) = (0, 0, 0);
        let mut waiting = vec![(0, self.bounds, 0)];
        while let Some((index, inside, depth)) = waiting.pop() {
            let Some(node) = self.nodes.get(index).copied() else {
                return Err(format!("node {index} does not exist"));
            };
            reached += 1;
            deepest = deepest.max(depth);
            if reached > self.nodes.len() || depth > MAX_DEPTH {
                return Err("the nodes are no tree, or too deep a one".to_owned());
            }
            if !node.is_leaf() {
                let (axis, at) = (node.axis(), node.at());
                let within = inside.min[axis] <= at && at <= inside.max[axis];
                if !within || node.child() <= index {
                    return Err(format!("the plane or the children of node {index} are out of place"));
                }
                let [left, right] = halves(&inside, axis, at);
                waiting.extend([(node.child(), left, depth + 1), (node.child() + 1, right, depth + 1)]);
                continue;
            }
            let held = self.content(node);
            let checked = self.check_leaf(held).and_then(|()| self.check_boxes(node, &inside));
            checked.map_err(|what| format!("leaf {index} {what}"))?;
            (blocks, solids, leaves) = (blocks + held.0.len(), solids + held.1.len(), leaves + 1);
            references += held.0.iter().map(|b| b.len()).sum::<usize>() + held.1.len();
        }
        let s = self.summary();
        if (s.nodes, s.leaves, s.depth, s.references) != (reached, leaves, deepest, references) {
            return Err(format!("the summary {s:?} does not tell what is there"));
        }
        match (reached, blocks, solids) == (self.nodes.len(), self.blocks.len(), self.solids.len()) {
            true => Ok(()),
            false => Err("a node, a block or a solid's entry is reached never or twice".to_owned()),
        }
    }

    /// Its triangles are what they were, none is there twice, and blocks and solids are in order.
    fn check_leaf(&self, (blocks, solids): (&[TriangleBlock], &[u32])) -> Result<(), String> {
        let lanes = || blocks.iter().flat_map(|b| (0..b.len()).map(move |l| (b, l)));
        for (block, lane) in lanes() {
            let found = self.geometry.triangle_numbers().binary_search(&block.index[lane]);
            if found.is_ok_and(|i| self.geometry.triangles()[i] == block.vertices(lane)) {
                continue;
            }
            return Err(format!("holds a changed triangle {}", block.index[lane]));
        }
        let mut numbers: Vec<u32> = lanes().map(|(b, l)| b.index[l]).collect();
        let ascending = |list: &[u32]| list.windows(2).all(|p| p[0] < p[1]);
        let in_order = blocks.iter().all(|b| ascending(&b.index[..b.len()]));
        numbers.sort_unstable();
        let known = solids.last().is_none_or(|i| (*i as usize) < self.geometry.solids().len());
        match in_order && ascending(&numbers) && ascending(solids) && known {
            true => Ok(()),
            false => Err("is not in order".to_owned()),
        }
    }

    /// Boxes around blocks hold what of the triangles lies in the leaf.
    fn check_boxes(&self, leaf: Node, inside: &Bounds) -> Result<(), String> {
        for node in self.held(leaf).boxes {
            for (lane, child) in node.child.iter().enumerate() {
                let Held::Block(place, len) = child.held() else { continue };
                let block = &self.blocks[place];
                let within = |corner: Vec3| corner.clamp(inside.min, inside.max);
                if len != block.len() {
                    return Err(format!("has {} triangles in a block, and asks {len}", block.len()));
                }
                for own in (0..len).map(|i| Bounds::of_points(block.vertices(i))) {
                    let part = Bounds { min: within(own.min), max: within(own.max) };
                    if !contains(&node.box_of(lane), &part) {
                        return Err(format!("has a triangle beside the box of block {place}"));
                    }
                }
            }
        }
        Ok(())
    }

    /// A primitive with the box `own` is held by every leaf that it `must` be in, and by one.
    fn check_held(
        &self,
        own: &Bounds,
        must: impl Fn(&Bounds) -> bool,
        holds: impl Fn(Node) -> bool,
    ) -> Result<(), String> {
        let mut waiting = vec![(0, self.bounds)];
        let mut found = false;
        while let Some((index, inside)) = waiting.pop() {
            let node = self.nodes[index];
            if node.is_leaf() {
                let held = holds(node);
                found |= held;
                if !held && must(&inside) {
                    return Err(format!("reaches into leaf {index}, which does not hold it"));
                }
                continue;
            }
            for (side, half) in halves(&inside, node.axis(), node.at()).into_iter().enumerate() {
                if half.overlaps(own) {
                    waiting.push((node.child() + side, half));
                }
            }
        }
        if found { Ok(()) } else { Err("is in no leaf".to_owned()) }
    }
}

/// Whether two boxes have more than `slack` in common along every axis.
fn surely_overlaps(a: &Bounds, b: &Bounds, slack: f64) -> bool {
    let low = a.min.max(b.min).as_dvec3();
    let high = a.max.min(b.max).as_dvec3();
    let flat = a.min.cmpeq(a.max);
    // A flat box must lie well inside.
    let inside = (a.min - b.min).min(b.max - a.max).as_dvec3();
    (0..3).all(|k| if flat.test(k) { inside[k] > slack } else { high[k] - low[k] > slack })
}

/// Whether blocks hold the triangle of that number.
fn holds_triangle(blocks: &[TriangleBlock], number: u32) -> bool {
    blocks.iter().any(|block| block.index.contains(&number))
}
