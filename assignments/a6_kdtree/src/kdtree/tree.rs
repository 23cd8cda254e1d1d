//! The tree laid out for rays: nodes of eight bytes, leaves of triangle blocks and solids.

use super::build;
use super::clip::halves;
use super::plan::{Next, PlanNode, Reader};
use super::rule::Options;
use super::sah::{self, half_area, leaf_cost};
use common::geometry::Geometry;
use common::math::Bounds;
use common::shape::triangle_block::{LANES, TriangleBlock};
use std::ops::Range;

/// A plane and the place of two children, or a leaf.
///
/// `word` holds the axis in its low two bits and the place of the lower child above them, the
/// upper child following; axis 3 marks a leaf, with the place of its first block there and the
/// number of its blocks in `data`. A leaf that holds solids has `MIXED` set in `data` and
/// names a `Mixed` instead. Else `data` holds the plane's `f32`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Node {
    data: u32,
    word: u32,
}

/// The axis that is none.
const LEAF: u32 = 3;
const MIXED: u32 = 1 << 31;

/// What a leaf with solids holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mixed {
    blocks: Range<u32>,
    solids: Range<u32>,
}

impl Node {
    /// Whether it has no children.
    #[inline(always)]
    pub fn is_leaf(self) -> bool {
        self.word & 3 == LEAF
    }

    /// The axis that its plane is across; 3 for a leaf.
    #[inline(always)]
    pub fn axis(self) -> usize {
        (self.word & 3) as usize
    }

    /// Where its plane stands.
    #[inline(always)]
    pub fn at(self) -> f32 {
        f32::from_bits(self.data)
    }

    /// The place of its lower child; the upper one is the next.
    #[inline(always)]
    pub fn child(self) -> usize {
        (self.word >> 2) as usize
    }
}

/// Figures of a tree, for `-stats`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Summary {
    /// Planes and leaves.
    pub nodes: usize,
    /// Leaves, also empty ones.
    pub leaves: usize,
    /// Leaves that hold nothing.
    pub empty: usize,
    /// Most planes between root and leaf.
    pub depth: u32,
    /// Primitives in all leaves together, each as often as it is held.
    pub references: usize,
    /// What the surface area heuristic expects a ray that meets the box to cost, in blocks.
    pub cost: f64,
}

/// A kd-tree over a scene's finite primitives; planes and discs are tested beside it.
pub struct KdTree<'g> {
    pub(super) geometry: &'g Geometry,
    /// The box that the planes cut.
    pub(super) bounds: Bounds,
    pub(super) triangle_bounds: Bounds,
    pub(super) nodes: Vec<Node>,
    pub(super) blocks: Vec<TriangleBlock>,
    pub(super) solids: Vec<u32>,
    pub(super) mixed: Vec<Mixed>,
    pub(super) options: Options,
    summary: Summary,
}

impl<'g> KdTree<'g> {
    /// Builds the tree; the same whatever the number of threads.
    ///
    /// # Panics
    /// If there are more than 2²⁹ finite primitives.
    pub fn new(geometry: &'g Geometry, options: Options) -> Self {
        let mut tree = Self {
            geometry,
            bounds: Bounds::EMPTY,
            triangle_bounds: Bounds::of_points(geometry.triangles().iter().flatten().copied()),
            nodes: Vec::new(),
            blocks: Vec::new(),
            solids: Vec::new(),
            mixed: Vec::new(),
            options,
            summary: Summary::default(),
        };
        if let Some((built, bounds)) = build::build(geometry, &options) {
            tree.bounds = bounds;
            tree.nodes.reserve_exact(built.nodes.len());
            tree.blocks.reserve_exact(built.nodes.iter().map(PlanNode::most_blocks).sum());
            tree.nodes.push(Node { data: 0, word: LEAF });
            tree.lay_out(&mut built.reader(), 0, &bounds, 0);
            tree.summary.nodes = tree.nodes.len();
            tree.nodes.shrink_to_fit();
            tree.blocks.shrink_to_fit();
        }
        tree
    }

    /// How it was asked to be built.
    pub fn options(&self) -> Options {
        self.options
    }

