//! Which slot of a crowd does what next.

use super::slot::Slot;

/// Rays under way at a time, a power of two.
pub const SLOTS: usize = 16;

/// Numbers of slots.
#[derive(Clone, Copy)]
pub struct Line {
    /// The first of them are in use …
    pub slots: [u8; SLOTS],
    /// … so many.
    pub len: usize,
}

impl Line {
    /// None.
    pub const EMPTY: Self = Self { slots: [0; SLOTS], len: 0 };

    /// Adds one, if `really`; no branch is made of it.
    #[inline(always)]
    pub fn push(&mut self, slot: u8, really: bool) {
        self.slots[self.len % SLOTS] = slot;
        self.len += usize::from(really);
    }

    /// Takes the last.
    #[inline(always)]
    pub fn pop(&mut self) -> Option<u8> {
        self.len = self.len.checked_sub(1)?;
        Some(self.slots[self.len % SLOTS])
    }

    /// All of them.
    #[inline(always)]
    pub fn slots(&self) -> &[u8] {
        &self.slots[..self.len.min(SLOTS)]
    }
}

/// The slots, by what their rays do next.
#[derive(Clone, Copy)]
pub struct Lines {
    /// Look into a node …
    pub node: Line,
    /// … or a leaf …
    pub leaf: Line,
    /// … or hold no ray.
    pub idle: Line,
}

impl Lines {
    /// Puts a slot where it belongs.
    #[inline(always)]
    pub fn put(&mut self, number: u8, slot: &Slot, under_way: bool) {
        if under_way {
            let is_node = slot.next.is_node();
            self.node.push(number, is_node);
            self.leaf.push(number, !is_node);
        } else {
            self.idle.push(number, true);
        }
    }
}
