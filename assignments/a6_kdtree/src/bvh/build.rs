//! Growing the tree.
//!
//! First a binary tree, from the root down, by cutting sets in two; then the wide one that
//! [`super::collapse`] finds in it.

use super::balls::Balls;
use super::collapse::{Children, Twig, join};
use super::set::{Desk, Set};
use super::split::{Item, Lanes};
use super::wide::{Bvh, Child, EMPTY_NODE, WideNode};
use common::geometry::{Geometry, Solid};
use common::math::{Bounds, Vec3};
use common::shape::triangle_block::{LANES, TriangleBlock};
use rayon::prelude::*;
use std::sync::OnceLock;

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
        let balls = Balls::of(geometry);
        let solids = if balls.is_empty() { geometry.solids() } else { &[] };
        Self { balls, ..Self::grow(geometry, items(geometry, solids), (solids.len(), 2), numbered) }
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
        // What is in it is not all of the scene, or not in the world.
        let horizons = OnceLock::from(None);
        Self { horizons, ..Self::grow(geometry, items, (solids.len(), most), numbered) }
    }

    /// Of the items so many are solids, which come first.
    fn grow(
        geometry: &'g Geometry,
        mut items: Vec<Item>,
        (solids, most): (usize, usize),
        numbered: impl Fn(u32) -> (u32, [Vec3; 3]) + Sync,
    ) -> Self {
        assert!(items.len() < 1 << 26, "at most 2^26 primitives");
        let mut bounds = Bounds::EMPTY;
        let mut sets = Vec::new();
        for (first, end, shift) in [(solids, items.len(), BLOCK_SHIFT), (0, solids, most.ilog2())] {
            if first < end {
                let set = Set::all(&items[first..end], first, shift);
                bounds = bounds.union(&bounds_of(&set.bounds));
                sets.push(set);
            }
        }
        let mut order = vec![0; items.len()];
        let mut spare = items.clone();
        let mut desk = Desk { items: [&mut items, &mut spare], order: &mut order, first: 0 };
        let twigs = sets.into_iter().map(|set| twigs(set, &mut desk)).reduce(|a, b| {
            let bounds = union(&a[a.len() - 1].bounds, &b[b.len() - 1].bounds);
            join(a, b, bounds)
        });
        let mut part = Part::default();
        if let Some(twigs) = twigs {
            part.add(&twigs, twigs.len() - 1, 1);
        }
        let pack = |&(first, len): &(u32, u32)| {
            let triangles = &order[first as usize..(first + len) as usize];
            TriangleBlock::pack(triangles.iter().map(|i| numbered(*i)))
        };
        let blocks = part.leaves.par_iter().with_min_len(256).map(pack).collect();
        order.truncate(solids);
        let solids = order;
        let (balls, horizons) = (Balls::NONE, OnceLock::new());
        Self { geometry, nodes: part.nodes, blocks, solids, balls, bounds, depth: part.depth, horizons }
    }
}

/// These solids and all triangles; each kind numbered by itself.
fn items(geometry: &Geometry, solids: &[Solid]) -> Vec<Item> {
    let triangles = geometry.triangles();
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

/// The box around two boxes.
fn union(a: &Lanes, b: &Lanes) -> Lanes {
    std::array::from_fn(|i| if a[i] > b[i] { a[i] } else { b[i] })
}

/// The binary tree over a set, as long as that is cheap to do by one thread.
fn twigs(set: Set, desk: &mut Desk) -> Vec<Twig> {
    if (set.len as usize) < WORTH_A_THREAD {
        let mut twigs = Vec::new();
        grow(set, desk, &mut twigs);
        return twigs;
    }
    let sides = set.cut(desk);
    let mut desks = desk.share(sides.iter()).into_iter();
    let (Some(mut left), Some(mut right)) = (desks.next(), desks.next()) else {
        unreachable!("one for each")
    };
    let (a, b) = rayon::join(|| twigs(sides[0], &mut left), || twigs(sides[1], &mut right));
    join(a, b, set.bounds)
}

/// Adds the binary tree over a set to what is there.
fn grow(set: Set, desk: &mut Desk, twigs: &mut Vec<Twig>) {
    if set.is_leaf() {
        set.settle(desk);
        twigs.push(Twig::leaf(&set));
        return;
    }
    let [left, right] = set.cut(desk);
    grow(left, desk, twigs);
    let end_of_left = twigs.len();
    grow(right, desk, twigs);
    twigs.push(Twig::over(twigs, end_of_left, set.bounds));
}

/// The wide tree as far as it is made.
#[derive(Default)]
struct Part {
    nodes: Vec<WideNode>,
    /// Runs of triangles that make a block.
    leaves: Vec<(u32, u32)>,
    depth: usize,
}

impl Part {
    /// Adds the wide node at a binary one, and what is below it.
    fn add(&mut self, twigs: &[Twig], at: usize, depth: usize) {
        self.depth = self.depth.max(depth);
        let mut children = Children::of(twigs, at);
        let axis = put_in_order(twigs, children.as_mut_slice());
        let mut node = WideNode { axis: axis as u32, ..EMPTY_NODE };
        for (lane, child) in children.iter().map(|child| &twigs[child]).enumerate() {
            node.set_box(lane, &bounds_of(&child.bounds));
            if child.is_leaf() {
                node.child[lane] = self.leaf(child);
            }
        }
        let place = self.nodes.len();
        self.nodes.push(node);
        for (lane, child) in children.iter().enumerate().filter(|(_, child)| !twigs[*child].is_leaf()) {
            self.nodes[place].child[lane] = Child::node(self.nodes.len());
            self.add(twigs, child, depth + 1);
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

/// Sorts children along the axis in which their centres differ most, and names it.
fn put_in_order(twigs: &[Twig], children: &mut [u32]) -> usize {
    let center = |child: &u32| {
        let bounds = &twigs[*child as usize].bounds;
        [0, 1, 2].map(|axis| bounds[4 + axis] - bounds[axis])
    };
    let centers = children.iter().map(|child| Vec3::from_array(center(child)));
    let axis = Bounds::of_points(centers).longest_axis();
    children.sort_by(|a, b| center(a)[axis].total_cmp(&center(b)[axis]));
    axis
}