    /// Planes and leaves, the root first, each after its parent; none if nothing is finite.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// The box that the planes cut; empty if nothing is finite.
    pub fn root_box(&self) -> Bounds {
        self.bounds
    }

    /// How many primitives a leaf holds.
    pub fn held_by(&self, leaf: Node) -> usize {
        let (blocks, solids) = self.held(leaf);
        blocks.iter().map(|b| b.len()).sum::<usize>() + solids.len()
    }

    /// Bytes that it takes.
    pub fn bytes(&self) -> usize {
        let leaves = size_of_val(&*self.solids) + size_of_val(&*self.mixed);
        size_of_val(&*self.nodes) + size_of_val(&*self.blocks) + leaves
    }

    /// Figures for `-stats`.
    pub fn summary(&self) -> Summary {
        self.summary
    }

    /// Puts the next subtree of a plan to place `place`; `inside` is its box.
    fn lay_out(&mut self, plan: &mut Reader, place: usize, inside: &Bounds, depth: u32) {
        // A box without surface is met as likely as not.
        let share = half_area(inside) / half_area(&self.bounds);
        let share = if share.is_finite() { share } else { 1.0 };
        match plan.next() {
            Next::Leaf(primitives) => {
                let node = self.leaf(primitives, share);
                self.nodes[place] = node;
                self.summary.depth = self.summary.depth.max(depth);
            }
            Next::Inner(axis, at) => {
                let child = self.nodes.len();
                assert!(child < 1 << 30, "at most 2^30 nodes");
                self.summary.cost += share * f64::from(sah::STEP);
                self.nodes[place] = Node { data: at.to_bits(), word: (child as u32) << 2 | axis as u32 };
                self.nodes.extend([Node { data: 0, word: LEAF }; 2]);
                for (side, half) in halves(inside, axis, at).iter().enumerate() {
                    self.lay_out(plan, child + side, half, depth + 1);
                }
            }
        }
    }

    fn leaf(&mut self, primitives: &[u32], share: f64) -> Node {
        let triangles = primitives.partition_point(|p| (*p as usize) < self.geometry.triangles().len());
        let (triangles, solids) = primitives.split_at(triangles);
        self.summary.leaves += 1;
        self.summary.empty += usize::from(primitives.is_empty());
        self.summary.references += primitives.len();
        let weight = triangles.len() as u32 + solids.len() as u32 * sah::weight(true);
        self.summary.cost += share * leaf_cost(weight);
        let (first, geometry) = (self.blocks.len() as u32, self.geometry);
        let numbered =
            |i: &u32| (geometry.triangle_numbers()[*i as usize], geometry.triangles()[*i as usize]);
        self.blocks.extend(triangles.chunks(LANES).map(|c| TriangleBlock::pack(c.iter().map(numbered))));
        let blocks = first..self.blocks.len() as u32;
        if solids.is_empty() {
            return Node { data: blocks.len() as u32, word: first << 2 | LEAF };
        }
        let first_solid = self.solids.len() as u32;
        self.solids.extend(solids.iter().map(|p| p - geometry.triangles().len() as u32));
        self.mixed.push(Mixed { blocks, solids: first_solid..self.solids.len() as u32 });
        Node { data: MIXED, word: (self.mixed.len() as u32 - 1) << 2 | LEAF }
    }

    /// What a leaf holds.
    #[inline(always)]
    pub(super) fn held(&self, leaf: Node) -> (&[TriangleBlock], &[u32]) {
        let place = leaf.child();
        if leaf.data & MIXED == 0 {
            return (&self.blocks[place..place + leaf.data as usize], &[]);
        }
        let Mixed { blocks, solids } = &self.mixed[place];
        let range = |r: &Range<u32>| r.start as usize..r.end as usize;
        (&self.blocks[range(blocks)], &self.solids[range(solids)])
    }

    /// All of the tree in text, to compare two builds.
    pub fn fingerprint(&self) -> String {
        format!("{:?} {:?} {:?} {:?}", self.nodes, self.blocks, self.solids, self.mixed)
    }
}
