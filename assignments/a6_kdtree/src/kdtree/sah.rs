//! The surface area heuristic: what a node would cost, split here or there or not at all.
//!
//! A ray that passes a box passes a convex part of it with a probability equal to the ratio of
//! their surfaces (Goldsmith & Salmon 1987; MacDonald & Booth 1990). Asking a block of up to
//! eight triangles costs 1, asking a solid about as much, a step from a node to its children
//! [`STEP`]. A leaf of several blocks has boxes around them, so it costs one test of those and
//! then [`MET`] for each block.

use super::event::{Event, Kind};
use super::sweep::{self, Line};
use common::math::Bounds;
use common::shape::triangle_block::LANES;

/// Price of stepping through a node, in blocks of triangles: a third of a step is a wrong guess
/// of the processor's, which costs as much as a block. Measured on meshes of 40,000 and a million:
/// from 0.6 to 2 rays are about equally fast.
pub const STEP: f32 = 1.2;

/// Price of each block of a leaf that has several: how likely a ray is to meet its box, and its
/// part in the test of the boxes. Measured with [`STEP`]: at 0.2 leaves hold 70 triangles and rays
/// are a tenth slower, at 0.08 they hold 280, at 0.03 the boxes take more time than they save.
pub const MET: f32 = 0.08;

/// Blocks of a leaf that are asked without a look at their boxes, which would cost as much.
pub const UNBOXED: usize = 2;

/// What a split that cuts off empty space costs, as a share of what it would (Wald & Havran). At
/// their 0.8 a ray passes a twentieth more nodes and a tenth fewer blocks, and is no faster.
pub const EMPTY_BONUS: f32 = 0.9;

/// Half the surface of a box.
pub fn half_area(bounds: &Bounds) -> f64 {
    let s = (bounds.max.as_dvec3() - bounds.min.as_dvec3()).max(common::math::DVec3::ZERO);
    s.x * s.y + s.y * s.z + s.z * s.x
}

/// How much one reference counts: lanes of a block. A solid has no box around it, and so counts
/// as more than a block.
#[inline]
pub fn weight(solid: bool) -> u32 {
    if solid { 8 * LANES as u32 } else { 1 }
}

/// What asking a leaf of triangles costs; of a block that is not full, the mean between that and
/// the share of it, for as long as it is not known whether the side of a plane will be a leaf.
#[inline(always)]
pub fn price(weight: u32) -> f32 {
    let blocks = weight as i32 as f32 / LANES as f32;
    let one = if weight == 0 { 0.0 } else { blocks * 0.5 + 0.5 };
    let several = 1.0 + (blocks - 1.0) * MET;
    if one < several { one } else { several }
}

/// What asking everything in a leaf costs: half-empty blocks cost as much as full ones.
pub fn leaf_cost(triangles: usize, solids: usize, is_boxed: bool) -> f64 {
    let blocks = triangles.div_ceil(LANES);
    let asked = if is_boxed { 1.0 + (blocks - 1) as f64 * f64::from(MET) } else { blocks as f64 };
    asked + solids as f64
}

/// Whether so much is always left in one leaf: no step costs less.
pub fn is_surely_leaf(weight: u32) -> bool {
    price(weight) <= STEP * EMPTY_BONUS
}

/// A plane, and what it costs to have it.
#[derive(Clone, Copy, Debug)]
pub struct Split {
    /// 0, 1, 2: across x, y, z.
    pub axis: usize,
    /// Where.
    pub at: f32,
    /// Whether boxes that lie in the plane go to the left child; else to the right one.
    pub planar_left: bool,
    /// The price of the node if it is split so and both children become leaves.
    pub cost: f64,
}

/// Prices the planes of one axis.
pub struct Sweep {
    axis: usize,
    low: f32,
    high: f32,
    /// Surface of the two faces across the axis, halved, and of the others per length.
    face: f64,
    around: f64,
    /// 1 / half the node's surface.
    inverse_area: f64,
}

