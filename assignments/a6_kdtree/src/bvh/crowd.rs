//! Rays that go their own ways, a step of each in turn.
//!
//! A ray alone waits for memory and guesses badly what comes next. Here all rays that are at a
//! node take their step, then all that are at a leaf, so that no branch asks which it is, and
//! the steps of different rays run into each other.

use super::packet::{Packet, RAYS, first_child};
use super::single::limit;
use super::stack::Waiting;
use super::wide::{Bvh, Child, Held, WIDTH, WideNode};
use common::accel::Job;
use common::counters::Counters;
use common::geometry::Hit;
use common::math::Interval;
use common::ray::Ray;
use common::shape::filter::{Errors, Filter};
use common::simd::{Simd, SimdBase, SimdFloat, SimdMask, f32x8};

/// Rays under way at a time.
const SLOTS: usize = 16;
const PRE: bool = false;

/// Levels below the root that a ray can keep; deeper trees are asked one ray at a time.
pub const LEVELS: usize = 16;

/// A ray under way.
#[repr(align(64))]
struct Slot {
    inverse: [f32; 3],
    near_offset: [f32; 3],
    far_offset: [f32; 3],
    backward: u32,
    /// Which side comes first, by axis.
    near: [u32; 3],
    /// Boxes that are entered later do not matter.
    max: f32,
    margin: f32,
    /// What is looked at next.
    next: Child,
    /// Place in the caller's slice.
    ray: usize,
    /// Hits later than this do not matter.
    last: f32,
    filter: Filter,
    /// Entries of the stack above the first, which is always empty.
    level: usize,
    stack: [Waiting; LEVELS],
}

const NOTHING: Waiting = Waiting::NONE;

impl Slot {
    const EMPTY: Self = Self {
        inverse: [0.0; 3],
        near_offset: [0.0; 3],
        far_offset: [0.0; 3],
        backward: 0,
        near: [0; 3],
        max: 0.0,
        margin: 0.0,
        next: Child::NOTHING,
        ray: 0,
        last: 0.0,
        filter: Filter {
            origin: [0.0; 3],
            direction: [0.0; 3],
            errors: Errors { reach: 0.0, weight: 0.0, along: 0.0, depth: 0.0, floor: 0.0 },
        },
        level: 0,
        stack: [NOTHING; LEVELS],
    };

    /// Sends a ray of a packet off, to the root.
    #[inline(always)]
    fn start(&mut self, packet: &Packet, lane: usize, ray: usize, last: f32) {
        for axis in 0..3 {
            self.inverse[axis] = packet.inverse[axis][lane];
            self.near_offset[axis] = packet.near_offset[axis][lane];
            self.far_offset[axis] = packet.far_offset[axis][lane];
        }
        self.backward = packet.backward[lane];
        self.near = [self.backward & 1, self.backward >> 1 & 1, self.backward >> 2 & 1];
        self.stack[0].lanes = 0;
        self.margin = packet.margin(lane);
        self.filter = packet.filter(lane);
        self.ray = ray;
        self.last = last;
        self.max = limit(last, self.margin);
        self.next = Child::node(0);
        self.level = 0;
    }

    /// Asks which children of a node are met.
    #[inline(always)]
    fn meet<S: Simd>(&self, simd: S, node: &WideNode, min: f32) -> (f32x8<S>, u32) {
        let mut near = f32x8::splat(simd, min);
        let mut far = f32x8::splat(simd, self.max);
        for axis in 0..3 {
            let inverse = f32x8::splat(simd, self.inverse[axis]);
            let sides = &node.side[axis];
            let first = (self.near[axis] & 1) as usize;
            let first_side = f32x8::from_slice(simd, &sides[first]);
            let last_side = f32x8::from_slice(simd, &sides[first ^ 1]);
            near = near.max(first_side.mul_sub(inverse, f32x8::splat(simd, self.near_offset[axis])));
            far = far.min(last_side.mul_sub(inverse, f32x8::splat(simd, self.far_offset[axis])));
        }
        (near, near.simd_le(far).to_bitmask() as u32)
    }

