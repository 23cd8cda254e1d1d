//! The way through the tree, for one ray and for many, whatever is done at leaves.

use super::packet::first_child;
use super::stack::{Stack, Waiting};
use super::wide::{Bvh, Held, WIDTH, WideNode};
use common::counters::Counters;
use common::simd::{Simd, SimdBase, SimdMask, f32x8};

/// Who goes through the tree.
pub trait Visit {
    /// A bit for every axis along which it goes towards smaller coordinates.
    fn backward(&self) -> u32;

    /// A bit for every child whose box may be met no later than `max`, and where it is entered.
    fn meet<S: Simd>(&self, simd: S, node: &WideNode, max: f32, enter: &mut [f32; WIDTH]) -> u32;

    /// Looks into a child that is a leaf. Returns where the search may end: boxes that are entered
    /// later need not be looked at; −∞ if none need be.
    fn leaf<S: Simd>(&mut self, simd: S, node: &WideNode, child: usize, counters: &mut Counters) -> f32;
}

/// Visits leaves that may be met no later than `max`, near ones first by and large.
#[inline(always)]
pub fn walk<S: Simd>(
    simd: S,
    tree: &Bvh,
    stack: &mut Stack,
    mut max: f32,
    visit: &mut impl Visit,
    c: &mut Counters,
) {
    let Some(root) = tree.nodes.first() else { return };
    let backward = visit.backward();
    stack.clear();
    let mut at = Waiting { enter: [0.0; WIDTH], node: 0, lanes: 0 };
    at.lanes = visit.meet(simd, root, max, &mut at.enter);
    c.cells += 1;
    loop {
        if at.lanes == 0 {
            let Some(next) = stack.pop() else { return };
            at = next;
            at.lanes &= entered_before(simd, &at.enter, max);
            continue;
        }
        let node = &tree.nodes[at.node];
        let child = first_child(at.lanes, node.axis, backward);
        at.lanes &= !(1 << child);
        if tree.is_large() {
            tree.prefetch(node.child[first_child(at.lanes, node.axis, backward)]);
        }
        if let Held::Node(below) = node.child[child].held() {
            stack.push(&at);
            c.cells += 1;
            at.node = below;
            at.lanes = visit.meet(simd, &tree.nodes[below], max, &mut at.enter);
            continue;
        }
        max = visit.leaf(simd, node, child, c);
        if max == f32::NEG_INFINITY {
            return;
        }
        at.lanes &= entered_before(simd, &at.enter, max);
    }
}

/// A bit for every child that is entered no later than `max`.
#[inline(always)]
fn entered_before<S: Simd>(simd: S, enter: &[f32; WIDTH], max: f32) -> u32 {
    f32x8::from_slice(simd, enter).simd_le(f32x8::splat(simd, max)).to_bitmask() as u32
}
