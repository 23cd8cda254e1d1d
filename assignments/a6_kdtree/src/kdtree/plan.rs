//! The tree as it comes out of the build, to be laid out for rays.

use super::reference::Reference;
use common::shape::triangle_block::LANES;

/// What to lay out.
#[derive(Default)]
pub struct Plan {
    /// Nodes, each followed by all below its lower child and then all below its upper one.
    pub nodes: Vec<PlanNode>,
    /// What the leaves hold, one after the other: [`Reference::primitive`], ascending in a leaf.
    primitives: Vec<u32>,
}

/// A node of a [`Plan`].
#[derive(Clone, Copy)]
pub enum PlanNode {
    /// So many primitives.
    Leaf(u32),
    /// A plane across x, y or z (0, 1, 2), and where.
    Inner(u8, f32),
}

impl PlanNode {
    /// Blocks of triangles that it takes if it holds no solids.
    pub fn most_blocks(&self) -> usize {
        match self {
            Self::Leaf(primitives) => (*primitives as usize).div_ceil(LANES),
            Self::Inner(..) => 0,
        }
    }
}

/// Reads a plan from the root on.
pub struct Reader<'p> {
    nodes: std::slice::Iter<'p, PlanNode>,
    primitives: &'p [u32],
}

/// A node that was read.
pub enum Next<'p> {
    /// What it holds.
    Leaf(&'p [u32]),
    /// The axis across which its plane is, and where; its children follow.
    Inner(usize, f32),
}

impl Plan {
    /// Adds what another plan holds.
    pub fn append(&mut self, mut other: Self) {
        self.nodes.append(&mut other.nodes);
        self.primitives.append(&mut other.primitives);
    }

    /// Adds a leaf.
    pub fn leaf(&mut self, references: &[Reference]) {
        let first = self.primitives.len();
        self.primitives.extend(references.iter().map(|r| r.primitive));
        self.primitives[first..].sort_unstable();
        self.nodes.push(PlanNode::Leaf(references.len() as u32));
    }

    /// A reader at the root.
    pub fn reader(&self) -> Reader<'_> {
        Reader { nodes: self.nodes.iter(), primitives: &self.primitives }
    }
}

impl<'p> Reader<'p> {
    /// The next node.
    ///
    /// # Panics
    /// After the last.
    pub fn next(&mut self) -> Next<'p> {
        match *self.nodes.next().expect("every inner node has two children") {
            PlanNode::Inner(axis, at) => Next::Inner(usize::from(axis), at),
            PlanNode::Leaf(count) => {
                let (own, rest) = self.primitives.split_at(count as usize);
                self.primitives = rest;
                Next::Leaf(own)
            }
        }
    }
}