    /// Looks into a node. False if there is nothing left to look at.
    #[inline(always)]
    fn enter<S: Simd>(&mut self, simd: S, nodes: &[WideNode], min: f32) -> bool {
        let index = self.next.index();
        let node = &nodes[index];
        let (near, lanes) = self.meet(simd, node, min);
        if lanes == 0 {
            return self.pop(simd, nodes);
        }
        let level = self.level + usize::from(self.stack[self.level % LEVELS].lanes != 0);
        self.level = level;
        let top = &mut self.stack[level % LEVELS];
        near.store_slice(&mut top.enter);
        top.node = index as u32;
        let child = first_child(lanes, node.axis, self.backward);
        top.lanes = lanes & !(1 << child);
        self.next = node.child[child];
        true
    }

    /// Takes what comes next from the stack; false if there is nothing left.
    #[inline(always)]
    fn pop<S: Simd>(&mut self, simd: S, nodes: &[WideNode]) -> bool {
        let mut level = self.level;
        let max = f32x8::splat(simd, self.max);
        loop {
            let top = &mut self.stack[level % LEVELS];
            let lanes = top.lanes & f32x8::from_slice(simd, &top.enter).simd_le(max).to_bitmask() as u32;
            if lanes != 0 {
                let node = &nodes[top.node as usize];
                let child = first_child(lanes, node.axis, self.backward);
                top.lanes = lanes & !(1 << child);
                self.next = node.child[child];
                self.level = level;
                return true;
            }
            if level == 0 {
                return false;
            }
            level -= 1;
        }
    }
}

/// Slots, in some order.
#[derive(Clone, Copy)]
struct Line {
    slots: [u8; SLOTS],
    len: usize,
}

impl Line {
    const EMPTY: Self = Self { slots: [0; SLOTS], len: 0 };

    /// Adds one, perhaps.
    #[inline(always)]
    fn push_if(&mut self, yes: bool, slot: u8) {
        self.slots[self.len % SLOTS] = slot;
        self.len += usize::from(yes);
    }

    #[inline(always)]
    fn iter(&self) -> impl Iterator<Item = u8> {
        self.slots[..self.len.min(SLOTS)].iter().copied()
    }
}

/// What rays are followed for.
pub trait Purpose {
    /// Whether a ray need not be followed.
    fn is_settled(&self, ray: usize) -> bool;

    /// Hits of a ray later than this do not matter.
    fn last(&self, ray: usize) -> f32;

    /// Looks into a leaf. Returns until where hits matter from now on; −∞ if none do.
    #[allow(clippy::too_many_arguments)]
    fn leaf<S: Simd>(
        &mut self,
        simd: S,
        bvh: &Bvh,
        held: Held,
        job: &Job,
        ray: usize,
        last: f32,
        c: &mut Counters,
    ) -> f32;

    /// Follows a bundle.
    fn together<S: Simd>(&mut self, simd: S, bvh: &Bvh, packet: &Packet, first: usize, asked: u32, c: &mut Counters) -> bool;
}

pub struct Nearest<'a> {
    pub rays: &'a [Ray],
    pub interval: Interval,
    pub best: &'a mut [Option<Hit>],
}

impl Purpose for Nearest<'_> {
    #[inline(always)]
    fn is_settled(&self, _: usize) -> bool {
        false
    }

    #[inline(always)]
    fn last(&self, ray: usize) -> f32 {
        self.best[ray].map_or(self.interval.max, |b| b.t)
    }

    #[inline(always)]
    fn leaf<S: Simd>(
        &mut self,
        simd: S,
        bvh: &Bvh,
        held: Held,
        job: &Job,
        ray: usize,
        last: f32,
        c: &mut Counters,
    ) -> f32 {
        bvh.nearest_held(simd, held, job, last, &mut self.best[ray], c)
    }

    #[inline(always)]
    fn together<S: Simd>(&mut self, simd: S, bvh: &Bvh, packet: &Packet, first: usize, asked: u32, c: &mut Counters) -> bool {
        let len = (self.rays.len() - first).min(RAYS);
        let Some(frustum) = bvh.frustum(packet, len) else { return false };
        let rays = &self.rays[first..first + len];
        let bundle = super::bundle::Bundle { packet, frustum: &frustum, rays, asked, interval: self.interval };
        bvh.nearest_together(simd, &bundle, &mut super::stack::Stack::new(), &mut self.best[first..first + len], c);
        true
    }
}

pub struct Any<'a> {
    pub rays: &'a [Ray],
    pub interval: Interval,
    pub hit: &'a mut [bool],
}

