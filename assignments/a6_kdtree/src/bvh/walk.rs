//! The way through the tree, for one ray and for many, whatever is done at leaves.

use super::bundle::lanes_of;
use super::children::{first_child, nearest_child};
use super::stack::Stack;
use super::wide::{Bvh, WIDTH, WideNode};
use common::counters::Counters;
use common::simd::{Simd, SimdBase, SimdMask, f32x8};

/// Who goes through the tree: one ray, or several behind one frustum.
pub trait Way<S: Simd> {
    /// A bit for every axis along which it goes towards smaller coordinates.
    fn backward(&self) -> u32;

    /// A bit for every child whose box may be met no later than `max`, and where it is entered.
    fn meet(&self, simd: S, node: &WideNode, max: f32, enter: &mut [f32; WIDTH]) -> u32;
}

/// What is done there.
pub trait Visit<S: Simd> {
    /// Whether of a node's children the one that is entered first comes first, at some price, and the memory is
    /// asked for all of them at once. It pays for bundles that look for first hits, whose leaves cost much and
    /// of which most children are visited. Else they come in the order of their centres.
    const BY_DISTANCE: bool = false;

    /// Looks into a child that is a leaf. Returns where the search may end: boxes that are entered
    /// later need not be looked at; −∞ if none need be.
    fn leaf(&mut self, simd: S, node: &WideNode, child: usize, counters: &mut Counters) -> f32;
}

/// Visits leaves below a node that may be met no later than `max`, near ones first by and large.
#[inline(always)]
pub fn walk<S: Simd, V: Visit<S>>(
    simd: S,
    (tree, from): (&Bvh, usize),
    stack: &mut Stack,
    mut max: f32,
    way: &impl Way<S>,
    visit: &mut V,
    c: &mut Counters,
) {
    let Some(mut node) = tree.nodes.get(from) else { return };
    let (backward, large) = (way.backward(), tree.is_large());
    stack.clear();
    let mut level = 0;
    let mut visited = 1;
    let top = stack.at(0);
    top.node = from as u32;
    let mut lanes = way.meet(simd, node, max, &mut top.enter);
    loop {
        if lanes == 0 {
            let Some(below) = stack.below(level) else { break };
            level = below;
            let top = stack.at(level);
            lanes = top.lanes & entered_before(simd, &top.enter, max);
            node = &tree.nodes[top.node as usize];
            continue;
        }
        let child = if !V::BY_DISTANCE {
            first_child(lanes, node.axis, backward)
        } else if lanes.is_power_of_two() {
            lanes.trailing_zeros() as usize % WIDTH
        } else {
            nearest_child(simd, lanes, f32x8::from_slice(simd, &stack.at(level).enter))
        };
        lanes &= !(1 << child);
        let held = node.child[child];
        if large && !V::BY_DISTANCE {
            tree.prefetch(node.child[first_child(lanes, node.axis, backward)]);
        }
        if held.is_node() {
            stack.at(level).lanes = lanes;
            level = stack.above(level, lanes != 0);
            visited += 1;
            node = &tree.nodes[held.index()];
            let top = stack.at(level);
            top.node = held.index() as u32;
            lanes = way.meet(simd, node, max, &mut top.enter);
            if large && V::BY_DISTANCE {
                lanes_of(lanes).for_each(|child| tree.prefetch(node.child[child % WIDTH]));
            }
            continue;
        }
        max = visit.leaf(simd, node, child, c);
        if max == f32::NEG_INFINITY {
            break;
        }
        lanes &= entered_before(simd, &stack.at(level).enter, max);
    }
    c.cells += visited;
}

/// A bit for every child that is entered no later than `max`.
#[inline(always)]
fn entered_before<S: Simd>(simd: S, enter: &[f32; WIDTH], max: f32) -> u32 {
    f32x8::from_slice(simd, enter).simd_le(f32x8::splat(simd, max)).to_bitmask() as u32
}
