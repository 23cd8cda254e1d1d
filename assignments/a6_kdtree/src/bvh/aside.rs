//! Many rays at once that pass the whole tree by, as most shadow rays do in front of an empty wall.
//!
//! The rays' origins lie in a box O, their directions in a box D. Where any of them is at t lies in
//! O + t·D, an interval along each axis whose ends are linear in t. It touches a box of the tree
//! while O₋ + t·D₋ ≤ B₊ and O₊ + t·D₊ ≥ B₋, so from one t to another; if no t is left after all
//! axes, no ray of them meets the box. Signs of directions do not matter.

use super::abreast::{RAYS, columns};
use super::packet::Lanes;
use super::single::limits;
use super::slabs::{ORDINARY, Slabs};
use super::wide::{Bvh, WIDTH, WideNode};
use common::math::lanes::{greatest, least};
use common::math::{Bounds, Interval};
use common::ray::Ray;
use common::shape::filter::Errors;
use common::simd::{Select, Simd, SimdBase, SimdFloat, SimdMask, f32x8};

/// Rays that are asked about together. Fewer are in one place more often, and cost more questions.
pub const CROWD: usize = 64;

/// Fewer are not worth the question.
const FEWEST: usize = 16;

/// Room left around boxes, and after the last t, as a part of all that was computed with: beyond
/// the margins of [`super::slabs`] and [`super::single`], of which the largest is 2⁻²⁰, and far
/// beyond the rounding of what is computed here in double precision.
const ROOM: f64 = 1.0 / (1 << 18) as f64;

/// The least box around the origins of some rays, and the one around their directions, whose axes
/// come after those of the first.
struct Around {
    low: [f32; 6],
    high: [f32; 6],
}

/// Where the axes of directions begin.
const DIRECTION: usize = 3;

impl Around {
    /// Written so that NaN is passed over: a ray with one hits nothing.
    #[inline(always)]
    fn of<S: Simd>(simd: S, rays: &[Ray]) -> Self {
        let [mut low, mut high] =
            [f32::INFINITY, f32::NEG_INFINITY].map(|end| [[f32x8::splat(simd, end); 3]; 2]);
        for eight in rays.chunks(RAYS) {
            let both = columns(simd, eight, eight[0]);
            for (vector, axis) in [(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (1, 2)] {
                let (these, low, high) =
                    (both[vector][axis], &mut low[vector][axis], &mut high[vector][axis]);
                *low = these.simd_lt(*low).select(these, *low);
                *high = these.simd_gt(*high).select(these, *high);
            }
        }
        let [o, d] = low;
        let ([a, b, c, e], [f, g, ..]) =
            (least(simd, [o[0], o[1], o[2], d[0]]), least(simd, [d[1], d[2], d[2], d[2]]));
        let low = [a, b, c, e, f, g];
        let [o, d] = high;
        let ([a, b, c, e], [f, g, ..]) =
            (greatest(simd, [o[0], o[1], o[2], d[0]]), greatest(simd, [d[1], d[2], d[2], d[2]]));
        Self { low, high: [a, b, c, e, f, g] }
    }

    /// Both ends of one of the six intervals.
    #[inline(always)]
    fn ends(&self, of: usize) -> [f64; 2] {
        [f64::from(self.low[of]), f64::from(self.high[of])]
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
    /// Whether none of the rays can meet anything in the tree, inside the interval. Says "no" when
    /// in doubt.
    #[inline(always)]
    pub(super) fn is_passed_by<S: Simd>(&self, simd: S, rays: &[Ray], interval: Interval) -> bool {
        if rays.len() < FEWEST {
            return false;
        }
        let (Some(root), true) = (self.nodes.first(), interval.min >= 0.0) else { return false };
        passes(root, &Around::of(simd, rays), interval.max)
    }
}

/// Whether rays from O along D pass all boxes of a node by until `max`.
#[inline(always)]
fn passes(node: &WideNode, rays: &Around, max: f32) -> bool {
    let last = f64::from(max) * (1.0 + ROOM);
    for child in 0..WIDTH {
        let mut stretch = Stretch { first: 0.0, last };
        let mut is_used = true;
        for axis in 0..3 {
            let [low, high] = [0, 1].map(|side| f64::from(node.side[axis][side][child]));
            let (o, d) = (rays.ends(axis), rays.ends(DIRECTION + axis));
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

/// A box widened by the smallest step, as those of [`WideNode::set_box`] are.
pub fn widened(bounds: &Bounds) -> Bounds {
    let [min, max] = [bounds.min, bounds.max].map(|corner| corner.to_array());
    Bounds { min: min.map(f32::next_down).into(), max: max.map(f32::next_up).into() }
}

/// A bit for every one of one to eight rays that may be inside of a box between `min` and its own
/// entry of `last`, widened as for [`limit`](super::single::limit).
#[inline(always)]
pub fn entering<S: Simd>(simd: S, rays: &[Ray], bounds: &Bounds, min: f32, last: &Lanes) -> u32 {
    let [origin, direction] = columns(simd, rays, rays[0]);
    let of = |x: f32| f32x8::splat(simd, x);
    let (mut near, mut far) = (of(min), of(f32::INFINITY));
    let (mut reach, mut step) = (of(0.0), of(0.0));
    for axis in 0..3 {
        let (low, high) = (of(bounds.min[axis]), of(bounds.max[axis]));
        let slab = Slabs::new(simd, origin[axis], direction[axis], low, high);
        let backward = slab.inverse.simd_lt(of(0.0));
        near = near.max(backward.select(high, low).mul_sub(slab.inverse, slab.near_offset));
        far = far.min(backward.select(low, high).mul_sub(slab.inverse, slab.far_offset));
        reach = reach.max(slab.far);
        step = step.max(direction[axis].abs());
    }
    let [margin, ..] = Errors::abreast(simd, reach, step);
    let far = far.min(limits(simd, f32x8::from_slice(simd, last), margin));
    // Of others nothing is known. Written so that NaN is one of them.
    let ordinary = reach.simd_lt(step * of(ORDINARY));
    (near.simd_le(far) | !ordinary).to_bitmask() as u32
}
