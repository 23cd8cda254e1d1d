//! The binary tree that the wide one is made from.

use super::split::{Item, best_cut};
use common::math::{Bounds, Vec3};

/// Below this depth sets are halved by number, which ends after at most 32 more levels.
const DEEP: u32 = 60;

/// Subtrees with fewer items are built by one thread.
const WORTH_A_THREAD: usize = 4096;

/// A node; leaves refer to a run of items.
#[derive(Clone, Copy, Debug)]
pub struct BinaryNode {
    /// The box of everything below.
    pub bounds: Bounds,
    /// Number of items if a leaf, else 0.
    pub count: u32,
    /// First item if a leaf, else the left child's node.
    pub first: u32,
    /// The right child's node if not a leaf.
    pub second: u32,
}

impl Default for BinaryNode {
    fn default() -> Self {
        Self { bounds: Bounds::EMPTY, count: 0, first: 0, second: 0 }
    }
}

/// A binary hierarchy over boxes.
pub struct Binary {
    /// Nodes; the root is the first. Slots between subtrees may be unused.
    pub nodes: Vec<BinaryNode>,
    /// Items, permuted so that leaves are runs.
    pub items: Vec<Item>,
}

impl Binary {
    /// Builds over at least one box; the same tree whatever the number of threads. `block` is
    /// how many items a leaf tests at the price of one, and the most a leaf holds unless the
    /// boxes cannot be told apart.
    ///
    /// # Panics
    /// If `boxes` is empty.
    pub fn build(boxes: Vec<Bounds>, block: usize) -> Self {
        assert!(!boxes.is_empty(), "a tree needs something to hold");
        let number = |(index, bounds): (usize, Bounds)| Item { bounds, index: index as u32 };
        let mut items: Vec<Item> = boxes.into_iter().enumerate().map(number).collect();
        let mut nodes = vec![BinaryNode::default(); 2 * items.len() - 1];
        let (bounds, centers) = measure(&items);
        let task = Task { node: 0, first: 0, bounds, centers, block, depth: 0 };
        build(task, &mut items, &mut nodes);
        Self { nodes, items }
    }
}

/// Builds the subtree of a run of items into its own 2n − 1 nodes.
#[derive(Clone, Copy)]
struct Task {
    /// Number of the subtree's first node.
    node: usize,
    /// Number of the first item.
    first: usize,
    bounds: Bounds,
    /// The box of the items' doubled centres.
    centers: Bounds,
    block: usize,
    depth: u32,
}

fn measure(items: &[Item]) -> (Bounds, Bounds) {
    items.iter().fold((Bounds::EMPTY, Bounds::EMPTY), |(bounds, centers), item| {
        let c: Vec3 = item.center2();
        (bounds.union(&item.bounds), Bounds { min: centers.min.min(c), max: centers.max.max(c) })
    })
}

fn build(task: Task, items: &mut [Item], nodes: &mut [BinaryNode]) {
    let leaf =
        BinaryNode { bounds: task.bounds, count: items.len() as u32, first: task.first as u32, second: 0 };
    let Some(middle) = cut(&task, items) else {
        nodes[0] = leaf;
        return;
    };
    let (left, right) = items.split_at_mut(middle);
    let (own, below) = nodes.split_first_mut().expect("a subtree has a node");
    let (left_nodes, right_nodes) = below.split_at_mut(2 * middle - 1);
    let child = |node: usize, first: usize, items: &[Item]| {
        let (bounds, centers) = measure(items);
        Task { node, first, bounds, centers, block: task.block, depth: task.depth + 1 }
    };
    let left_task = child(task.node + 1, task.first, left);
    let right_task = child(task.node + 2 * middle, task.first + middle, right);
    *own = BinaryNode {
        bounds: task.bounds,
        count: 0,
        first: left_task.node as u32,
        second: right_task.node as u32,
    };
    let parallel = left.len().min(right.len()) >= WORTH_A_THREAD;
    let mut build_left = || build(left_task, left, left_nodes);
    let mut build_right = || build(right_task, right, right_nodes);
    if parallel {
        rayon::join(build_left, build_right);
    } else {
        build_left();
        build_right();
    }
}

/// Sorts the items into two sides and returns the size of the left one; `None` makes a leaf.
fn cut(task: &Task, items: &mut [Item]) -> Option<usize> {
    // A block costs what a node costs, so splitting one never pays.
    if items.len() <= task.block {
        return None;
    }
    let half = Some(items.len() / 2);
    if task.depth >= DEEP {
        return half;
    }
    // Without a cut all centres are one point: no plane tells the items apart, and halving them
    // keeps the tree balanced.
    let Some(cut) = best_cut(items, &task.centers, task.block as f32) else { return half };
    let left = partition(items, |item| cut.is_left(item));
    if left > 0 && left < items.len() { Some(left) } else { half }
}

/// Moves the items that `is_left` to the front, keeping nothing else in order.
fn partition(items: &mut [Item], is_left: impl Fn(&Item) -> bool) -> usize {
    let (mut low, mut high) = (0, items.len());
    while low < high {
        if is_left(&items[low]) {
            low += 1;
        } else {
            high -= 1;
            items.swap(low, high);
        }
    }
    low
}
