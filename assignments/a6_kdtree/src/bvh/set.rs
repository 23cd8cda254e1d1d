//! Sets of items, which are runs in an array, and how one becomes two.

use super::split::{Cut, Item, Lanes, NOTHING, best_cut, center, measure, stored};
use common::simd::{self, Simd, SimdBase, dispatch, f32x8};

/// Below this depth sets are halved by number, which ends after at most 32 more levels.
const DEEP: u32 = 60;

/// A run of items that will become a child of some node.
#[derive(Clone, Copy)]
pub struct Set {
    /// The box of the items.
    pub bounds: Lanes,
    /// The box of the items' doubled centres.
    centers: Lanes,
    /// The run in the array of all items.
    pub first: u32,
    /// Number of items.
    pub len: u32,
    /// Cuts that led to it.
    depth: u32,
    /// Which of the two arrays it is in.
    array: usize,
    /// log₂ of how many items a leaf tests at the price of one.
    pub shift: u32,
}

/// The part of the arrays that a thread works on.
pub struct Desk<'a> {
    /// Two arrays to move items to and fro.
    pub items: [&'a mut [Item]; 2],
    /// Where the leaves' items are written, as positions in the caller's array.
    pub order: &'a mut [u32],
    /// Position of the part in the whole arrays.
    pub first: usize,
}

impl Desk<'_> {
    /// The parts that belong to sets in order of their position.
    pub fn share<'s>(&mut self, sets: impl Iterator<Item = &'s Set>) -> Vec<Desk<'_>> {
        let [a, b] = &mut self.items;
        let (mut a, mut b, mut order, mut at) = (&mut **a, &mut **b, &mut *self.order, self.first);
        let share = |set: &Set| {
            let first = set.first as usize;
            let (skip, len) = (first - at, set.len as usize);
            at = first + len;
            let items = [run_of(&mut a, skip, len), run_of(&mut b, skip, len)];
            Desk { items, order: run_of(&mut order, skip, len), first }
        };
        sets.map(share).collect()
    }
}

/// Takes `len` after `skip` from the front of a slice.
fn run_of<'a, T>(rest: &mut &'a mut [T], skip: usize, len: usize) -> &'a mut [T] {
    let (run, after) = std::mem::take(rest)[skip..].split_at_mut(len);
    *rest = after;
    run
}

impl Set {
    /// No items.
    pub const EMPTY: Self =
        Self { bounds: NOTHING, centers: NOTHING, first: 0, len: 0, depth: 0, array: 0, shift: 0 };

    /// The run of all of `items`, which is at `first` of the first array.
    pub fn all(items: &[Item], first: usize, shift: u32) -> Self {
        let [bounds, centers] = dispatch!(simd::level(), s => measure(s, items));
        let (first, len) = (first as u32, items.len() as u32);
        Self { bounds, centers, first, len, shift, ..Self::EMPTY }
    }

    /// Whether it is a leaf. A block costs what a node costs, so cutting one never pays.
    pub fn is_leaf(&self) -> bool {
        self.len <= 1 << self.shift
    }

    /// Writes down a leaf's items, ascending.
    pub fn settle(&self, desk: &mut Desk) {
        let first = self.first as usize - desk.first;
        let run = first..first + self.len as usize;
        let order = &mut desk.order[run.clone()];
        for (place, item) in order.iter_mut().zip(&desk.items[self.array][run]) {
            *place = item.index();
        }
        order.sort_unstable();
    }

    /// Both sides of the best cut.
    pub fn cut(&self, desk: &mut Desk) -> [Self; 2] {
        let [a, b] = &mut desk.items;
        let (from, to) = if self.array == 0 { (a, b) } else { (b, a) };
        let first = self.first as usize - desk.first;
        let run = first..first + self.len as usize;
        let (from, to) = (&from[run.clone()], &mut to[run]);
        dispatch!(simd::level(), s => self.cut_run(s, from, to))
    }

    #[inline(always)]
    fn cut_run<S: Simd>(&self, simd: S, from: &[Item], to: &mut [Item]) -> [Self; 2] {
        let cut = if self.depth < DEEP { best_cut(simd, from, &self.centers, self.shift) } else { None };
        let Some(cut) = cut else {
            // All centres are one point and no plane tells the items apart: halving them keeps
            // the tree balanced.
            let (left, right) = from.split_at(from.len() / 2);
            let [left_boxes, right_boxes] = [measure(simd, left), measure(simd, right)];
            return self.parts(left.len(), self.array, left_boxes, right_boxes);
        };
        let [left, right] = partition(simd, from, to, &cut);
        self.parts(cut.left, 1 - self.array, [cut.bounds[0], left], [cut.bounds[1], right])
    }

    fn parts(&self, left: usize, array: usize, boxes: [Lanes; 2], right_boxes: [Lanes; 2]) -> [Self; 2] {
        let part = |first: u32, len: u32, [bounds, centers]: [Lanes; 2]| Self {
            bounds,
            centers,
            first,
            len,
            depth: self.depth + 1,
            array,
            ..*self
        };
        let left = left as u32;
        [part(self.first, left, boxes), part(self.first + left, self.len - left, right_boxes)]
    }
}

/// Copies the items of both sides to runs of their own, in order, and returns the boxes of their
/// doubled centres. No branch depends on the side, which cannot be predicted.
#[inline(always)]
fn partition<S: Simd>(simd: S, from: &[Item], to: &mut [Item], cut: &Cut) -> [Lanes; 2] {
    const LIMIT: [Lanes; 2] = [NOTHING, [f32::INFINITY; 8]];
    let limit = LIMIT.map(|lanes| f32x8::load_array_ref(simd, &lanes));
    let (mut left, mut right) = (limit[0], limit[0]);
    let mut next = [cut.left, 0];
    for item in from {
        let side = usize::from(cut.is_left(item));
        let center = center(simd, f32x8::load_array_ref(simd, &item.0));
        left = left.max(center.min(f32x8::load_array_ref(simd, &LIMIT[side])));
        right = right.max(center.min(f32x8::load_array_ref(simd, &LIMIT[1 - side])));
        to[next[side]] = *item;
        next[side] += 1;
    }
    [stored(left), stored(right)]
}
