//! From a binary tree to a wide one.
//!
//! Which binary nodes become wide ones is decided by dynamic programming so that the wide tree's
//! surface area cost is least (Ylitie, Karras & Laine, "Efficient Incoherent Ray Traversal on
//! GPUs Through Compressed Wide BVHs", 2017, § 3): for every binary node the cost of what is
//! below it is known if one, two, … eight children of a wide node may stand for it.

use super::split::{Lanes, half_area};
use super::wide::WIDTH;

/// What testing a block costs, if looking into a node costs 1.
const BLOCK_COST: f32 = 1.0;

/// A node of the binary tree. The nodes below it come right before it, the left ones first.
pub struct Twig {
    /// Its box.
    pub bounds: Lanes,
    /// Of nodes on the right side; 0 for leaves.
    right: u32,
    /// For leaves: their items …
    pub first: u32,
    /// … and how many.
    pub len: u32,
    /// log₂ of how many items a leaf tests at the price of one.
    pub shift: u32,
    /// Least cost of standing for it with 1, 2, … 8 children.
    cost: [f32; WIDTH],
}

impl Twig {
    /// A leaf.
    pub fn leaf(bounds: Lanes, first: u32, len: u32, shift: u32) -> Self {
        let cost = [half_area(&bounds) * BLOCK_COST; WIDTH];
        Self { bounds, right: 0, first, len, shift, cost }
    }

    /// Whether it is one.
    pub fn is_leaf(&self) -> bool {
        self.right == 0
    }
}

/// Puts a node over the last two trees, of which the right one has so many nodes.
pub fn join(twigs: &mut Vec<Twig>, bounds: Lanes, right: usize) {
    let (b, a) = (&twigs[twigs.len() - 1].cost, &twigs[twigs.len() - 1 - right].cost);
    let mut cost = [f32::INFINITY; WIDTH];
    for children in 2..=WIDTH {
        for left in 1..children {
            let sum = a[left - 1] + b[children - left - 1];
            cost[children - 1] = if sum < cost[children - 1] { sum } else { cost[children - 1] };
        }
    }
    cost[0] = half_area(&bounds) + cost[WIDTH - 1];
    for children in 1..WIDTH {
        cost[children] = cost[children].min(cost[children - 1]);
    }
    twigs.push(Twig { bounds, right: right as u32, first: 0, len: 0, shift: 0, cost });
}

/// The children of the wide node at a binary one.
pub fn children(twigs: &[Twig], of: usize) -> ([usize; WIDTH], usize) {
    let mut found = [0; WIDTH];
    let mut len = 0;
    let mut waiting = [(0, 0); WIDTH];
    if twigs[of].is_leaf() {
        found[0] = of;
        return (found, 1);
    }
    waiting[0] = (of, WIDTH);
    let mut open = 1;
    let mut first = true;
    while open > 0 {
        open -= 1;
        let (at, most) = waiting[open];
        let twig = &twigs[at];
        let mut most = most;
        while !first && most > 1 && twig.cost[most - 2] == twig.cost[most - 1] {
            most -= 1;
        }
        if twig.is_leaf() || most == 1 {
            found[len] = at;
            len += 1;
            continue;
        }
        first = false;
        let (right, left) = (at - 1, at - 1 - twig.right as usize);
        let (a, b) = (&twigs[left].cost, &twigs[right].cost);
        let best = (1..most).min_by(|i, j| (a[i - 1] + b[most - i - 1]).total_cmp(&(a[j - 1] + b[most - j - 1])));
        let best = best.unwrap_or(1);
        waiting[open] = (right, most - best);
        waiting[open + 1] = (left, best);
        open += 2;
    }
    (found, len)
}
