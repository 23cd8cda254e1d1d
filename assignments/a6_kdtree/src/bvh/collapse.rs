//! From a binary tree to a wide one.
//!
//! Which binary nodes become wide ones is decided so that the wide tree's cost by the surface
//! area heuristic is least (Ylitie, Karras & Laine, "Efficient Incoherent Ray Traversal on GPUs
//! Through Compressed Wide BVHs", 2017, § 3): of every binary node it is known what the cheapest
//! way costs to have one, at most two, … at most eight children of a wide node stand for it.

use super::set::Set;
use super::split::{Lanes, half_area};
use super::wide::WIDTH;

/// Least costs with at most 1, 2, … 8 children, in units of a node's test times half its surface;
/// a block's test costs as much.
type Costs = [f32; WIDTH];

/// A node of the binary tree. What is below it stands right before it, the left side first.
pub struct Twig {
    /// Its box.
    pub bounds: Lanes,
    /// Of a leaf: where its items begin …
    pub first: u32,
    /// … how many they are …
    pub len: u32,
    /// … and log₂ of how many are tested at the price of one.
    pub shift: u32,
    /// How many nodes are on its right side; none if it is a leaf.
    right: u32,
    costs: Costs,
}

impl Twig {
    /// A leaf.
    pub fn leaf(set: &Set) -> Self {
        let &Set { bounds, first, len, shift, .. } = set;
        Self { bounds, first, len, shift, right: 0, costs: [half_area(&bounds); WIDTH] }
    }

    /// The node over two trees at the end of `twigs`, the second of which begins at `middle`.
    pub fn over(twigs: &[Self], middle: usize, bounds: Lanes) -> Self {
        let (left, right) = (&twigs[middle - 1].costs, &twigs[twigs.len() - 1].costs);
        let mut costs = [f32::INFINITY; WIDTH];
        for most in 2..=WIDTH {
            let (shared, _) = share(left, right, most);
            costs[most - 1] = shared;
        }
        costs[0] = half_area(&bounds) + costs[WIDTH - 1];
        for most in 1..WIDTH {
            costs[most] = if costs[most] < costs[most - 1] { costs[most] } else { costs[most - 1] };
        }
        let right = (twigs.len() - middle) as u32;
        Self { bounds, first: 0, len: 0, shift: 0, right, costs }
    }

    /// Whether it is a leaf.
    pub fn is_leaf(&self) -> bool {
        self.right == 0
    }
}

/// The tree over two trees.
pub fn join(mut left: Vec<Twig>, mut right: Vec<Twig>, bounds: Lanes) -> Vec<Twig> {
    let middle = left.len();
    left.append(&mut right);
    left.push(Twig::over(&left, middle, bounds));
    left
}

/// The least cost of two sides with so many children together, and how many of those are the left
/// side's.
fn share(left: &Costs, right: &Costs, children: usize) -> (f32, usize) {
    let mut best = (f32::INFINITY, 1);
    for of_left in 1..children {
        let cost = left[of_left - 1] + right[children - of_left - 1];
        best = if cost < best.0 { (cost, of_left) } else { best };
    }
    best
}

/// The binary nodes that are the children of a wide one.
pub struct Children {
    twigs: [u32; WIDTH],
    len: usize,
}

impl Children {
    /// Those of the wide node at a binary one.
    pub fn of(twigs: &[Twig], at: usize) -> Self {
        let mut children = Self { twigs: [0; WIDTH], len: 0 };
        if twigs[at].is_leaf() {
            children.push(at);
        } else {
            children.divide(twigs, at, WIDTH);
        }
        children
    }

    /// Lets at most so many stand for both sides of a node.
    fn divide(&mut self, twigs: &[Twig], at: usize, most: usize) {
        let (left, right) = (at - 1 - twigs[at].right as usize, at - 1);
        let (_, of_left) = share(&twigs[left].costs, &twigs[right].costs, most);
        self.take(twigs, left, of_left);
        self.take(twigs, right, most - of_left);
    }

    /// Lets at most so many stand for a node.
    fn take(&mut self, twigs: &[Twig], at: usize, most: usize) {
        let costs = &twigs[at].costs;
        // As few as cost no more.
        let fewest = (1..=most).find(|n| costs[n - 1] <= costs[most - 1]).unwrap_or(most);
        if fewest == 1 {
            self.push(at);
        } else {
            self.divide(twigs, at, fewest);
        }
    }

    fn push(&mut self, at: usize) {
        self.twigs[self.len] = at as u32;
        self.len += 1;
    }

    /// Their places.
    pub fn iter(&self) -> impl Iterator<Item = usize> {
        self.twigs[..self.len].iter().map(|at| *at as usize)
    }

    /// The same, to be put in order.
    pub fn as_mut_slice(&mut self) -> &mut [u32] {
        &mut self.twigs[..self.len]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A leaf with a box of this half surface.
    fn leaf(area: f32) -> Twig {
        let mut set = Set::EMPTY;
        set.bounds = [0.0, 0.0, 0.0, 0.0, area, 1.0, 0.0, 0.0];
        Twig::leaf(&set)
    }

    fn tree(depth: usize, seed: &mut u32) -> Vec<Twig> {
        *seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let size = (*seed >> 20) as f32;
        if depth == 0 || *seed >> 8 & 3 == 0 {
            return vec![leaf(size)];
        }
        let (left, right) = (tree(depth - 1, seed), tree(depth - 1, seed));
        let area = half_area(&left[left.len() - 1].bounds) + half_area(&right[right.len() - 1].bounds);
        join(left, right, leaf(area * 0.75 + size * 0.1).bounds)
    }

    /// What the wide tree that was chosen costs.
    fn cost(twigs: &[Twig], at: usize) -> f64 {
        let area = f64::from(half_area(&twigs[at].bounds));
        let below: f64 = match twigs[at].is_leaf() {
            true => 0.0,
            false => Children::of(twigs, at).iter().map(|child| cost(twigs, child)).sum(),
        };
        area + below
    }

    /// The least that standing for a node with at most so many children costs, tried out.
    fn least(twigs: &[Twig], at: usize, most: usize) -> f64 {
        let area = f64::from(half_area(&twigs[at].bounds));
        if twigs[at].is_leaf() {
            return area;
        }
        let (left, right) = (at - 1 - twigs[at].right as usize, at - 1);
        let divided = |n: usize| {
            (1..n).map(|k| least(twigs, left, k) + least(twigs, right, n - k)).fold(f64::INFINITY, f64::min)
        };
        (2..=most).map(divided).fold(area + divided(WIDTH), f64::min)
    }

    #[test]
    fn a6t2_no_other_wide_tree_is_cheaper() {
        let mut seed = 1;
        let mut wide = 0;
        for _ in 0..20 {
            let twigs = tree(4, &mut seed);
            let root = twigs.len() - 1;
            let (found, least) = (cost(&twigs, root), least(&twigs, root, 1));
            assert!((found - least).abs() <= least * 1e-5, "{found} {least}");
            wide += usize::from(twigs.len() > 15);
        }
        assert!(wide > 3, "some trees need more than one wide node");
    }
}
