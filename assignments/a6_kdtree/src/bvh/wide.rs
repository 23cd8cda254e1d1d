//! The wide tree: nodes of up to eight children, leaves of triangle blocks or solids.

use super::split::half_area;
use super::{Binary, BinaryNode};
use common::geometry::Geometry;
use common::math::{Bounds, Vec3};
use common::shape::triangle_block::{LANES, TriangleBlock};
use common::simd::prefetch;

/// Children of a node.
pub const WIDTH: usize = 8;

/// Eight boxes side by side, and what they hold.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub struct WideNode {
    /// Sides of the boxes, rounded outward: `side[axis][0 low, 1 high][child]`. Unused places
    /// hold the empty box, which no ray meets.
    pub side: [[[f32; WIDTH]; 2]; 3],
    /// What each box holds.
    pub child: [Child; WIDTH],
    /// The axis along which the children stand in order of their centres.
    pub axis: u32,
}

/// What a box holds: a node, a block, or a run of solids, packed into 32 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Child(u32);

/// The same, unpacked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Held {
    /// Index of a node.
    Node(usize),
    /// Index of a block and how many of its triangles are in use.
    Block(usize, usize),
    /// First solid and their number.
    Solids(usize, usize),
}

/// Bits of a leaf's number of triangles or solids.
const COUNT_BITS: u32 = 4;
const BLOCK: u32 = 1 << 30;
const SOLIDS: u32 = 2 << 30;
const INDEX: u32 = (1 << 30) - 1;

impl Child {
    /// No solids.
    pub const NOTHING: Self = Self(SOLIDS);

    fn node(index: usize) -> Self {
        Self(index as u32 & INDEX)
    }

    fn run(tag: u32, first: usize, count: usize) -> Self {
        Self(tag | (first as u32) << COUNT_BITS & INDEX | (count as u32))
    }

    /// What it holds.
    #[inline(always)]
    pub fn held(self) -> Held {
        let index = self.0 & INDEX;
        let (first, count) = ((index >> COUNT_BITS) as usize, index as usize & ((1 << COUNT_BITS) - 1));
        match self.0 & !INDEX {
            BLOCK => Held::Block(first, count),
            SOLIDS => Held::Solids(first, count),
            _ => Held::Node(index as usize),
        }
    }
}

/// The hierarchy over a scene's finite primitives; planes are tested beside it.
pub struct Bvh<'g> {
    pub(crate) geometry: &'g Geometry,
    pub(crate) nodes: Vec<WideNode>,
    pub(crate) blocks: Vec<TriangleBlock>,
    pub(crate) solids: Vec<u32>,
    /// Around everything in it.
    pub(crate) bounds: Bounds,
    pub(super) depth: usize,
}

/// Nodes of a tree of some 16 MiB.
const LARGE: usize = 16384;

impl<'g> Bvh<'g> {
    /// Builds the hierarchy; the same whatever the number of threads.
    pub fn new(geometry: &'g Geometry) -> Self {
        let triangles = geometry.triangles().iter().map(|t| Bounds::of_points(*t)).collect();
        let solids = geometry.solids().iter().map(|s| roomy(&s.bounds)).collect();
        let numbered = |i: u32| (geometry.triangle_numbers()[i as usize], geometry.triangles()[i as usize]);
        Self::over(geometry, triangles, (solids, 2), numbered)
    }

    /// Builds over boxes of triangles, of which `numbered` knows number and corners, and of
    /// something else, called solids here, at most so many to a leaf unless they coincide.
    pub(crate) fn over(
        geometry: &'g Geometry,
        triangles: Vec<Bounds>,
        (solids, most): (Vec<Bounds>, usize),
        numbered: impl Fn(u32) -> (u32, [Vec3; 3]),
    ) -> Self {
        let bounds = triangles.iter().chain(&solids).fold(Bounds::EMPTY, |b, t| b.union(t));
        let mut bvh =
            Self { geometry, nodes: Vec::new(), blocks: Vec::new(), solids: Vec::new(), bounds, depth: 0 };
        let trees: Vec<(Binary, u32)> = [(triangles, BLOCK, LANES), (solids, SOLIDS, most)]
            .into_iter()
            .filter(|(boxes, ..)| !boxes.is_empty())
            .map(|(boxes, tag, most)| (Binary::build(boxes, most), tag))
            .collect();
        bvh.collapse_all(&trees, &numbered);
        bvh
    }

    /// Whether rays should ask the memory ahead. What fits a processor's caches arrives in time
    /// anyway.
    #[inline(always)]
    pub(super) fn is_large(&self) -> bool {
        self.nodes.len() > LARGE
    }

    /// Asks the memory for what a box holds, without waiting.
    #[inline(always)]
    pub(super) fn prefetch(&self, child: Child) {
        match child.held() {
            Held::Node(index) => {
                let node = &self.nodes[index];
                for sides in &node.side {
                    prefetch(&sides[0]);
                }
                prefetch(&node.child);
            }
            Held::Block(index, _) => self.blocks[index].prefetch(),
            Held::Solids(..) => {}
        }
    }

