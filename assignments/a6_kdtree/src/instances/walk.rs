//! One ray through one tree, with something else at the leaves than [`crate::bvh::Bvh`] has.

use crate::bvh::Bvh;
use crate::bvh::packet::{Packet, first_child};
use crate::bvh::single::entered_before;
use crate::bvh::stack::{Stack, Waiting};
use crate::bvh::wide::{Held, WIDTH};
use common::counters::Counters;
use common::math::Interval;
use common::simd::Simd;

/// What is done at leaves.
pub trait Visit {
    /// Looks into a leaf. Returns where the search may end: boxes that are entered later need not
    /// be looked at; −∞ if none need be.
    fn leaf<S: Simd>(&mut self, simd: S, held: Held, counters: &mut Counters) -> f32;
}

/// Visits leaves that the ray may meet inside the stretch, near ones first by and large.
#[inline(always)]
pub fn walk<S: Simd>(
    simd: S,
    tree: &Bvh,
    packet: &Packet<1>,
    stretch: Interval,
    visit: &mut impl Visit,
    c: &mut Counters,
) {
    if tree.nodes.is_empty() {
        return;
    }
    let mut stack = Stack::new();
    let mut max = stretch.max;
    let mut at = Waiting { enter: [0.0; WIDTH], node: 0, lanes: 0 };
    at.lanes = packet.meet(simd, 0, &tree.nodes[0], stretch, &mut at.enter);
    c.cells += 1;
    loop {
        if at.lanes == 0 {
            let Some(next) = stack.pop() else { return };
            at = next;
            at.lanes &= entered_before(simd, &at.enter, max);
            continue;
        }
        let node = &tree.nodes[at.node];
        let child = first_child(at.lanes, node.axis, packet.backward[0]);
        at.lanes &= !(1 << child);
        match node.child[child].held() {
            Held::Node(below) => {
                stack.push(&at);
                c.cells += 1;
                at.node = below;
                let stretch = Interval { max, ..stretch };
                at.lanes = packet.meet(simd, 0, &tree.nodes[below], stretch, &mut at.enter);
            }
            leaf => {
                max = visit.leaf(simd, leaf, c);
                if max == f32::NEG_INFINITY {
                    return;
                }
                at.lanes &= entered_before(simd, &at.enter, max);
            }
        }
    }
}
