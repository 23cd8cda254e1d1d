//! Many rays at once that pass the whole tree by, as most shadow rays do in front of an empty wall.
//!
//! The rays' origins lie in a box O, their directions in a box D. Where any of them is at t lies in
//! O + t·D, an interval along each axis whose ends are linear in t. It touches a box of the tree
//! while O₋ + t·D₋ ≤ B₊ and O₊ + t·D₊ ≥ B₋, so from one t to another; if no t is left after all
//! axes, no ray of them meets the box. Signs of directions do not matter.

use super::wide::{Bvh, WIDTH, WideNode};
use common::math::{Interval, Vec3};
use common::ray::Ray;
use std::ops::Range;

/// Rays that are asked about together. Fewer are in one place more often, and cost more questions.
const CROWD: usize = 64;

/// Fewer are not worth the question.
const FEWEST: usize = 16;

/// Room left around boxes, and after the last t, as a part of all that was computed with: beyond
/// the margins of [`super::slabs`] and [`super::single`], of which the largest is 2⁻²⁰, and far
/// beyond the rounding of what is computed here in double precision.
const ROOM: f64 = 1.0 / (1 << 18) as f64;

/// The least box around some vectors.
struct Around {
    low: Vec3,
    high: Vec3,
}

impl Around {
    const NOTHING: Self = Self { low: Vec3::INFINITY, high: Vec3::NEG_INFINITY };

    /// Written so that NaN is passed over: a ray with one hits nothing.
    #[inline(always)]
    fn add(&mut self, v: Vec3) {
        for axis in 0..3 {
            self.low[axis] = if v[axis] < self.low[axis] { v[axis] } else { self.low[axis] };
            self.high[axis] = if v[axis] > self.high[axis] { v[axis] } else { self.high[axis] };
        }
    }
}

/// Where t may be.
struct Stretch {
    first: f64,
    last: f64,
}

impl Stretch {
    /// Keeps the t with gap + t·speed ≥ 0.
    #[inline(always)]
    fn keep(&mut self, gap: f64, speed: f64) {
        let turn = -gap / speed;
        if speed > 0.0 {
            self.first = if turn > self.first { turn } else { self.first };
        } else if speed < 0.0 {
            self.last = if turn < self.last { turn } else { self.last };
        } else if gap < 0.0 {
            self.last = f64::NEG_INFINITY;
        }
    }
}

impl Bvh<'_> {
    /// Calls `follow` for one run of rays after the other, of all but those that pass the tree by.
    #[inline(always)]
    pub(super) fn for_each_run(
        &self,
        rays: &[Ray],
        interval: Interval,
        mut follow: impl FnMut(Range<usize>),
    ) {
        let mut first = 0;
        while first < rays.len() {
            let (mut end, mut passed) = (first, 0);
            while end < rays.len() && passed == 0 {
                let crowd = &rays[end..rays.len().min(end + CROWD)];
                if crowd.len() >= FEWEST && self.is_passed_by(crowd, interval) {
                    passed = crowd.len();
                } else {
                    end += crowd.len();
                }
            }
            if first < end {
                follow(first..end);
            }
            first = end + passed;
        }
    }

    /// Whether none of the rays can meet anything in the tree, inside the interval. Says "no" when
    /// in doubt.
    #[inline(always)]
    fn is_passed_by(&self, rays: &[Ray], interval: Interval) -> bool {
        let (mut origin, mut direction) = (Around::NOTHING, Around::NOTHING);
        for ray in rays {
            origin.add(ray.origin);
            direction.add(ray.direction);
        }
        let forward = interval.min >= 0.0;
        forward && self.nodes.first().is_some_and(|root| passes(root, &origin, &direction, interval.max))
    }
}

/// Whether rays from O along D pass all boxes of a node by until `max`.
#[inline(always)]
fn passes(node: &WideNode, origin: &Around, direction: &Around, max: f32) -> bool {
    let last = f64::from(max) * (1.0 + ROOM);
    for child in 0..WIDTH {
        let mut stretch = Stretch { first: 0.0, last };
        let mut is_used = true;
        for axis in 0..3 {
            let [low, high] = [0, 1].map(|side| f64::from(node.side[axis][side][child]));
            let [o, d] = [origin, direction].map(|v| [f64::from(v.low[axis]), f64::from(v.high[axis])]);
            let room = ROOM * (low.abs() + high.abs() + o[0].abs() + o[1].abs());
            is_used &= low <= high;
            stretch.keep(high + room - o[0], -d[0]);
            stretch.keep(o[1] - low + room, d[1]);
        }
        // Written so that NaN is in doubt.
        let missed = stretch.first > stretch.last;
        if is_used && !missed {
            return false;
        }
    }
    true
}
