//! Children still to be visited.

use super::wide::{Child, WIDTH, WideNode};

/// The nearest child on top. What does not fit the array waits in `spill`, farthest first;
/// balanced trees never get there.
pub struct Stack {
    entries: [(f32, Child); STACK],
    len: usize,
    spill: Vec<(f32, Child)>,
}

/// Entries kept beside the ray: three or four children may wait at each of eight levels.
const STACK: usize = 32;

impl Stack {
    /// An empty stack.
    #[inline(always)]
    pub fn new() -> Self {
        Self { entries: [(0.0, Child::NOTHING); STACK], len: 0, spill: Vec::new() }
    }

    /// The next child that is entered no later than `max`.
    #[inline(always)]
    pub fn pop(&mut self, max: f32) -> Option<Child> {
        while self.len > 0 || self.refill() {
            self.len -= 1;
            let (enter, child) = self.entries[self.len % STACK];
            if enter <= max {
                return Some(child);
            }
        }
        None
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

    /// Takes the children that are met, at least one, and returns the one entered first.
    #[inline(always)]
    pub fn descend(&mut self, node: &WideNode, mut lanes: u32, enter: &[f32; WIDTH]) -> Child {
        let lane = lanes.trailing_zeros() as usize % WIDTH;
        lanes &= lanes - 1;
        if lanes == 0 {
            return node.child[lane];
        }
        let mut first = (enter[lane], node.child[lane]);
        if self.len > STACK - WIDTH {
            self.spill_half();
        }
        let base = self.len;
        loop {
            let lane = lanes.trailing_zeros() as usize % WIDTH;
            lanes &= lanes - 1;
            let mut later = (enter[lane], node.child[lane]);
            if later.0 < first.0 {
                std::mem::swap(&mut first, &mut later);
            }
            // Insertion below the top keeps the waiting ones in order.
            let mut i = self.len;
            while i > base && self.entries[(i - 1) % STACK].0 < later.0 {
                self.entries[i % STACK] = self.entries[(i - 1) % STACK];
                i -= 1;
            }
            self.entries[i % STACK] = later;
            self.len += 1;
            if lanes == 0 {
                return first.1;
            }
        }
    }
}
