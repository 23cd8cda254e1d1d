//! Growing the wide tree from the root down.
//!
//! A node's largest set is cut in two until there are eight: what collapsing a binary tree gives
//! (Wald, Benthin & Boulos 2008), without the binary tree.

use super::collapse::{Twig, children, join};
use super::set::{Desk, Set};
use super::split::{Item, Lanes};
use super::wide::{Bvh, Child, EMPTY_NODE, WIDTH, WideNode};
use common::geometry::Geometry;
use common::math::{Bounds, Vec3};
use common::shape::triangle_block::{LANES, TriangleBlock};
use rayon::prelude::*;

/// Nodes over fewer items are built by one thread.
const WORTH_A_THREAD: usize = 8192;

/// log₂ of the most triangles in a leaf; of solids there are fewer.
const BLOCK_SHIFT: u32 = LANES.trailing_zeros();

impl<'g> Bvh<'g> {
    /// Builds the hierarchy; the same whatever the number of threads.
    ///
    /// # Panics
    /// If there are 2²⁶ finite primitives or more.
    pub fn new(geometry: &'g Geometry) -> Self {
        let (numbers, vertices) = (geometry.triangle_numbers(), geometry.triangles());
        let numbered = |i: u32| (numbers[i as usize], vertices[i as usize]);
        Self::grow(geometry, items(geometry), (geometry.solids().len(), 2), numbered)
    }

    /// Builds over boxes of triangles, of which `numbered` knows number and corners, and of
    /// something else, called solids here, at most one or two to a leaf unless they coincide.
    pub(crate) fn over(
        geometry: &'g Geometry,
        triangles: Vec<Bounds>,
        (solids, most): (Vec<Bounds>, usize),
        numbered: impl Fn(u32) -> (u32, [Vec3; 3]) + Sync,
    ) -> Self {
        let numbers = (0..solids.len() as u32).chain(0..triangles.len() as u32);
        let boxes = solids.iter().chain(&triangles);
        let items = boxes.zip(numbers).map(|(bounds, number)| Item::new(bounds, number)).collect();
        Self::grow(geometry, items, (solids.len(), most), numbered)
    }

    /// Of the items so many are solids, which come first.
    fn grow(
        geometry: &'g Geometry,
        mut items: Vec<Item>,
        (solids, most): (usize, usize),
        numbered: impl Fn(u32) -> (u32, [Vec3; 3]) + Sync,
    ) -> Self {
        assert!(items.len() < 1 << 26, "at most 2^26 primitives");
        let mut group = Group::EMPTY;
        let mut bounds = Bounds::EMPTY;
        for (first, end, shift) in [(solids, items.len(), BLOCK_SHIFT), (0, solids, most.ilog2())] {
            if first < end {
                let set = Set::all(&items[first..end], first, shift);
                bounds = bounds.union(&bounds_of(&set.bounds));
                group.push(set);
            }
        }
        let mut order = vec![0; items.len()];
        let mut part = Part::default();
        if group.len > 0 {
            let mut spare = items.clone();
            let mut desk = Desk { items: [&mut items, &mut spare], order: &mut order, first: 0 };
            let mut twigs = Vec::new();
            twig_of(group.sets[0], &mut desk, &mut twigs);
            if group.len > 1 {
                let right = twigs.len();
                twig_of(group.sets[1], &mut desk, &mut twigs);
                let right = twigs.len() - right;
                let (a, b) = (group.sets[0].bounds, group.sets[1].bounds);
                join(&mut twigs, std::array::from_fn(|i| a[i].max(b[i])), right);
            }
            part.emit(&twigs, twigs.len() - 1, 1);
        }
        let pack = |&(first, len): &(u32, u32)| {
            let triangles = &order[first as usize..(first + len) as usize];
            TriangleBlock::pack(triangles.iter().map(|i| numbered(*i)))
        };
        let blocks = part.leaves.par_iter().with_min_len(256).map(pack).collect();
        order.truncate(solids);
        let solids = order;
        Self { geometry, nodes: part.nodes, blocks, solids, bounds, depth: part.depth }
    }
}

/// All finite primitives, solids first; each kind numbered by itself.
fn items(geometry: &Geometry) -> Vec<Item> {
    let (triangles, solids) = (geometry.triangles(), geometry.solids());
    let item = |place: usize| match place.checked_sub(solids.len()) {
        None => Item::new(&roomy(&solids[place].bounds), place as u32),
        Some(i) => {
            let [a, b, c] = triangles[i];
            Item::new(&Bounds { min: a.min(b).min(c), max: a.max(b).max(c) }, i as u32)
        }
    };
    let mut items = Vec::new();
    let places = (0..solids.len() + triangles.len()).into_par_iter();
    places.with_min_len(WORTH_A_THREAD).map(item).collect_into_vec(&mut items);
    items
}