impl Sweep {
    /// Across `axis` in a node with the box `bounds`.
    pub fn new(bounds: &Bounds, axis: usize) -> Self {
        let size = bounds.max.as_dvec3() - bounds.min.as_dvec3();
        let (u, v) = (size[(axis + 1) % 3], size[(axis + 2) % 3]);
        let (low, high) = (bounds.min[axis], bounds.max[axis]);
        Self { axis, low, high, face: u * v, around: u + v, inverse_area: half_area(bounds).recip() }
    }

    /// The cost of a plane with so much on each side.
    #[inline]
    pub fn cost(&self, at: f32, left: u32, right: u32) -> f64 {
        let side = |length: f64, weight: u32| (self.face + length * self.around) * f64::from(price(weight));
        let (below, above) = (f64::from(at) - f64::from(self.low), f64::from(self.high) - f64::from(at));
        let cost = f64::from(STEP) + (side(below, left) + side(above, right)) * self.inverse_area;
        if left == 0 || right == 0 { cost * f64::from(EMPTY_BONUS) } else { cost }
    }

    /// The cheaper of putting what lies in the plane to the left or to the right. A plane in a
    /// face of the box is of use only to peel off what lies in that face.
    fn split(&self, at: f32, left: u32, planar: u32, right: u32) -> Option<Split> {
        let split = |planar_left: bool| {
            let (l, r) = if planar_left { (left + planar, right) } else { (left, right + planar) };
            Split { axis: self.axis, at, planar_left, cost: self.cost(at, l, r) }
        };
        if at <= self.low {
            return (planar > 0 && right > 0 && self.low < self.high).then(|| split(true));
        }
        if at >= self.high {
            return (planar > 0 && left > 0).then(|| split(false));
        }
        if planar == 0 {
            return Some(split(true));
        }
        let (a, b) = (split(true), split(false));
        Some(if b.cost < a.cost { b } else { a })
    }

    /// What the fast sweep needs to know.
    fn line(&self) -> Line {
        let (face, around) = (self.face * self.inverse_area, self.around * self.inverse_area);
        Line { low: self.low, high: self.high, face: face as f32, around: around as f32 }
    }

    /// The cheapest plane of sorted events; `total` is the weight of all references.
    fn cheapest(&self, events: &[Event], total: u32) -> Option<Split> {
        if events.iter().any(|e| e.kind() == Kind::Planar as u32) {
            return self.cheapest_of_groups(events, total);
        }
        let best = sweep::cheapest(events, &self.line(), total)?;
        let cost = self.cost(best.at, best.left, best.right);
        Some(Split { axis: self.axis, at: best.at, planar_left: true, cost })
    }

    /// The same, event by event, where boxes may lie in the plane.
    fn cheapest_of_groups(&self, events: &[Event], total: u32) -> Option<Split> {
        let mut best: Option<Split> = None;
        let (mut left, mut right) = (0, total);
        let mut i = 0;
        while i < events.len() {
            let place = events[i].place();
            let mut sums = [0u32; 3];
            while i < events.len() && events[i].place() == place {
                let (kind, weight) = (events[i].kind(), weight(events[i].is_solid()));
                // Without a jump: which kind comes next cannot be predicted.
                for (k, sum) in sums.iter_mut().enumerate() {
                    *sum += weight * u32::from(kind == k as u32);
                }
                i += 1;
            }
            let [ends, planar, starts] = sums;
            right -= ends + planar;
            let split = self.split(Event::position(place), left, planar, right);
            if split.is_some_and(|s| best.is_none_or(|b| s.cost < b.cost)) {
                best = split;
            }
            left += planar + starts;
        }
        best
    }
}

const _: () = assert!(Kind::End as u32 == 0 && Kind::Planar as u32 == 1 && Kind::Start as u32 == 2);