    /// Bytes that it takes.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.nodes) + size_of_val(&*self.blocks) + size_of_val(&*self.solids)
    }

    /// Nodes, blocks and greatest depth.
    pub fn counts(&self) -> (usize, usize, usize) {
        (self.nodes.len(), self.blocks.len(), self.depth)
    }

    /// The root holds the opened roots of both trees; below it each node is of one tree.
    fn collapse_all(&mut self, trees: &[(Binary, u32)], numbered: &impl Fn(u32) -> (u32, [Vec3; 3])) {
        let mut waiting: Vec<(usize, Vec<Seed>, usize)> = Vec::new();
        let roots: Vec<Seed> = (0..trees.len()).map(|t| (t, 0)).collect();
        if roots.is_empty() {
            return;
        }
        self.nodes.push(EMPTY_NODE);
        waiting.push((0, roots, 1));
        while let Some((place, seeds, depth)) = waiting.pop() {
            self.depth = self.depth.max(depth);
            let mut children = open(trees, seeds);
            let mut node = EMPTY_NODE;
            node.axis = put_in_order(trees, &mut children) as u32;
            for (lane, &(tree, number)) in children.iter().enumerate() {
                let (binary, tag) = &trees[tree];
                let inner = &binary.nodes[number as usize];
                node.set_box(lane, &inner.bounds);
                node.child[lane] = if inner.count > 0 {
                    self.leaf(binary, *tag, inner, numbered)
                } else {
                    self.nodes.push(EMPTY_NODE);
                    let below = self.nodes.len() - 1;
                    waiting.push((below, vec![(tree, inner.first), (tree, inner.second)], depth + 1));
                    Child::node(below)
                };
            }
            self.nodes[place] = node;
        }
    }

    fn leaf(
        &mut self,
        binary: &Binary,
        tag: u32,
        node: &BinaryNode,
        numbered: &impl Fn(u32) -> (u32, [Vec3; 3]),
    ) -> Child {
        let items = &binary.items[node.first as usize..(node.first + node.count) as usize];
        if tag == SOLIDS {
            let first = self.solids.len();
            self.solids.extend(items.iter().map(|i| i.index));
            return Child::run(SOLIDS, first, items.len());
        }
        let mut indices: Vec<u32> = items.iter().map(|i| i.index).collect();
        indices.sort_unstable();
        self.blocks.push(TriangleBlock::pack(indices.into_iter().map(numbered)));
        Child::run(BLOCK, self.blocks.len() - 1, items.len())
    }
}

/// The box of a round body, widened by 2⁻²² of its reach: rays that pass the body by within the
/// rounding of `f64` hit it, and must meet its box.
pub(crate) fn roomy(bounds: &Bounds) -> Bounds {
    let slack = Vec3::splat(bounds.min.abs().max(bounds.max.abs()).max_element() / (1 << 22) as f32);
    Bounds { min: bounds.min - slack, max: bounds.max + slack }
}

/// A node of one of the binary trees: which tree, which node.
type Seed = (usize, u32);

/// Opens the largest inner node among the seeds until there are eight, or only leaves.
fn open(trees: &[(Binary, u32)], mut seeds: Vec<Seed>) -> Vec<Seed> {
    let node = |(tree, number): Seed| -> &BinaryNode { &trees[tree].0.nodes[number as usize] };
    while seeds.len() < WIDTH {
        let inner = (0..seeds.len()).filter(|&i| node(seeds[i]).count == 0);
        let area = |i: usize| half_area(&node(seeds[i]).bounds);
        let Some(largest) = inner.reduce(|a, b| if area(b) > area(a) { b } else { a }) else { break };
        let (tree, opened) = (seeds[largest].0, node(seeds[largest]));
        seeds[largest] = (tree, opened.first);
        seeds.push((tree, opened.second));
    }
    seeds
}

/// Sorts nodes along the axis in which their centres differ most, and names it.
fn put_in_order(trees: &[(Binary, u32)], seeds: &mut [Seed]) -> usize {
    let center = |&(tree, number): &Seed| {
        let bounds: &Bounds = &trees[tree].0.nodes[number as usize].bounds;
        bounds.min + bounds.max
    };
    let spread = Bounds::of_points(seeds.iter().map(center)).size();
    let axis = (0..3).fold(0, |best, axis| if spread[axis] > spread[best] { axis } else { best });
    seeds.sort_by(|a, b| center(a)[axis].total_cmp(&center(b)[axis]));
    axis
}

const EMPTY_NODE: WideNode = WideNode {
    side: [[[f32::INFINITY; WIDTH], [f32::NEG_INFINITY; WIDTH]]; 3],
    child: [Child::NOTHING; WIDTH],
    axis: 0,
};

impl WideNode {
    /// Puts a box into a lane, widened by the smallest step, so that a ray that runs in one of
    /// its sides is inside.
    fn set_box(&mut self, lane: usize, bounds: &Bounds) {
        for axis in 0..3 {
            self.side[axis][0][lane] = bounds.min[axis].next_down();
            self.side[axis][1][lane] = bounds.max[axis].next_up();
        }
    }
}