impl Purpose for Any<'_> {
    #[inline(always)]
    fn is_settled(&self, ray: usize) -> bool {
        self.hit[ray]
    }

    #[inline(always)]
    fn last(&self, _: usize) -> f32 {
        self.interval.max
    }

    #[inline(always)]
    fn leaf<S: Simd>(
        &mut self,
        simd: S,
        bvh: &Bvh,
        held: Held,
        job: &Job,
        ray: usize,
        last: f32,
        c: &mut Counters,
    ) -> f32 {
        if bvh.any_held(simd, held, job, c) {
            self.hit[ray] = true;
            return f32::NEG_INFINITY;
        }
        last
    }

    #[inline(always)]
    fn together<S: Simd>(&mut self, simd: S, bvh: &Bvh, packet: &Packet, first: usize, asked: u32, c: &mut Counters) -> bool {
        let len = (self.rays.len() - first).min(RAYS);
        let Some(frustum) = bvh.frustum(packet, len) else { return false };
        let rays = &self.rays[first..first + len];
        let bundle = super::bundle::Bundle { packet, frustum: &frustum, rays, asked, interval: self.interval };
        let bits = bvh.any_together(simd, &bundle, &mut super::stack::Stack::new(), c);
        for lane in 0..len {
            self.hit[first + lane] |= bits >> lane & 1 == 1;
        }
        true
    }
}

impl Bvh<'_> {
    /// Follows all rays.
    #[inline(always)]
    pub(super) fn follow<S: Simd>(
        &self,
        simd: S,
        rays: &[Ray],
        interval: Interval,
        purpose: &mut impl Purpose,
        c: &mut Counters,
    ) {
        let mut slots = [const { Slot::EMPTY }; SLOTS];
        let mut free = Line { slots: std::array::from_fn(|i| i as u8), len: SLOTS };
        let (mut at_node, mut at_leaf) = (Line::EMPTY, Line::EMPTY);
        let mut packet = Packet::of(simd, &rays[..1], &self.bounds);
        let (mut first, mut end, mut asked) = (0, 0, 0u32);
        loop {
            while free.len > 0 {
                if asked == 0 {
                    if end == rays.len() {
                        break;
                    }
                    first = end;
                    end = rays.len().min(first + RAYS);
                    for ray in first..end {
                        asked |= u32::from(rays[ray].is_usable() && !purpose.is_settled(ray)) << (ray - first);
                    }
                    packet = Packet::of(simd, &rays[first..end], &self.bounds);
                    if purpose.together(simd, self, &packet, first, asked, c) {
                        asked = 0;
                    }
                    continue;
                }
                let lane = asked.trailing_zeros() as usize % RAYS;
                asked &= asked - 1;
                free.len -= 1;
                let slot = free.slots[free.len % SLOTS];
                slots[slot as usize % SLOTS].start(&packet, lane, first + lane, purpose.last(first + lane));
                at_node.push_if(true, slot);
            }
            if at_node.len + at_leaf.len == 0 {
                return;
            }
            let (mut next_node, mut next_leaf) = (Line::EMPTY, Line::EMPTY);
            c.cells += at_node.len as u64;
            for s in at_node.iter() {
                let slot = &mut slots[s as usize % SLOTS];
                if slot.enter(simd, &self.nodes, interval.min) {
                    let node = slot.next.is_node();
                    next_node.push_if(node, s);
                    next_leaf.push_if(!node, s);
                } else {
                    free.push_if(true, s);
                }
            }
            for s in at_leaf.iter() {
                let slot = &mut slots[s as usize % SLOTS];
                let held = slot.next.held();
                let job = Job { filter: &slot.filter, ray: &rays[slot.ray], interval };
                slot.last = purpose.leaf(simd, self, held, &job, slot.ray, slot.last, c);
                slot.max = limit(slot.last, slot.margin);
                if slot.max > f32::NEG_INFINITY && slot.pop(simd, &self.nodes) {
                    let node = slot.next.is_node();
                    next_node.push_if(node, s);
                    next_leaf.push_if(!node, s);
                } else {
                    free.push_if(true, s);
                }
            }
            if PRE || self.is_large() {
                for s in next_node.iter() {
                    self.prefetch_node(slots[s as usize % SLOTS].next.index());
                }
                for s in next_leaf.iter() {
                    if let Held::Block(index, _) = slots[s as usize % SLOTS].next.held() {
                        self.blocks[index].prefetch();
                    }
                }
            }
            (at_node, at_leaf) = (next_node, next_leaf);
        }
    }
}
