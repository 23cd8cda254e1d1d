//! Nodes with children still to be visited.

use super::wide::WIDTH;

/// A node, and which of its children wait.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub struct Waiting {
    /// Where the ray enters each child.
    pub enter: [f32; WIDTH],
    /// Index of the node.
    pub node: u32,
    /// A bit for each waiting child.
    pub lanes: u32,
}

impl Waiting {
    /// No children.
    pub const NONE: Self = Self { enter: [0.0; WIDTH], node: 0, lanes: 0 };
}

/// Nodes kept beside the ray, a power of two: enough for eight to the sixteenth leaves of a
/// balanced tree.
const KEPT: usize = 16;

/// The nodes on the way down that have children waiting, and on top the one that is looked at.
/// What does not fit the array waits in `spilt`; balanced trees never get there.
pub struct Stack {
    kept: [Waiting; KEPT],
    spilt: Vec<Waiting>,
}

impl Stack {
    /// An empty stack.
    #[inline(always)]
    pub fn new() -> Self {
        Self { kept: [Waiting::NONE; KEPT], spilt: Vec::new() }
    }

    /// Forgets what was spilt.
    #[inline(always)]
    pub fn clear(&mut self) {
        self.spilt.clear();
    }

    /// The node on top of `level` others.
    #[inline(always)]
    pub fn at(&mut self, level: usize) -> &mut Waiting {
        &mut self.kept[level % KEPT]
    }

    /// The level above the one at `level`, which is lost if no child waits there.
    #[inline(always)]
    pub fn above(&mut self, level: usize, waits: bool) -> usize {
        let above = level + usize::from(waits);
        if above == KEPT { self.spill_half() } else { above }
    }

    /// The level below the one at `level`, if there is one.
    #[inline(always)]
    pub fn below(&mut self, level: usize) -> Option<usize> {
        if level > 0 { Some(level - 1) } else { self.take_back() }
    }

    #[cold]
    #[inline(never)]
    fn spill_half(&mut self) -> usize {
        self.spilt.extend_from_slice(&self.kept[..KEPT / 2]);
        self.kept.copy_within(KEPT / 2.., 0);
        KEPT / 2
    }

    /// Takes the nearest spilt half back.
    #[inline(always)]
    fn take_back(&mut self) -> Option<usize> {
        if self.spilt.is_empty() { None } else { Some(self.take_half_back()) }
    }

    #[cold]
    #[inline(never)]
    fn take_half_back(&mut self) -> usize {
        let rest = self.spilt.len().saturating_sub(KEPT / 2);
        let back = self.spilt.len() - rest;
        self.kept[..back].copy_from_slice(&self.spilt[rest..]);
        self.spilt.truncate(rest);
        back - 1
    }
}
