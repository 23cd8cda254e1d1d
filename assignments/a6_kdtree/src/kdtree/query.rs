//! A ray, prepared for a tree.

use super::stack::Waiting;
use super::tree::KdTree;
use crate::bvh::beam::Beam;
use crate::bvh::packet::Packet;
use common::math::Interval;
use common::ray::Ray;
use common::shape::ExactRay;
use common::shape::filter::Filter;
use std::cmp::Ordering;

/// A ray, prepared in single precision for the boxes and triangles of leaves.
pub struct Prepared {
    /// For boxes.
    pub beam: Beam,
    /// For triangles.
    pub filter: Filter,
    /// See [`Packet::margin`].
    pub margin: f32,
}

impl Prepared {
    /// One ray of a packet.
    #[inline(always)]
    pub fn of<const N: usize>(packet: &Packet<N>, lane: usize) -> Self {
        Self { beam: packet.beam(lane), filter: packet.filter(lane), margin: packet.margin(lane) }
    }
}

/// One ray on its way through the tree.
pub struct Query {
    interval: Interval,
    /// The ray, prepared for solids …
    pub exact: ExactRay,
    /// … and for boxes and triangles.
    pub prepared: Prepared,
    /// By axis; the fourth is there for the index of leaves.
    origin: [f64; 4],
    inverse: [f64; 4],
    /// 1 if the ray meets the upper child first.
    pub backward: [usize; 4],
    /// See [`ExactRay::margin`].
    pub margin: f64,
    /// More than the rounding of where the ray meets planes.
    pub slack: f64,
    /// The stretch of the ray inside the box and the interval.
    pub enter: f64,
    /// See above.
    pub exit: f64,
}

impl Query {
    /// A usable ray, which may pass the tree by.
    #[inline(always)]
    pub fn new(tree: &KdTree, ray: &Ray, prepared: Prepared, interval: Interval) -> Self {
        let exact = ExactRay::new(ray);
        let [x, y, z] = exact.direction.to_array().map(|d| (d + 0.0).recip());
        let [ox, oy, oz] = exact.origin.to_array();
        let mut query = Self {
            interval,
            exact,
            prepared,
            origin: [ox, oy, oz, 0.0],
            inverse: [x, y, z, 0.0],
            backward: [x, y, z, 0.0].map(|i| usize::from(i < 0.0)),
            margin: exact.margin(&tree.bounds),
            slack: 0.0,
            enter: f64::NEG_INFINITY,
            exit: f64::INFINITY,
        };
        query.clip(tree);
        query
    }

    /// Whether the ray surely passes the box by. Written so that a NaN, of which there should be
    /// none, does.
    #[inline(always)]
    pub fn passes_by(&self) -> bool {
        !matches!(self.enter.partial_cmp(&self.exit), Some(Ordering::Less | Ordering::Equal))
    }

    /// The root.
    #[inline(always)]
    pub fn start(&self) -> Waiting {
        Waiting { enter: self.enter, exit: self.exit, node: 0 }
    }

    #[inline(always)]
    fn clip(&mut self, tree: &KdTree) {
        for axis in 0..3 {
            let sides = [tree.bounds.min[axis], tree.bounds.max[axis]];
            let [near, far] = [self.backward[axis], 1 - self.backward[axis]]
                .map(|side| self.meets(f64::from(sides[side]), axis));
            // A ray in a side of the box gives NaN, which compares false: no limit.
            if near > self.enter {
                self.enter = near;
            }
            if far < self.exit {
                self.exit = far;
            }
        }
        self.slack = self.enter.abs().max(self.exit.abs()) * 2f64.powi(-48);
        let (min, max) = (f64::from(self.interval.min), f64::from(self.interval.max));
        self.enter = (self.enter - self.slack).max(min - self.margin);
        self.exit = (self.exit + self.slack).min(max + self.margin);
    }

    /// Where the ray meets a plane; ±∞ on its way along the plane, NaN inside it.
    #[inline(always)]
    pub fn meets(&self, plane: f64, axis: usize) -> f64 {
        (plane - self.origin[axis]) * self.inverse[axis]
    }
}
