//! A few balls, held against eight rays at a time instead of standing in the tree.
//!
//! Balls are large and overlap the boxes of a mesh; in the tree each of them costs most rays a
//! node or a leaf. In single precision it is soon told which rays surely pass a ball by, or leave
//! it behind them; only the others are asked in double precision.

use super::abreast::{Abreast, Firsts, RAYS};
use super::ball_hits::{all_met, any_of, nearest_of, places_of};
use super::bundle::lanes_of;
use super::cull::{Beams, Targets};
use common::counters::Counters;
use common::geometry::{Geometry, Hit, SolidShape};
use common::math::Interval;
use common::math::lanes::each;
use common::ray::Ray;
use common::simd::{Simd, SimdBase, SimdMask, f32x8};

/// More balls are faster in the tree; a multiple of eight.
pub const MOST: usize = 16;

/// As many rays are asked side by side sooner than one by one.
const ENOUGH: u32 = 3;

/// The balls of a scene, by their place among its solids.
pub struct Balls {
    /// Centres, by axis.
    center: [[f32; MOST]; 3],
    radius: [f32; MOST],
    /// Sum of the magnitudes of centre and radius.
    size: [f32; MOST],
    count: usize,
}

impl Balls {
    /// None.
    pub const NONE: Self =
        Self { center: [[0.0; MOST]; 3], radius: [0.0; MOST], size: [0.0; MOST], count: 0 };

    /// The solids of a scene if they are few, all of them balls, and stand beside triangles.
    pub fn of(geometry: &Geometry) -> Self {
        let mut balls = Self::NONE;
        let solids = geometry.solids();
        if solids.len() > MOST || geometry.triangles().is_empty() {
            return balls;
        }
        for (place, solid) in solids.iter().enumerate() {
            let SolidShape::Sphere(sphere) = &solid.shape else { return Self::NONE };
            let center = sphere.center.as_vec3();
            for axis in 0..3 {
                balls.center[axis][place] = center[axis];
            }
            balls.radius[place] = sphere.radius as f32;
            balls.size[place] = center.abs().element_sum() + sphere.radius as f32;
        }
        balls.count = solids.len();
        balls
    }

    /// Whether there are none.
    #[inline(always)]
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// A bit for each of up to eight rays that may meet the ball at `place`.
    #[inline(always)]
    fn rays_meeting<S: Simd>(
        &self,
        simd: S,
        (rays, beams): (&[Ray], &Beams<S>),
        place: usize,
        interval: Interval,
    ) -> u32 {
        let ball = Targets {
            center: each([0, 1, 2], |axis: usize| f32x8::splat(simd, self.center[axis][place])),
            radius: f32x8::splat(simd, self.radius[place]),
            size: f32x8::splat(simd, self.size[place]),
        };
        beams.meeting(simd, &ball, interval.min >= 0.0) & ((1 << rays.len()) - 1)
    }

    /// A bit for each ball that a ray may meet.
    #[inline(always)]
    fn met_by<S: Simd>(&self, simd: S, ray: &Ray, ahead: bool) -> u32 {
        let (beams, mut met) = (Beams::everywhere(simd, ray), 0);
        for first in (0..self.count).step_by(RAYS) {
            let lanes = |all: &[f32; MOST]| f32x8::from_slice(simd, &all[first..first + RAYS]);
            let balls = Targets {
                center: each([0, 1, 2], |axis: usize| lanes(&self.center[axis])),
                radius: lanes(&self.radius),
                size: lanes(&self.size),
            };
            met |= beams.meeting(simd, &balls, ahead) << first;
        }
        met & ((1 << self.count) - 1)
    }

    /// Takes the better of what is there and the first hit of each of up to eight rays.
    #[inline(always)]
    pub fn nearest<S: Simd>(
        &self,
        simd: S,
        geometry: &Geometry,
        (rays, abreast): (&[Ray], &Abreast),
        interval: Interval,
        firsts: &mut Firsts,
        c: &mut Counters,
    ) {
        let beams = &Beams::side_by_side(simd, abreast);
        for place in 0..self.count {
            let meeting = self.rays_meeting(simd, (rays, beams), place, interval);
            if meeting.count_ones() < ENOUGH {
                for lane in lanes_of(meeting) {
                    let place = [place as u32].into_iter();
                    let best = nearest_of(geometry, place, &rays[lane], interval, firsts.hit(lane), c);
                    if let Some(best) = best {
                        (firsts.t[lane], firsts.primitive[lane]) = (best.t, best.primitive);
                    }
                }
                continue;
            }
            let (t, primitive) = all_met(simd, geometry, place, abreast, interval);
            c.intersections += u64::from(meeting.count_ones());
            firsts.take(simd, t, primitive);
        }
    }

    /// Says `true` of each of up to eight rays that hits a ball.
    #[inline(always)]
    pub fn any<S: Simd>(
        &self,
        simd: S,
        geometry: &Geometry,
        (rays, abreast): (&[Ray], &Abreast),
        interval: Interval,
        hit: &mut [bool],
        c: &mut Counters,
    ) {
        let beams = &Beams::side_by_side(simd, abreast);
        for place in 0..self.count {
            let meeting = self.rays_meeting(simd, (rays, beams), place, interval);
            if meeting.count_ones() < ENOUGH {
                for lane in lanes_of(meeting) {
                    let place = [place as u32].into_iter();
                    hit[lane] = hit[lane] || any_of(geometry, place, &rays[lane], interval, c);
                }
                continue;
            }
            let (t, _) = all_met(simd, geometry, place, abreast, interval);
            c.intersections += u64::from(meeting.count_ones());
            let met = t.simd_eq(t).to_bitmask() as u32 & meeting;
            for lane in lanes_of(met) {
                hit[lane] = true;
            }
        }
    }

    /// The better of `best` and the first hit of one ray.
    #[inline(always)]
    pub fn nearest_alone<S: Simd>(
        &self,
        simd: S,
        geometry: &Geometry,
        ray: &Ray,
        interval: Interval,
        best: Option<Hit>,
        c: &mut Counters,
    ) -> Option<Hit> {
        let met = places_of(self.met_by(simd, ray, interval.min >= 0.0));
        nearest_of(geometry, met, ray, interval, best, c)
    }

    /// Whether one ray hits any.
    #[inline(always)]
    pub fn any_alone<S: Simd>(
        &self,
        simd: S,
        geometry: &Geometry,
        ray: &Ray,
        interval: Interval,
        c: &mut Counters,
    ) -> bool {
        let met = places_of(self.met_by(simd, ray, interval.min >= 0.0));
        any_of(geometry, met, ray, interval, c)
    }
}
