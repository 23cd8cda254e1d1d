//! Questions to both levels.

use super::Instances;
use super::object_ray::ObjectRay;
use super::part::Part;
use super::placement::Placement;
use crate::bvh::Bvh;
use crate::bvh::packet::Packet;
use crate::bvh::single::limit;
use crate::bvh::stack::Stack;
use crate::bvh::walk::{Visit, walk};
use crate::bvh::wide::{Held, WideNode};
use common::counters::Counters;
use common::geometry::{Geometry, Hit, hit_triangle};
use common::math::Interval;
use common::ray::Ray;
use common::shape::ExactRay;
use common::shape::filter::Errors;
use common::simd::{self, Simd, dispatch};

impl Instances<'_> {
    /// The better of `best` and the first hit of what is finite.
    pub(super) fn search_nearest(
        &self,
        ray: &Ray,
        interval: Interval,
        best: Option<Hit>,
        c: &mut Counters,
    ) -> Option<Hit> {
        dispatch!(simd::level(), s => self.search::<_, false>(s, ray, interval, best, c))
    }

    /// Whether anything finite is hit.
    pub(super) fn search_any(&self, ray: &Ray, interval: Interval, c: &mut Counters) -> bool {
        dispatch!(simd::level(), s => self.search::<_, true>(s, ray, interval, None, c)).is_some()
    }

    /// The better of `best` and the first hit; if `ANY`, then any hit at all.
    #[inline(always)]
    fn search<S: Simd, const ANY: bool>(
        &self,
        simd: S,
        ray: &Ray,
        interval: Interval,
        best: Option<Hit>,
        c: &mut Counters,
    ) -> Option<Hit> {
        let packet = Packet::alone(simd, ray, &self.top.bounds);
        let margin = packet.margin(0);
        let goal = Goal::<ANY> { ray, interval, best };
        let stretch = widened(interval, &goal, margin);
        let mut parts = Parts { scene: self, margin, goal };
        let beam = packet.beam(0).spread(simd, stretch.min);
        walk(simd, (&self.top, 0), &mut Stack::new(), stretch.max, &beam, &mut parts, c);
        parts.goal.best
    }
}

/// What is looked for, and the best so far.
struct Goal<'r, const ANY: bool> {
    ray: &'r Ray,
    interval: Interval,
    best: Option<Hit>,
}

impl<const ANY: bool> Goal<'_, ANY> {
    /// Boxes that are entered later hold nothing that could matter, if two hits in them must
    /// differ by `margin` for their order to be certain.
    #[inline(always)]
    fn limit(&self, margin: f32) -> f32 {
        match self.best {
            Some(_) if ANY => f32::NEG_INFINITY,
            best => limit(best.map_or(self.interval.max, |b| b.t), margin),
        }
    }
}

/// Where boxes matter: the interval and the rounding of t at both ends.
#[inline(always)]
fn widened<const ANY: bool>(interval: Interval, goal: &Goal<ANY>, margin: f32) -> Interval {
    Interval { min: -limit(-interval.min, margin), max: goal.limit(margin) }
}

/// At the leaves of the top level.
struct Parts<'a, 'g, const ANY: bool> {
    scene: &'a Instances<'g>,
    margin: f32,
    goal: Goal<'a, ANY>,
}

impl<S: Simd, const ANY: bool> Visit<S> for Parts<'_, '_, ANY> {
    #[inline(always)]
    fn leaf(&mut self, simd: S, node: &WideNode, child: usize, c: &mut Counters) -> f32 {
        let held = node.child[child].held();
        let Held::Solids(first, count) = held else { return self.goal.limit(self.margin) };
        for &index in &self.scene.top.solids[first..first + count] {
            let part = &self.scene.parts[index as usize];
            let tree = self.scene.tree(part.tree);
            match &part.placement {
                Some(placement) => self.shared(simd, part, placement, tree, c),
                None => self.own(simd, tree, c),
            }
        }
        self.goal.limit(self.margin)
    }
}

impl<const ANY: bool> Parts<'_, '_, ANY> {
    /// A tree in the world.
    #[inline(always)]
    fn own<S: Simd>(&mut self, simd: S, tree: &Bvh, c: &mut Counters) {
        let Goal { ray, interval, best } = self.goal;
        if !ANY {
            self.goal.best = tree.nearest_alone(simd, ray, interval, best, c);
        } else if best.is_none() && tree.any_alone(simd, ray, interval, c) {
            // Only that there is one matters.
            self.goal.best = Some(Hit { t: 0.0, primitive: 0, u: 0.0, v: 0.0 });
        }
    }

    /// A tree in the space of a mesh.
    #[inline(always)]
    fn shared<S: Simd>(&mut self, simd: S, part: &Part, placement: &Placement, tree: &Bvh, c: &mut Counters) {
        let (ray, interval) = (self.goal.ray, self.goal.interval);
        let object = ObjectRay::new(simd, placement, ray, &tree.bounds);
        let step = ray.direction.abs().max_element();
        let margin = Errors::new(part.bounds.reach_from(ray.origin), step).margin();
        let stretch = widened(interval, &self.goal, margin);
        let exact = ExactRay::new(ray);
        let geometry = self.scene.geometry;
        let mut blocks =
            Blocks { geometry, tree, placement, object: &object, exact, margin, goal: &mut self.goal };
        let beam = object.packet.beam(0).spread(simd, stretch.min);
        walk(simd, (tree, 0), &mut Stack::new(), stretch.max, &beam, &mut blocks, c);
    }
}

/// At the leaves of a mesh's tree.
struct Blocks<'a, 'g, 'r, const ANY: bool> {
    geometry: &'g Geometry,
    tree: &'a Bvh<'g>,
    placement: &'a Placement,
    object: &'a ObjectRay,
    exact: ExactRay,
    margin: f32,
    goal: &'a mut Goal<'r, ANY>,
}

impl<S: Simd, const ANY: bool> Visit<S> for Blocks<'_, '_, '_, ANY> {
    #[inline(always)]
    fn leaf(&mut self, simd: S, node: &WideNode, child: usize, c: &mut Counters) -> f32 {
        let held = node.child[child].held();
        let Held::Block(index, len) = held else { return self.goal.limit(self.margin) };
        let block = &self.tree.blocks[index];
        c.intersections += len as u64;
        let verdict = block.judge(simd, &self.object.filter, Interval::ALL);
        let mut lanes = verdict.possible & ((1 << len) - 1);
        c.exact_tests += u64::from(lanes.count_ones());
        while lanes != 0 {
            let lane = lanes.trailing_zeros() as usize;
            lanes &= lanes - 1;
            self.decide(block.index[lane]);
        }
        self.goal.limit(self.margin)
    }
}

impl<const ANY: bool> Blocks<'_, '_, '_, ANY> {
    /// The exact test of the world's triangle.
    #[inline(always)]
    fn decide(&mut self, triangle: u32) {
        let primitive = self.placement.first + triangle;
        if primitive == self.goal.ray.home {
            return;
        }
        let vertices = &self.geometry.triangles()[self.placement.start + triangle as usize];
        let hit = hit_triangle(vertices, primitive, &self.exact, self.goal.interval);
        if let Some(hit) = hit.filter(|h| h.precedes(self.goal.best.as_ref())) {
            self.goal.best = Some(hit);
        }
    }
}