/// The box of a round body, widened by 2⁻²² of its reach: rays that pass the body by within the
/// rounding of `f64` hit it, and must meet its box.
pub(crate) fn roomy(bounds: &Bounds) -> Bounds {
    let slack = Vec3::splat(bounds.min.abs().max(bounds.max.abs()).max_element() / (1 << 22) as f32);
    Bounds { min: bounds.min - slack, max: bounds.max + slack }
}

fn bounds_of(lanes: &Lanes) -> Bounds {
    let [x, y, z, _, to_x, to_y, to_z, _] = *lanes;
    Bounds { min: -Vec3::new(x, y, z), max: Vec3::new(to_x, to_y, to_z) }
}

/// The children of a node.
struct Group {
    sets: [Set; WIDTH],
    len: usize,
}

impl Group {
    const EMPTY: Self = Self { sets: [Set::EMPTY; WIDTH], len: 0 };

    fn push(&mut self, set: Set) {
        self.sets[self.len] = set;
        self.len += 1;
    }

    fn of(set: Set) -> Self {
        let mut group = Self::EMPTY;
        group.push(set);
        group
    }

    /// The sets that are no leaves, with their places.
    fn inner(&self) -> impl Iterator<Item = (usize, &Set)> {
        self.sets().iter().enumerate().filter(|(_, set)| !set.is_leaf())
    }

    fn sets(&self) -> &[Set] {
        &self.sets[..self.len]
    }

    /// Cuts the largest set until there are eight, or only leaves.
    fn open(&mut self, desk: &mut Desk) {
        while self.len < WIDTH {
            let inner = (0..self.len).filter(|i| !self.sets[*i].is_leaf());
            let larger = |a: usize, b: usize| if self.sets[b].area > self.sets[a].area { b } else { a };
            let Some(largest) = inner.reduce(larger) else { break };
            let [left, right] = self.sets[largest].cut(desk);
            self.sets[largest] = left;
            self.push(right);
        }
    }

    /// Sorts the sets along the axis in which their centres differ most, and names it.
    fn put_in_order(&mut self) -> usize {
        let center = |set: &Set| [0, 1, 2].map(|axis| set.bounds[4 + axis] - set.bounds[axis]);
        let spread = Bounds::of_points(self.sets().iter().map(|s| Vec3::from_array(center(s)))).size();
        let axis = (0..3).fold(0, |best, axis| if spread[axis] > spread[best] { axis } else { best });
        self.sets[..self.len].sort_by(|a, b| center(a)[axis].total_cmp(&center(b)[axis]));
        axis
    }
}

/// A part of the tree: its numbers of nodes and leaves count from its own first.
#[derive(Default)]
struct Part {
    nodes: Vec<WideNode>,
    /// Runs of triangles that make a block.
    leaves: Vec<(u32, u32)>,
    depth: usize,
}

impl Part {
    /// Adds a wide node.
    fn emit(&mut self, twigs: &[Twig], of: usize, depth: usize) {
        self.depth = self.depth.max(depth);
        let (mut found, len) = children(twigs, of);
        let found = &mut found[..len];
        let center = |&t: &usize| [0, 1, 2].map(|axis| twigs[t].bounds[4 + axis] - twigs[t].bounds[axis]);
        let spread = Bounds::of_points(found.iter().map(|t| Vec3::from_array(center(t)))).size();
        let axis = (0..3).fold(0, |best, axis| if spread[axis] > spread[best] { axis } else { best });
        found.sort_by(|a, b| center(a)[axis].total_cmp(&center(b)[axis]));
        let mut node = WideNode { axis: axis as u32, ..EMPTY_NODE };
        for (lane, &t) in found.iter().enumerate() {
            node.set_box(lane, &bounds_of(&twigs[t].bounds));
            if twigs[t].is_leaf() {
                node.child[lane] = self.leaf(&twigs[t]);
            }
        }
        let place = self.nodes.len();
        self.nodes.push(node);
        for (lane, &t) in found.iter().enumerate() {
            if !twigs[t].is_leaf() {
                self.nodes[place].child[lane] = Child::node(self.nodes.len());
                self.emit(twigs, t, depth + 1);
            }
        }
    }

    fn leaf(&mut self, twig: &Twig) -> Child {
        if twig.shift != BLOCK_SHIFT {
            return Child::solids(twig.first as usize, twig.len as usize);
        }
        self.leaves.push((twig.first, twig.len));
        Child::block(self.leaves.len() - 1, twig.len as usize)
    }
}

/// The binary tree over a set, after what is there.
fn twig_of(set: Set, desk: &mut Desk, twigs: &mut Vec<Twig>) {
    if set.is_leaf() {
        set.settle(desk);
        twigs.push(Twig::leaf(set.bounds, set.first, set.len, set.shift));
        return;
    }
    let [left, right] = set.cut(desk);
    twig_of(left, desk, twigs);
    let before = twigs.len();
    twig_of(right, desk, twigs);
    let right = twigs.len() - before;
    join(twigs, set.bounds, right);
}