/// The cheapest plane of all; `None` if no plane separates anything.
pub fn cheapest_split(events: [&[Event]; 3], bounds: &Bounds, total: u32) -> Option<Split> {
    (0..3)
        .filter_map(|axis| Sweep::new(bounds, axis).cheapest(events[axis], total))
        .reduce(|best, split| if split.cost < best.cost { split } else { best })
        .filter(|split| split.cost.is_finite())
}

#[cfg(test)]
mod tests {
    use super::super::coarse;
    use super::super::event::{self, Events};
    use super::super::reference::Reference;
    use super::*;
    use common::math::Vec3;

    /// Sixteen small boxes at one end of a long one, sixteen at the other.
    #[test]
    fn a6t1_empty_space_is_cut_off() {
        let bounds = Bounds { min: Vec3::ZERO, max: Vec3::new(100.0, 1.0, 1.0) };
        let mut events = Events::default();
        for i in 0..32 {
            let x = if i < 16 { i as f32 / 16.0 } else { 99.0 + (i - 16) as f32 / 16.0 };
            let min = Vec3::new(x, 0.0, 0.0);
            event::push(&mut events, &Bounds { min, max: min + Vec3::new(0.0625, 1.0, 1.0) }, false, i);
        }
        events.iter_mut().for_each(|e| e.sort_unstable());
        let split = cheapest_split(events.each_ref().map(Vec::as_slice), &bounds, 32).unwrap();
        assert_eq!((split.axis, split.at), (0, 1.0));
        // Hardly a ray meets the near half.
        assert!(split.cost < f64::from(STEP) + 1.02 * leaf_cost(16, 0, false));
    }

    #[test]
    fn a6t1_what_cannot_be_told_apart_is_not_split() {
        let bounds = Bounds { min: Vec3::ZERO, max: Vec3::ONE };
        let mut events = Events::default();
        (0..9).for_each(|i| event::push(&mut events, &bounds, true, i));
        events.iter_mut().for_each(|e| e.sort_unstable());
        assert!(cheapest_split(events.each_ref().map(Vec::as_slice), &bounds, 9 * weight(true)).is_none());
    }
    /// Both ways of sweeping, and planes at equal distances, on boxes of which many begin and end
    /// at the same positions.
    #[test]
    fn a6t1_all_sweeps_find_planes_as_cheap() {
        let bounds = Bounds { min: Vec3::splat(-1.0), max: Vec3::splat(30.0) };
        let mut events = Events::default();
        let random = |i: usize, k: usize| (i * (7 + 4 * k) + i * i * (3 + k)) % 101;
        let references: Vec<Reference> = (0..500)
            .map(|i| {
                let min = Vec3::from([0, 1, 2].map(|k| (random(i, k) / 4) as f32));
                let bounds = Bounds { min, max: min + Vec3::splat(0.5 + (i % 3) as f32) };
                event::push(&mut events, &bounds, i % 9 == 0, i);
                Reference { bounds, primitive: i as u32 }
            })
            .collect();
        events.iter_mut().for_each(|e| e.sort_unstable());
        let weight = |r: &Reference| weight(r.primitive.is_multiple_of(9));
        let total = references.iter().map(weight).sum();
        for (axis, events) in events.iter().enumerate() {
            let sweep = Sweep::new(&bounds, axis);
            let slow = sweep.cheapest_of_groups(events, total).unwrap();
            let fast = sweep.cheapest(events, total).unwrap();
            assert!((fast.cost / slow.cost - 1.0).abs() < 1e-5, "{fast:?} {slow:?}");
        }
        let best = cheapest_split(events.each_ref().map(Vec::as_slice), &bounds, total).unwrap();
        let coarse = coarse::cheapest_split(&references, &bounds, weight).unwrap();
        assert!(coarse.cost >= best.cost * 0.99999 && coarse.cost < best.cost * 1.02, "{coarse:?} {best:?}");
    }
}
