//! Up to eight rays that run alongside each other through the tree together.

use super::frustum::Frustum;
use super::packet::{Lanes, Packet, RAYS, limits};
use super::single::limit;
use super::stack::Stack;
use super::walk::{Visit, Way, walk};
use super::wide::{Bvh, WIDTH, WideNode};
use common::accel::Job;
use common::counters::Counters;
use common::geometry::Hit;
use common::math::Interval;
use common::ray::Ray;
use common::simd::{Simd, SimdBase, SimdFloat, SimdMask, f32x8};

/// Rays that go together.
pub struct Bundle<'p> {
    /// The rays, prepared.
    pub packet: &'p Packet,
    /// What encloses them.
    pub frustum: &'p Frustum,
    /// The rays themselves.
    pub rays: &'p [Ray],
    /// A bit for each that is asked for.
    pub asked: u32,
    /// Where hits count.
    pub interval: Interval,
}

impl Bundle<'_> {
    /// A bit for each ray that may meet the box of a node's child no later than its own limit.
    #[inline(always)]
    fn meeting<S: Simd>(&self, simd: S, node: &WideNode, child: usize, limits: &Lanes) -> u32 {
        let backward = self.frustum.backward;
        self.asked & self.packet.rays_meeting(simd, node, child, backward, self.interval.min, limits)
    }

    /// Where boxes matter to each ray, if hits matter until `last`; to none that is not asked for.
    #[inline(always)]
    fn limits<S: Simd>(&self, simd: S, last: &Lanes) -> Lanes {
        let reach = f32x8::from_slice(simd, &self.packet.reach);
        let mut limits = *limits(simd, f32x8::from_slice(simd, last), reach);
        for (lane, limit) in limits.iter_mut().enumerate() {
            let is_asked = self.asked >> lane & 1 == 1;
            *limit = if is_asked { *limit } else { f32::NEG_INFINITY };
        }
        limits
    }
}

impl Packet {
    /// A bit for every ray that may meet the box of a node's child between `min` and its own
    /// entry of `max`. All rays must have the directions' signs `backward`.
    #[inline(always)]
    pub fn rays_meeting<S: Simd>(
        &self,
        simd: S,
        node: &WideNode,
        child: usize,
        backward: u32,
        min: f32,
        max: &Lanes,
    ) -> u32 {
        let mut near = f32x8::splat(simd, min);
        let mut far = f32x8::from_slice(simd, max);
        for axis in 0..3 {
            let first = (backward >> axis & 1) as usize;
            let inverse = f32x8::from_slice(simd, &self.inverse[axis]);
            let enter = f32x8::splat(simd, node.side[axis][first][child]);
            let leave = f32x8::splat(simd, node.side[axis][first ^ 1][child]);
            near = near.max(enter.mul_sub(inverse, f32x8::from_slice(simd, &self.near_offset[axis])));
            far = far.min(leave.mul_sub(inverse, f32x8::from_slice(simd, &self.far_offset[axis])));
        }
        near.simd_le(far).to_bitmask() as u32
    }
}

impl<S: Simd> Way<S> for Bundle<'_> {
    #[inline(always)]
    fn backward(&self) -> u32 {
        self.frustum.backward
    }

    #[inline(always)]
    fn meet(&self, simd: S, node: &WideNode, max: f32, enter: &mut [f32; WIDTH]) -> u32 {
        self.frustum.meet(simd, node, self.interval.min, max, enter)
    }
}

/// Looks for the first hit of each ray.
struct Firsts<'a, 'g> {
    bvh: &'a Bvh<'g>,
    bundle: &'a Bundle<'a>,
    /// By ray: hits later than this do not matter; known before the exact hit is.
    last: Lanes,
    limits: Lanes,
    best: &'a mut [Option<Hit>],
}

impl<S: Simd> Visit<S> for Firsts<'_, '_> {
    #[inline(always)]
    fn leaf(&mut self, simd: S, node: &WideNode, child: usize, c: &mut Counters) -> f32 {
        let Bundle { packet, rays, interval, .. } = *self.bundle;
        let held = node.child[child].held();
        for lane in lanes_of(self.bundle.meeting(simd, node, child, &self.limits)) {
            let job = Job { filter: &packet.filter(lane), ray: &rays[lane], interval };
            let (last, best) = (self.last[lane], &mut self.best[lane]);
            self.last[lane] = self.bvh.nearest_held(simd, held, &job, last, best, c);
            self.limits[lane] = limit(self.last[lane], packet.margin(lane));
        }
        greatest(simd, &self.limits)
    }
}

/// Looks for any hit of each ray.
struct AllBlocked<'a, 'g> {
    bvh: &'a Bvh<'g>,
    bundle: &'a Bundle<'a>,
    limits: Lanes,
    max: f32,
    /// A bit for each ray that hits something.
    hit: u32,
}

impl<S: Simd> Visit<S> for AllBlocked<'_, '_> {
    #[inline(always)]
    fn leaf(&mut self, simd: S, node: &WideNode, child: usize, c: &mut Counters) -> f32 {
        let Bundle { packet, rays, interval, asked, .. } = *self.bundle;
        let held = node.child[child].held();
        for lane in lanes_of(self.bundle.meeting(simd, node, child, &self.limits) & !self.hit) {
            let job = Job { filter: &packet.filter(lane), ray: &rays[lane], interval };
            self.hit |= u32::from(self.bvh.any_held(simd, held, &job, c)) << lane;
        }
        if self.hit == asked { f32::NEG_INFINITY } else { self.max }
    }
}

impl Bvh<'_> {
    /// Puts the better of what is there and the first hit of each ray into `best`.
    #[inline(always)]
    pub(super) fn nearest_together<S: Simd>(
        &self,
        simd: S,
        bundle: &Bundle,
        stack: &mut Stack,
        best: &mut [Option<Hit>],
        c: &mut Counters,
    ) {
        let mut last = [bundle.interval.max; RAYS];
        for (last, best) in last.iter_mut().zip(best.iter()) {
            *last = best.map_or(*last, |b| b.t);
        }
        let limits = bundle.limits(simd, &last);
        let mut firsts = Firsts { bvh: self, bundle, last, limits, best };
        walk(simd, (self, 0), stack, greatest(simd, &limits), bundle, &mut firsts, c);
    }

    /// A bit for each of the asked rays that hits anything.
    #[inline(always)]
    pub(super) fn any_together<S: Simd>(
        &self,
        simd: S,
        bundle: &Bundle,
        stack: &mut Stack,
        c: &mut Counters,
    ) -> u32 {
        let limits = bundle.limits(simd, &[bundle.interval.max; RAYS]);
        let max = greatest(simd, &limits);
        let mut blocked = AllBlocked { bvh: self, bundle, limits, max, hit: 0 };
        walk(simd, (self, 0), stack, max, bundle, &mut blocked, c);
        blocked.hit
    }
}

#[inline(always)]
fn greatest<S: Simd>(simd: S, lanes: &Lanes) -> f32 {
    let (low, high) = simd.split_f32x8(f32x8::from_slice(simd, lanes));
    let [a, b, c, d] = *low.max(high);
    a.max(b).max(c.max(d))
}

/// The numbers of the bits that are set.
#[inline(always)]
pub fn lanes_of(mut bits: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lane = bits.trailing_zeros() as usize;
        (bits != 0).then(|| {
            bits &= bits - 1;
            lane % RAYS
        })
    })
}
