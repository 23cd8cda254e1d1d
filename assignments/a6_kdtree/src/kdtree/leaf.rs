//! What leaves hold: blocks of eight triangles, boxes around the blocks, and solids.
//!
//! A leaf of many triangles is cheaper than the many nodes that would tell them apart, if a ray
//! need not ask all of them. So its triangles are sorted into blocks of neighbours, and the box
//! around what of each block lies in the leaf goes into a node of the hierarchy of eight boxes
//! (see [`crate::bvh`]): one vector test says which blocks a ray may meet.

use super::sah::{UNBOXED, leaf_cost};
use super::tree::{KdTree, LEAF, Node};
use crate::bvh::wide::{self, Child, EMPTY_NODE, WIDTH, WideNode};
use common::math::{Bounds, Vec3};
use common::shape::triangle_block::{LANES, TriangleBlock};
use common::simd::prefetch;
use std::ops::Range;

/// In `data` of a leaf: it holds solids, and its place is that of a [`Mixed`].
const MIXED: u32 = 1 << 31;
/// Its place is that of its first boxes; the rest of `data` is how many nodes of boxes it has.
const BOXED: u32 = 1 << 30;

/// What a leaf with solids holds. Else `data` has one of the bits above or is the number of
/// blocks, the place being that of the first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mixed {
    boxes: Range<u32>,
    blocks: Range<u32>,
    solids: Range<u32>,
}

/// What a leaf holds.
#[derive(Clone, Copy)]
pub struct Held<'t> {
    /// Boxes around blocks.
    pub boxes: &'t [WideNode],
    /// Blocks without boxes.
    pub blocks: &'t [TriangleBlock],
    /// Positions among the geometry's solids, ascending.
    pub solids: &'t [u32],
}

/// A triangle in a leaf: its position in the geometry, and the box of what lies in the leaf.
type Part = (u32, Bounds);

