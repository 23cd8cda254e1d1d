//! The tree laid out for rays: nodes of eight bytes, leaves of triangle blocks and solids.

use super::build;
use super::clip::halves;
use super::leaf::Mixed;
use super::plan::{Next, PlanNode, Reader};
use super::rule::Options;
use super::sah::{self, half_area};
use crate::bvh::wide::WideNode;
use common::geometry::Geometry;
use common::math::Bounds;
use common::shape::triangle_block::TriangleBlock;

/// A plane and the place of two children, or a leaf.
///
/// `word` holds the axis in its low two bits and the place of the lower child above them, the
/// upper child following. Else `data` holds the plane's `f32`; axis 3 marks a leaf, whose
/// place and `data` say what it holds; see `leaf.rs`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Node {
    pub(super) data: u32,
    pub(super) word: u32,
}

/// The axis that is none.
pub(super) const LEAF: u32 = 3;

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

    /// The place of its lower child, the upper one is the next; of what a leaf holds.
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
    /// Boxes around the blocks of leaves that have more than one.
    pub(super) boxes: Vec<WideNode>,
    pub(super) solids: Vec<u32>,
    pub(super) mixed: Vec<Mixed>,
    pub(super) options: Options,
    pub(super) summary: Summary,
}

impl<'g> KdTree<'g> {
    /// Builds the tree; the same whatever the number of threads.
    ///
    /// # Panics
    /// If there are more than 2²⁹ finite primitives, or leaves hold 2²⁶ blocks of triangles.
    pub fn new(geometry: &'g Geometry, options: Options) -> Self {
        let mut tree = Self {
            geometry,
            bounds: Bounds::EMPTY,
            triangle_bounds: Bounds::of_points(geometry.triangles().iter().flatten().copied()),
            nodes: Vec::new(),
            blocks: Vec::new(),
            boxes: Vec::new(),
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
            tree.boxes.shrink_to_fit();
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
        let (blocks, solids) = self.content(leaf);
        blocks.iter().map(|b| b.len()).sum::<usize>() + solids.len()
    }

    /// Bytes that it takes.
    pub fn bytes(&self) -> usize {
        let leaves = size_of_val(&*self.solids) + size_of_val(&*self.mixed);
        size_of_val(&*self.nodes) + size_of_val(&*self.blocks) + size_of_val(&*self.boxes) + leaves
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
                let node = self.leaf(primitives, inside, share);
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

    /// All of the tree in text, to compare two builds.
    pub fn fingerprint(&self) -> String {
        let (blocks, boxes) = (&self.blocks, &self.boxes);
        format!("{:?} {blocks:?} {boxes:?} {:?} {:?}", self.nodes, self.solids, self.mixed)
    }
}
