//! What a ray on its way through the tree still has to visit.

/// A node that is still to be visited, and the stretch of the ray inside it.
#[derive(Clone, Copy)]
pub struct Waiting {
    /// The ray is inside from this t …
    pub enter: f64,
    /// … to this.
    pub exit: f64,
    /// Place of the node.
    pub node: u32,
}

/// Entries kept beside the ray; more, in very deep trees, go to the heap.
const STACK: usize = 24;

/// The far children on the way, the nearest on top.
pub struct Stack {
    entries: [Waiting; STACK],
    len: usize,
    spill: Vec<Waiting>,
}

impl Stack {
    /// An empty stack.
    #[inline(always)]
    pub fn new() -> Self {
        let nothing = Waiting { enter: 0.0, exit: 0.0, node: 0 };
        Self { entries: [nothing; STACK], len: 0, spill: Vec::new() }
    }

    /// Holds only one node.
    #[inline(always)]
    pub fn restart(&mut self, first: Waiting) {
        self.spill.clear();
        self.entries[0] = first;
        self.len = 1;
    }

    /// Puts a node on top.
    #[inline(always)]
    pub fn push(&mut self, entry: Waiting) {
        if self.len == STACK {
            self.spill_half();
        }
        self.entries[self.len] = entry;
        self.len += 1;
    }

    #[cold]
    fn spill_half(&mut self) {
        self.spill.extend_from_slice(&self.entries[..STACK / 2]);
        self.entries.copy_within(STACK / 2.., 0);
        self.len = STACK / 2;
    }

    /// The next node that is entered no later than `last`.
    #[inline(always)]
    pub fn pop(&mut self, last: f64) -> Option<Waiting> {
        while self.len > 0 || !self.spill.is_empty() && self.refill() {
            self.len -= 1;
            let entry = self.entries[self.len];
            if entry.enter <= last {
                return Some(entry);
            }
        }
        None
    }

    #[cold]
    fn refill(&mut self) -> bool {
        let keep = self.spill.len().saturating_sub(STACK / 2);
        self.len = self.spill.len() - keep;
        self.entries[..self.len].copy_from_slice(&self.spill[keep..]);
        self.spill.truncate(keep);
        self.len > 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a6t1_more_than_fits_comes_back_in_order() {
        let mut stack = Stack::new();
        let node = |node: u32| Waiting { enter: f64::from(1000 - node), exit: 1000.0, node };
        stack.restart(Waiting { enter: 0.0, ..node(0) });
        (1..100).for_each(|n| stack.push(node(n)));
        let order: Vec<u32> = std::iter::from_fn(|| stack.pop(950.0).map(|w| w.node)).collect();
        let expected: Vec<u32> = (50..100).rev().chain([0]).collect();
        assert_eq!(order, expected, "the last first, without those that are entered too late");
    }
}
