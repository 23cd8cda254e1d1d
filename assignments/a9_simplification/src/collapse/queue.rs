//! A queue whose turn comes by cost, cheap and nearly exact.
//!
//! Costs are put into drawers of one eighth of an octave. The cheapest drawer is emptied from front
//! to back; whatever is put into it or below it meanwhile has to wait for its end. Nothing is sorted,
//! pushing and popping take a few instructions, neighbours that cost the same come in the order of
//! their numbers, which are often neighbours in memory, and one can look ahead.

use crate::collapse::drawers::{Drawer, Drawers};

/// Who comes next: what may be drawn together, by what it costs.
pub(super) trait Line: Clone {
    /// When it is somebody's turn; less is sooner.
    type Turn: Copy + Ord;

    /// An empty line for entries below `limit`.
    fn new(limit: usize) -> Self;

    /// The turn of what costs so much.
    fn turn(cost: f64) -> Self::Turn;

    /// A later turn that still passes for this one.
    fn bear(turn: Self::Turn, _patience: u32) -> Self::Turn {
        turn
    }

    /// Puts in an entry that is not there.
    fn push(&mut self, entry: u32, turn: Self::Turn);

    /// Takes out the next one. The order does not matter among so many as are the `steps` to the goal.
    fn pop(&mut self, steps: usize) -> Option<(u32, Self::Turn)>;

    /// What will be popped `further` entries on, if that is known already.
    fn ahead(&self, _further: usize) -> Option<u32> {
        None
    }

    /// The price of an entry, which may be there under another number `twin`, has changed while it was
    /// somebody's `turn`.
    fn renew(&mut self, entry: u32, twin: Option<u32>, turn: Self::Turn, price: impl FnOnce() -> f64);

    /// Bytes that are held.
    #[cfg(test)]
    fn bytes(&self) -> usize;
}

/// Entries are numbers below a limit, each at most once in the queue.
#[derive(Clone)]
pub(super) struct Queue {
    drawers: Drawers,
    queued: Vec<bool>,
    /// The drawer that is being emptied, its entries, and how many of them are out.
    open: Drawer,
    entries: Vec<u32>,
    out: usize,
}

impl Line for Queue {
    type Turn = Drawer;

    fn new(limit: usize) -> Self {
        Self {
            drawers: Drawers::default(),
            queued: vec![false; limit],
            open: Drawer::FIRST,
            entries: Vec::new(),
            out: 0,
        }
    }

    #[inline(always)]
    fn turn(cost: f64) -> Drawer {
        Drawer::of(cost)
    }

    #[inline(always)]
    fn bear(turn: Drawer, patience: u32) -> Drawer {
        turn.dearer(patience)
    }

    /// At the end of a drawer.
    #[inline(always)]
    fn push(&mut self, entry: u32, drawer: Drawer) {
        self.queued[entry as usize] = true;
        self.drawers.put(entry, drawer);
    }

    /// The next entry of the cheapest drawer.
    #[inline(always)]
    fn pop(&mut self, _: usize) -> Option<(u32, Drawer)> {
        self.pop_until(Drawer::LAST)
    }

    #[inline(always)]
    fn ahead(&self, further: usize) -> Option<u32> {
        self.entries.get(self.out + further).copied()
    }

    /// Too cheaply rather than too late: the price is worked out when its turn comes.
    #[inline(always)]
    fn renew(&mut self, entry: u32, twin: Option<u32>, drawer: Drawer, _: impl FnOnce() -> f64) {
        if !self.contains(entry) && twin.is_none_or(|twin| !self.contains(twin)) {
            self.push(entry, drawer);
        }
    }

    #[cfg(test)]
    fn bytes(&self) -> usize {
        self.drawers.bytes() + self.entries.capacity() * size_of::<u32>() + self.queued.capacity()
    }
}

impl Queue {
    /// Whether an entry is queued.
    #[inline(always)]
    fn contains(&self, entry: u32) -> bool {
        self.queued[entry as usize]
    }

    /// What entries are below.
    pub(super) fn limit(&self) -> usize {
        self.queued.len()
    }

    /// Takes an entry for queued that is going to be pushed.
    #[inline(always)]
    pub(super) fn expect(&mut self, entry: u32) {
        self.queued[entry as usize] = true;
    }

    /// The next entry, if that is in no drawer after `last`.
    #[inline(always)]
    pub(super) fn pop_until(&mut self, last: Drawer) -> Option<(u32, Drawer)> {
        if self.out == self.entries.len() {
            self.open_next(last)?;
        }
        let entry = self.entries[self.out];
        self.out += 1;
        self.queued[entry as usize] = false;
        Some((entry, self.open))
    }

    fn open_next(&mut self, last: Drawer) -> Option<()> {
        self.out = 0;
        self.entries.clear();
        self.open = self.drawers.cheapest(last)?;
        self.drawers.exchange(self.open, &mut self.entries);
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cheap_comes_first_and_equal_in_order() {
        let costs = [3.0, 1e-30, 0.0, 1e30, 3.0, f64::NAN, 0.5, 0.0];
        let mut queue = Queue::new(costs.len());
        costs.iter().enumerate().for_each(|(entry, &cost)| queue.push(entry as u32, Drawer::of(cost)));
        let mut order = Vec::new();
        while let Some((entry, drawer)) = queue.pop(0) {
            assert_eq!(drawer, Drawer::of(costs[entry as usize]));
            assert!(!queue.contains(entry));
            order.push(entry);
        }
        assert_eq!(order, [2, 7, 1, 6, 0, 4, 3, 5]);
    }

    #[test]
    fn what_is_pushed_below_comes_next() {
        let mut queue = Queue::new(3);
        queue.push(0, Drawer::of(1.0));
        queue.push(1, Drawer::of(2.0));
        assert_eq!(queue.pop(0).map(|popped| popped.0), Some(0));
        queue.push(2, Drawer::of(0.25));
        assert_eq!(queue.pop(0).map(|popped| popped.0), Some(2));
        assert_eq!(queue.pop(0).map(|popped| popped.0), Some(1));
        assert_eq!(queue.pop(0), None);
    }
}
