//! A queue whose turn comes by cost, cheap and nearly exact.
//!
//! Costs are put into drawers of one sixteenth of an octave, which are lists through one array;
//! within a drawer first come, first served. Nothing is sorted, pushing and popping takes a few
//! instructions, and neighbours that cost the same come in the order of their numbers, which are
//! often neighbours in memory.

use crate::collapse::surface::NONE;

/// Bits of the mantissa that count.
const FINENESS: u32 = 4;
/// How many drawers there are for positive, finite `f32`.
const DRAWERS: usize = 255 << FINENESS;
/// Last of its drawer.
const LAST: u32 = NONE - 1;

/// A drawer of costs; less is cheaper.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Drawer(u32);

/// Entries are numbers below a limit, each at most once in the queue.
pub(super) struct Queue {
    /// For each entry the one after it in its drawer, [`LAST`], or [`NONE`] if not queued.
    after: Vec<u32>,
    first: Vec<u32>,
    last: Vec<u32>,
    /// All drawers before this are empty.
    lowest: usize,
}

impl Drawer {
    /// The drawer for a cost; what is not a number goes to the last.
    #[inline(always)]
    pub(super) fn of(cost: f64) -> Self {
        // The last octave holds infinities and NaN.
        let bits = (cost.max(0.0) as f32).to_bits() >> (23 - FINENESS);
        Self(if cost.is_nan() { DRAWERS as u32 - 1 } else { bits.min(DRAWERS as u32 - 1) })
    }
}

impl Queue {
    /// An empty queue for entries below `limit`.
    pub(super) fn new(limit: usize) -> Self {
        Self { after: vec![NONE; limit], first: vec![LAST; DRAWERS], last: vec![LAST; DRAWERS], lowest: DRAWERS }
    }

    /// Whether an entry is queued.
    #[inline(always)]
    pub(super) fn contains(&self, entry: u32) -> bool {
        self.after[entry as usize] != NONE
    }

    /// Puts an entry that is not queued at the end of a drawer.
    #[inline(always)]
    pub(super) fn push(&mut self, entry: u32, drawer: Drawer) {
        let drawer = drawer.0 as usize;
        self.after[entry as usize] = LAST;
        if self.first[drawer] == LAST {
            self.first[drawer] = entry;
        } else {
            self.after[self.last[drawer] as usize] = entry;
        }
        self.last[drawer] = entry;
        self.lowest = self.lowest.min(drawer);
    }

    /// Takes the first entry of the cheapest drawer.
    #[inline(always)]
    pub(super) fn pop(&mut self) -> Option<(u32, Drawer)> {
        while self.lowest < DRAWERS && self.first[self.lowest] == LAST {
            self.lowest += 1;
        }
        let entry = *self.first.get(self.lowest)?;
        self.first[self.lowest] = std::mem::replace(&mut self.after[entry as usize], NONE);
        Some((entry, Drawer(self.lowest as u32)))
    }
}
