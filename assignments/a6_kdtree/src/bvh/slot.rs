//! A ray under way, and what waits for it.

use super::beam::Beam;
use super::bundle::MOST;
use super::children::{first_child, nearest_child};
use super::packet::Packet;
use super::purpose::Purpose;
use super::single::limit;
use super::stack::Waiting;
use super::wide::{Child, WideNode};
use common::shape::filter::{Errors, Filter};
use common::simd::{Simd, SimdBase, SimdMask, f32x8};

/// Nodes that can wait, one more than levels that a tree may have; a power of two.
const LEVELS: usize = 16;

/// Depth of the deepest tree that rays can be followed through in slots.
pub const DEEPEST: usize = LEVELS - 1;

/// A ray that takes a step now and then, with all that it needs for that.
#[repr(align(64))]
pub struct Slot {
    /// Nodes on the way down that have children waiting.
    stack: [Waiting; LEVELS],
    /// The last of them.
    level: usize,
    beam: Beam,
    /// Boxes that are entered later do not matter …
    max: f32,
    /// … which is hits by so much of t before.
    margin: f32,
    /// Hits later than this do not matter.
    pub last: f32,
    /// What is looked at next.
    pub next: Child,
    /// Number of the ray.
    pub ray: usize,
    /// The ray, prepared for triangles.
    pub filter: Filter,
}

impl Slot {
    /// No ray.
    pub const EMPTY: Self = Self {
        stack: [Waiting::NONE; LEVELS],
        level: 0,
        beam: Beam::NONE,
        max: 0.0,
        margin: 0.0,
        last: 0.0,
        next: Child::NOTHING,
        ray: 0,
        filter: Filter {
            origin: [0.0; 3],
            direction: [0.0; 3],
            errors: Errors { reach: 0.0, weight: 0.0, along: 0.0, depth: 0.0, floor: 0.0 },
        },
    };

    /// Sends a ray of a packet to the root. Hits later than `last` do not matter.
    #[inline(always)]
    pub fn start(&mut self, packet: &Packet<MOST>, lane: usize, ray: usize, last: f32) {
        self.beam = packet.beam(lane);
        self.margin = packet.margin(lane);
        self.filter = packet.filter(lane);
        self.ray = ray;
        self.next = Child::node(0);
        // What waited for the ray before waits no longer.
        self.level = 0;
        self.stack[0].lanes = 0;
        self.end_at(last);
    }

    /// Hits later than `last` do not matter from now on.
    #[inline(always)]
    pub fn end_at(&mut self, last: f32) {
        self.last = last;
        self.max = limit(last, self.margin);
    }

    /// Looks into the node that is next. False if nothing is left after that.
    #[inline(always)]
    pub fn enter<S: Simd, P: Purpose>(&mut self, simd: S, nodes: &[WideNode], min: f32) -> bool {
        let index = self.next.index();
        let node = &nodes[index];
        let (enter, lanes) = self.beam.spread(simd, min).boxes(simd, node, self.max);
        if lanes == 0 {
            return self.pop::<S, P>(simd, nodes);
        }
        // The node below stays only if children of it wait.
        self.level += usize::from(self.stack[self.level % LEVELS].lanes != 0);
        let top = &mut self.stack[self.level % LEVELS];
        enter.store_slice(&mut top.enter);
        top.node = index as u32;
        self.take_child::<S, P>(simd, node, lanes, enter);
        true
    }

    /// Takes what is next from what waits. False if nothing does.
    #[inline(always)]
    pub fn pop<S: Simd, P: Purpose>(&mut self, simd: S, nodes: &[WideNode]) -> bool {
        let max = f32x8::splat(simd, self.max);
        loop {
            let top = &self.stack[self.level % LEVELS];
            let enter = f32x8::from_slice(simd, &top.enter);
            let lanes = top.lanes & enter.simd_le(max).to_bitmask() as u32;
            if lanes != 0 {
                self.take_child::<S, P>(simd, &nodes[top.node as usize], lanes, enter);
                return true;
            }
            if self.level == 0 {
                return false;
            }
            self.level -= 1;
        }
    }

    /// Makes one of the last node's children, which are `lanes`, the next; see [`Purpose::BY_DISTANCE`].
    #[inline(always)]
    fn take_child<S: Simd, P: Purpose>(&mut self, simd: S, node: &WideNode, lanes: u32, enter: f32x8<S>) {
        let child = if P::BY_DISTANCE {
            nearest_child(simd, lanes, enter)
        } else {
            first_child(lanes, node.axis, self.beam.backward)
        };
        self.next = node.child[child];
        self.stack[self.level % LEVELS].lanes = lanes & !(1 << child);
    }
}
