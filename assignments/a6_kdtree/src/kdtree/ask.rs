//! What one ray asks of leaves.

use super::leaf::Held;
use super::query::{Prepared, Query};
use super::tree::KdTree;
use crate::bvh::beam::Spread;
use crate::bvh::children::first_child;
use crate::bvh::known::Known;
use crate::bvh::single::limit;
use crate::bvh::walk::Way;
use crate::bvh::wide::WideNode;
use common::accel::Job;
use common::counters::Counters;
use common::geometry::{Geometry, Hit};
use common::math::Interval;
use common::ray::Ray;
use common::shape::ExactRay;
use common::simd::{Simd, SimdBase, SimdMask, f32x8};

/// What is looked for: the first hit, or whether there is any.
pub trait Answer: Known {
    /// What it is beside the tree.
    fn beside(geometry: &Geometry, ray: &Ray, interval: Interval, c: &mut Counters) -> Self;

    /// Looks at solids. Hits later than `last` do not matter; returns until where they do from now on,
    /// −∞ if none does.
    fn solids(
        &mut self,
        geometry: &Geometry,
        solids: &[u32],
        exact: &ExactRay,
        last: (f32, Interval),
        c: &mut Counters,
    ) -> f32;
}

impl Answer for Option<Hit> {
    #[inline(always)]
    fn beside(geometry: &Geometry, ray: &Ray, interval: Interval, c: &mut Counters) -> Self {
        geometry.nearest_sheet(ray, interval, c)
    }

    #[inline(always)]
    fn solids(
        &mut self,
        geometry: &Geometry,
        solids: &[u32],
        exact: &ExactRay,
        (last, interval): (f32, Interval),
        c: &mut Counters,
    ) -> f32 {
        *self = geometry.nearest_solid(solids.iter().copied(), exact, interval, *self, c);
        self.map_or(last, |b| b.t.min(last))
    }
}

impl Answer for bool {
    #[inline(always)]
    fn beside(geometry: &Geometry, ray: &Ray, interval: Interval, c: &mut Counters) -> Self {
        geometry.any_sheet(ray, interval, c)
    }

    #[inline(always)]
    fn solids(
        &mut self,
        geometry: &Geometry,
        solids: &[u32],
        exact: &ExactRay,
        (last, interval): (f32, Interval),
        c: &mut Counters,
    ) -> f32 {
        *self = geometry.any_solid(solids.iter().copied(), exact, interval, c);
        if *self { f32::NEG_INFINITY } else { last }
    }
}

/// A ray, prepared for boxes and primitives.
pub struct Asker<'q, S: Simd> {
    simd: S,
    job: Job<'q>,
    exact: &'q ExactRay,
    beam: Spread<S>,
    margin: f32,
}

/// Children of a node of boxes that a ray may meet.
struct Met<S: Simd> {
    enter: f32x8<S>,
    lanes: u32,
}

impl<'q, S: Simd> Asker<'q, S> {
    /// Asks for a ray of which `query` was made.
    #[inline(always)]
    pub fn new(simd: S, ray: &'q Ray, interval: Interval, query: &'q Query) -> Self {
        let Prepared { beam, filter, margin } = &query.prepared;
        let job = Job { filter, ray, interval };
        Self { simd, job, exact: &query.exact, beam: beam.spread(simd, interval.min), margin: *margin }
    }

    /// Looks into a leaf. Hits later than `last` do not matter; returns until where they do from now on,
    /// −∞ if none does.
    #[inline(always)]
    pub fn leaf(
        &self,
        tree: &KdTree,
        held: Held,
        mut last: f32,
        answer: &mut impl Answer,
        c: &mut Counters,
    ) -> f32 {
        for block in held.blocks {
            last = answer.look(self.simd, (block, block.len()), last, &self.job, c);
            if last == f32::NEG_INFINITY {
                return last;
            }
        }
        for node in held.boxes {
            let mut met = self.meet(node, last, c);
            while let Some((block, len)) = self.next_block(node, &mut met) {
                last = answer.look(self.simd, (&tree.blocks[block], len), last, &self.job, c);
                if last == f32::NEG_INFINITY {
                    return last;
                }
                let until = f32x8::splat(self.simd, limit(last, self.margin));
                met.lanes &= met.enter.simd_le(until).to_bitmask() as u32;
            }
        }
        match held.solids {
            [] => last,
            solids => answer.solids(tree.geometry, solids, self.exact, (last, self.job.interval), c),
        }
    }

    #[inline(always)]
    fn meet(&self, node: &WideNode, last: f32, c: &mut Counters) -> Met<S> {
        c.cells += 1;
        let (enter, lanes) = self.beam.boxes(self.simd, node, limit(last, self.margin));
        Met { enter, lanes }
    }

    /// Takes the nearest, by and large, of the blocks that are met: its place and how many of its
    /// triangles are in use.
    #[inline(always)]
    fn next_block(&self, node: &WideNode, met: &mut Met<S>) -> Option<(usize, usize)> {
        if met.lanes == 0 {
            return None;
        }
        let child = first_child(met.lanes, node.axis, self.beam.backward());
        met.lanes &= !(1 << child);
        Some(node.child[child].block_and_len())
    }
}
