//! Nodes with children still to be visited.

use super::wide::WIDTH;

/// A node, and which of its children wait.
#[derive(Clone, Copy)]
#[repr(align(32))]
pub struct Waiting {
    /// Where the ray enters each child.
    pub enter: [f32; WIDTH],
    /// Index of the node.
    pub node: usize,
    /// A bit for each waiting child.
    pub lanes: u32,
}

/// One entry for each level on the way down. What does not fit the array waits in `spill`;
/// balanced trees never get there.
pub struct Stack {
    entries: [Waiting; STACK],
    len: usize,
    spill: Vec<Waiting>,
}

/// Levels kept beside the ray: enough for eight to the twelfth leaves of a balanced tree.
const STACK: usize = 12;

impl Stack {
    /// An empty stack.
    #[inline(always)]
    pub fn new() -> Self {
        let nothing = Waiting { enter: [0.0; WIDTH], node: 0, lanes: 0 };
        Self { entries: [nothing; STACK], len: 0, spill: Vec::new() }
    }

    /// Forgets everything.
    #[inline(always)]
    pub fn clear(&mut self) {
        self.len = 0;
        self.spill.clear();
    }

    /// Puts a node on top; it stays only if children wait.
    #[inline(always)]
    pub fn push(&mut self, entry: &Waiting) {
        if self.len == STACK {
            self.spill_half();
        }
        self.entries[self.len % STACK] = *entry;
        self.len += usize::from(entry.lanes != 0);
    }

    /// Takes the last node.
    #[inline(always)]
    pub fn pop(&mut self) -> Option<Waiting> {
        if self.len == 0 && !self.refill() {
            return None;
        }
        self.len -= 1;
        Some(self.entries[self.len % STACK])
    }

    #[cold]
    #[inline(never)]
    fn spill_half(&mut self) {
        self.spill.extend_from_slice(&self.entries[..STACK / 2]);
        self.entries.copy_within(STACK / 2..self.len, 0);
        self.len -= STACK / 2;
    }

    /// Takes the nearest spilt half back; false if there is none.
    #[inline(always)]
    fn refill(&mut self) -> bool {
        !self.spill.is_empty() && self.take_back()
    }

    #[cold]
    #[inline(never)]
    fn take_back(&mut self) -> bool {
        let keep = self.spill.len().saturating_sub(STACK / 2);
        self.len = self.spill.len() - keep;
        self.entries[..self.len].copy_from_slice(&self.spill[keep..]);
        self.spill.truncate(keep);
        true
    }
}