impl KdTree<'_> {
    /// Adds the leaf with the box `inside`, which a ray meets with the chance `share`.
    pub(super) fn leaf(&mut self, primitives: &[u32], inside: &Bounds, share: f64) -> Node {
        let triangles = primitives.partition_point(|p| (*p as usize) < self.geometry.triangles().len());
        let (triangles, solids) = primitives.split_at(triangles);
        self.summary.leaves += 1;
        self.summary.empty += usize::from(primitives.is_empty());
        self.summary.references += primitives.len();
        let is_boxed = triangles.len() > UNBOXED * LANES && self.options.rule.clips();
        self.summary.cost += share * leaf_cost(triangles.len(), solids.len(), is_boxed);
        let (boxes, blocks) = (self.boxes.len() as u32, self.blocks.len() as u32);
        if is_boxed {
            self.boxed(triangles, inside);
        } else {
            triangles.chunks(LANES).for_each(|run| self.block(run.iter().copied()));
        }
        let boxes = boxes..self.boxes.len() as u32;
        let blocks = if boxes.is_empty() { blocks..self.blocks.len() as u32 } else { 0..0 };
        if !solids.is_empty() {
            let first = self.solids.len() as u32;
            self.solids.extend(solids.iter().map(|p| p - self.geometry.triangles().len() as u32));
            self.mixed.push(Mixed { boxes, blocks, solids: first..self.solids.len() as u32 });
            return Node { data: MIXED, word: (self.mixed.len() as u32 - 1) << 2 | LEAF };
        }
        match boxes.is_empty() {
            true => Node { data: blocks.len() as u32, word: blocks.start << 2 | LEAF },
            false => Node { data: BOXED | boxes.len() as u32, word: boxes.start << 2 | LEAF },
        }
    }

    fn block(&mut self, triangles: impl Iterator<Item = u32>) {
        let geometry = self.geometry;
        let numbered = |i: u32| (geometry.triangle_numbers()[i as usize], geometry.triangles()[i as usize]);
        self.blocks.push(TriangleBlock::pack(triangles.map(numbered)));
    }

    /// Adds several blocks with boxes around them.
    fn boxed(&mut self, triangles: &[u32], inside: &Bounds) {
        let part = |&i: &u32| {
            let own = Bounds::of_points(self.geometry.triangles()[i as usize]);
            // A part that was cut with slack may end where the leaf begins, or just before.
            let within = |v: Vec3| v.clamp(inside.min, inside.max);
            (i, Bounds { min: within(own.min), max: within(own.max) })
        };
        let mut parts: Vec<Part> = triangles.iter().map(part).collect();
        sort_into_blocks(&mut parts);
        for parts in parts.chunks_mut(WIDTH * LANES) {
            let node = self.boxes_around(parts);
            self.boxes.push(node);
        }
        assert!(self.blocks.len() < 1 << 26, "at most 2^26 blocks");
    }

    /// Adds up to eight blocks; returns the boxes around them.
    fn boxes_around(&mut self, parts: &mut [Part]) -> WideNode {
        let mut runs: Vec<(Bounds, &mut [Part])> =
            parts.chunks_mut(LANES).map(|run| (around(run), run)).collect();
        let axis = Bounds::of_points(runs.iter().map(|(bounds, _)| center(bounds))).longest_axis();
        runs.sort_by(|a, b| center(&a.0)[axis].total_cmp(&center(&b.0)[axis]));
        let mut node = WideNode { axis: axis as u32, ..EMPTY_NODE };
        for (lane, (bounds, run)) in runs.into_iter().enumerate() {
            node.set_box(lane, &bounds);
            node.child[lane] = Child::block(self.blocks.len(), run.len());
            run.sort_unstable_by_key(|part| part.0);
            self.block(run.iter().map(|part| part.0));
        }
        node
    }

    /// What a leaf holds.
    #[inline(always)]
    pub(super) fn held(&self, leaf: Node) -> Held<'_> {
        let (place, count) = (leaf.child(), (leaf.data & !BOXED) as usize);
        if leaf.data & MIXED != 0 {
            let Mixed { boxes, blocks, solids } = &self.mixed[place];
            let range = |r: &Range<u32>| r.start as usize..r.end as usize;
            let (boxes, blocks) = (&self.boxes[range(boxes)], &self.blocks[range(blocks)]);
            return Held { boxes, blocks, solids: &self.solids[range(solids)] };
        }
        match leaf.data & BOXED {
            0 => Held { boxes: &[], blocks: &self.blocks[place..place + count], solids: &[] },
            _ => Held { boxes: &self.boxes[place..place + count], blocks: &[], solids: &[] },
        }
    }

    /// Asks the memory for what is looked at next, without waiting.
    #[inline(always)]
    pub(super) fn prefetch(&self, node: Node) {
        if !node.is_leaf() {
            return prefetch(&self.nodes[node.child()..]);
        }
        let Held { boxes, blocks, .. } = self.held(node);
        if let Some(first) = boxes.first() {
            first.prefetch();
        } else if let Some(first) = blocks.first() {
            first.prefetch();
        }
    }

    /// All blocks of a leaf, whether there are boxes around them or not, and its solids.
    pub(super) fn content(&self, leaf: Node) -> (&[TriangleBlock], &[u32]) {
        let Held { boxes, blocks, solids } = self.held(leaf);
        let mut places = boxes.iter().flat_map(|node| node.child).filter_map(|child| match child.held() {
            wide::Held::Block(place, _) => Some(place),
            _ => None,
        });
        match places.next() {
            Some(first) => (&self.blocks[first..first + 1 + places.count()], solids),
            None => (blocks, solids),
        }
    }
}

/// Sorts so that every eight in a row are neighbours: in halves along the longest side, again
/// and again, each but the last of whole blocks.
fn sort_into_blocks(parts: &mut [Part]) {
    if parts.len() <= LANES {
        return;
    }
    let axis = Bounds::of_points(parts.iter().map(|(_, bounds)| center(bounds))).longest_axis();
    let middle = parts.len().div_ceil(LANES).div_ceil(2) * LANES;
    let key = |a: &Part, b: &Part| center(&a.1)[axis].total_cmp(&center(&b.1)[axis]).then(a.0.cmp(&b.0));
    parts.select_nth_unstable_by(middle, key);
    let (left, right) = parts.split_at_mut(middle);
    sort_into_blocks(left);
    sort_into_blocks(right);
}

/// Half the sum of both corners, without overflow.
fn center(bounds: &Bounds) -> Vec3 {
    bounds.min / 2.0 + bounds.max / 2.0
}

fn around(parts: &[Part]) -> Bounds {
    parts.iter().fold(Bounds::EMPTY, |all, (_, bounds)| all.union(bounds))
}
