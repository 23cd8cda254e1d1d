//! A heap with time stamps: the queue to read first.
//!
//! Whenever the price of an edge changes it is put in anew, and its old entry is left where it is: to
//! find it in the heap would cost more than to pass it over when its turn comes. Which entry of an
//! edge is the last is told by its stamp.

use crate::collapse::queue::Line;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A price, ordered as all `f64` are; less is cheaper.
#[derive(Clone, Copy, Debug)]
pub(super) struct Price(f64);

impl PartialEq for Price {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Price {}

impl PartialOrd for Price {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Price {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0)
    }
}

/// Entries are numbers below a limit.
#[derive(Clone)]
pub(super) struct Heap {
    entries: BinaryHeap<Reverse<(Price, u32, u32)>>,
    /// For every number how often it was put in.
    stamps: Vec<u32>,
}

impl Line for Heap {
    type Turn = Price;

    fn new(limit: usize) -> Self {
        Self { entries: BinaryHeap::new(), stamps: vec![0; limit] }
    }

    fn turn(cost: f64) -> Price {
        Price(cost)
    }

    fn push(&mut self, entry: u32, turn: Price) {
        // Before more memory is asked for, what will be passed over anyhow can go.
        if self.entries.len() == self.entries.capacity() {
            let stamps = &self.stamps;
            self.entries.retain(|Reverse((_, entry, stamp))| stamps[*entry as usize] == *stamp);
        }
        let stamp = &mut self.stamps[entry as usize];
        *stamp += 1;
        self.entries.push(Reverse((turn, entry, *stamp)));
    }

    fn pop(&mut self, _: usize) -> Option<(u32, Price)> {
        loop {
            let Reverse((price, entry, stamp)) = self.entries.pop()?;
            if stamp == self.stamps[entry as usize] {
                return Some((entry, price));
            }
        }
    }

    fn renew(&mut self, entry: u32, twin: Option<u32>, _: Price, price: impl FnOnce() -> f64) {
        self.push(twin.map_or(entry, |twin| twin.min(entry)), Price(price()));
    }

    #[cfg(test)]
    fn bytes(&self) -> usize {
        self.entries.capacity() * size_of::<Reverse<(Price, u32, u32)>>() + self.stamps.capacity() * 4
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_last_price_counts() {
        let mut heap = Heap::new(3);
        for (entry, cost) in [(0, 1.0), (1, 2.0), (2, f64::NAN), (0, 3.0)] {
            heap.push(entry, Price(cost));
        }
        heap.renew(1, None, Price(0.0), || 4.0);
        let order: Vec<u32> = std::iter::from_fn(|| heap.pop(0)).map(|(entry, _)| entry).collect();
        assert_eq!(order, [0, 1, 2]);
    }
}
