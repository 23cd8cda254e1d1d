//! Many rays at once that pass the whole tree by, as most shadow rays do in front of an empty wall.
//!
//! The rays' origins lie in a box O, their directions in a box D. Where any of them is at t lies in
//! O + t·D, an interval along each axis whose ends are linear in t. It touches a box of the tree
//! while O₋ + t·D₋ ≤ B₊ and O₊ + t·D₊ ≥ B₋, so from one t to another; if no t is left after all
//! axes, no ray of them meets the box. Signs of directions do not matter.

use super::packet::{Lanes, Packet};
use super::wide::{Bvh, WIDTH, WideNode};
use common::math::{Bounds, Interval};
use common::ray::Ray;
use common::simd::{Select, Simd, SimdBase, SimdFloat, SimdMask, f32x8};
use std::ops::Range;

/// Rays that are asked about together. Fewer are in one place more often, and cost more questions.
const CROWD: usize = 64;

/// Fewer are not worth the question.
const FEWEST: usize = 16;

/// Room left around boxes, and after the last t, as a part of all that was computed with: beyond
/// the margins of [`super::slabs`] and [`super::single`], of which the largest is 2⁻²⁰, and far
/// beyond the rounding of what is computed here in double precision.
const ROOM: f64 = 1.0 / (1 << 18) as f64;

/// The least box around the origins of some rays, and the one around their directions, whose axes
/// come after those of the first.
struct Around {
    low: [f32; 8],
    high: [f32; 8],
}

/// Where the axes of directions begin.
const DIRECTION: usize = 3;

impl Around {
    /// Written so that NaN is passed over: a ray with one hits nothing.
    #[inline(always)]
    fn of<S: Simd>(simd: S, rays: &[Ray]) -> Self {
        let mut low = f32x8::splat(simd, f32::INFINITY);
        let mut high = f32x8::splat(simd, f32::NEG_INFINITY);
        for Ray { origin: o, direction: d, .. } in rays {
            let both = f32x8::from_slice(simd, &[o.x, o.y, o.z, d.x, d.y, d.z, 0.0, 0.0]);
            low = both.simd_lt(low).select(both, low);
            high = both.simd_gt(high).select(both, high);
        }
        let mut around = Self { low: [0.0; 8], high: [0.0; 8] };
        low.store_slice(&mut around.low);
        high.store_slice(&mut around.high);
        around
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
    /// Calls `follow` for one run of rays after the other, of all but those that pass the tree by.
    #[inline(always)]
    pub(super) fn for_each_run<S: Simd>(
        &self,
        simd: S,
        rays: &[Ray],
        interval: Interval,
        mut follow: impl FnMut(Range<usize>),
    ) {
        let mut first = 0;
        while first < rays.len() {
            let (mut end, mut passed) = (first, 0);
            while end < rays.len() && passed == 0 {
                let crowd = &rays[end..rays.len().min(end + CROWD)];
                if crowd.len() >= FEWEST && self.is_passed_by(simd, crowd, interval) {
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
    fn is_passed_by<S: Simd>(&self, simd: S, rays: &[Ray], interval: Interval) -> bool {
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

impl Packet {
    /// A bit for every ray that may be inside of a box between `min` and its own entry of `max`,
    /// whatever the directions' signs. The box may be as large as that of [`Packet::of`].
    #[inline(always)]
    pub fn rays_inside<S: Simd>(&self, simd: S, bounds: &Bounds, min: f32, max: &Lanes) -> u32 {
        let (low, high) = (bounds.min, bounds.max);
        let mut near = f32x8::splat(simd, min);
        let mut far = f32x8::from_slice(simd, max);
        for axis in 0..3 {
            let inverse = f32x8::from_slice(simd, &self.inverse[axis]);
            let near_offset = f32x8::from_slice(simd, &self.near_offset[axis]);
            let far_offset = f32x8::from_slice(simd, &self.far_offset[axis]);
            let backward = inverse.simd_lt(f32x8::splat(simd, 0.0));
            let low = f32x8::splat(simd, low[axis].next_down());
            let high = f32x8::splat(simd, high[axis].next_up());
            near = near.max(backward.select(high, low).mul_sub(inverse, near_offset));
            far = far.min(backward.select(low, high).mul_sub(inverse, far_offset));
        }
        near.simd_le(far).to_bitmask() as u32
    }
}
