//! The wide tree: nodes of up to eight children, leaves of triangle blocks or solids.

use super::balls::Balls;
use super::horizon::Horizons;
use common::geometry::Geometry;
use common::math::Bounds;
use common::shape::triangle_block::TriangleBlock;
use common::simd::prefetch;
use std::sync::OnceLock;

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

    /// A node.
    pub fn node(index: usize) -> Self {
        Self(index as u32 & INDEX)
    }

    /// A block with `len` triangles.
    pub fn block(index: usize, len: usize) -> Self {
        Self(BLOCK | (index as u32) << COUNT_BITS & INDEX | (len as u32))
    }

    /// `len` solids, at `first` of all.
    pub fn solids(first: usize, len: usize) -> Self {
        Self(SOLIDS | (first as u32) << COUNT_BITS & INDEX | (len as u32))
    }

    /// Whether it holds a node.
    #[inline(always)]
    pub fn is_node(self) -> bool {
        self.0 & !INDEX == 0
    }

    /// The number of the node that it holds.
    #[inline(always)]
    pub fn index(self) -> usize {
        (self.0 & INDEX) as usize
    }

    /// Index of the block that it holds and how many of its triangles are in use.
    #[inline(always)]
    pub fn block_and_len(self) -> (usize, usize) {
        let index = self.0 & INDEX;
        ((index >> COUNT_BITS) as usize, index as usize & ((1 << COUNT_BITS) - 1))
    }

    /// What it holds.
    #[inline(always)]
    pub fn held(self) -> Held {
        let (first, count) = self.block_and_len();
        match self.0 & !INDEX {
            BLOCK => Held::Block(first, count),
            SOLIDS => Held::Solids(first, count),
            _ => Held::Node(self.index()),
        }
    }
}

/// The hierarchy over a scene's finite primitives; planes, and balls if they are few, are tested
/// beside it.
pub struct Bvh<'g> {
    pub(crate) geometry: &'g Geometry,
    pub(crate) nodes: Vec<WideNode>,
    pub(crate) blocks: Vec<TriangleBlock>,
    pub(crate) solids: Vec<u32>,
    /// Those that are not in it.
    pub(super) balls: Balls,
    /// Around everything in it, which are not the balls beside it.
    pub(crate) bounds: Bounds,
    pub(super) depth: usize,
    /// What rays that leave a triangle can still meet; worked out when the first of them comes.
    pub(super) horizons: OnceLock<Option<Horizons>>,
}

/// Nodes of a tree of some 16 MiB.
const LARGE: usize = 8192;

impl Bvh<'_> {
    /// Whether nothing stands beside the tree, no plane and no ball.
    #[inline(always)]
    pub(super) fn stands_alone(&self) -> bool {
        self.geometry.sheets().is_empty() && self.balls.is_empty()
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
            Held::Node(index) => self.nodes[index].prefetch(),
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
}

/// No children.
pub const EMPTY_NODE: WideNode = WideNode {
    side: [[[f32::INFINITY; WIDTH], [f32::NEG_INFINITY; WIDTH]]; 3],
    child: [Child::NOTHING; WIDTH],
    axis: 0,
};

impl WideNode {
    /// Asks the memory for it, without waiting.
    #[inline(always)]
    pub fn prefetch(&self) {
        for sides in &self.side {
            prefetch(&sides[0]);
        }
        prefetch(&self.child);
    }

    /// How many of the places are in use; these come first.
    #[inline(always)]
    pub fn children(&self) -> usize {
        WIDTH - self.child.iter().rev().take_while(|child| **child == Child::NOTHING).count()
    }

    /// Puts a box into a lane, widened by the smallest step, so that a ray that runs in one of
    /// its sides is inside.
    pub fn set_box(&mut self, lane: usize, bounds: &Bounds) {
        for axis in 0..3 {
            self.side[axis][0][lane] = bounds.min[axis].next_down();
            self.side[axis][1][lane] = bounds.max[axis].next_up();
        }
    }
}
