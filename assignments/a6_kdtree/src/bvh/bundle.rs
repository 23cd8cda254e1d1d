//! Rays that run alongside each other through the tree together.

use super::fan::Fan;
use super::frustum::Frustum;
use super::packet::{Lanes, Packet, RAYS};
use super::walk::Way;
use super::wide::{WIDTH, WideNode};
use common::math::lanes::Vectors;
use common::math::{Bounds, Interval};
use common::ray::Ray;
use common::shape::faces::Rays;
use common::simd::{Simd, SimdBase, SimdFloat, SimdMask};

/// Most rays of a bundle.
pub const MOST: usize = 32;

/// Rays that go together.
pub struct Bundle<'p> {
    /// The rays, prepared.
    pub packet: &'p Packet<MOST>,
    /// What encloses them.
    pub frustum: &'p Frustum,
    /// The rays themselves.
    pub rays: &'p [Ray],
    /// What triangles must reach into to be met.
    pub fan: Fan,
    /// Whether any leaves a primitive.
    pub leaving: bool,
    /// A bit for each that is asked for.
    pub asked: u32,
    /// Where hits count.
    pub interval: Interval,
}

/// The lanes of one vector, of which the first is `at`. A vector holds no more than half of all.
#[inline(always)]
pub fn vector<S: Simd>(simd: S, lanes: &Lanes<MOST>, at: usize) -> S::f32s {
    S::f32s::from_slice(simd, &lanes[place::<S>(at)..place::<S>(at) + S::f32s::LEN])
}

/// The same to be written.
#[inline(always)]
pub fn vector_of<S: Simd, T>(lanes: &mut [T; MOST], at: usize) -> &mut [T] {
    &mut lanes[place::<S>(at)..place::<S>(at) + S::f32s::LEN]
}

/// The same, but certain to be a place where a vector begins.
#[inline(always)]
fn place<S: Simd>(at: usize) -> usize {
    (at % MOST) & !(S::f32s::LEN - 1)
}

#[inline(always)]
fn vectors<S: Simd>(simd: S, lanes: &[Lanes<MOST>; 3], at: usize) -> Vectors<S::f32s> {
    [vector(simd, &lanes[0], at), vector(simd, &lanes[1], at), vector(simd, &lanes[2], at)]
}

impl<'p> Bundle<'p> {
    /// Of these rays.
    #[inline(always)]
    pub fn new<S: Simd>(
        simd: S,
        (packet, frustum): (&'p Packet<MOST>, &'p Frustum),
        rays: &'p [Ray],
        asked: u32,
        interval: Interval,
        bounds: &Bounds,
    ) -> Self {
        let leaving = rays.iter().fold(false, |some, ray| some | (ray.home != Ray::ANYWHERE));
        let count = rays.len().next_multiple_of(RAYS);
        let fan = Fan::around(simd, packet, count, interval.min < 0.0, bounds);
        Self { packet, frustum, rays, fan, leaving, asked, interval }
    }
}

impl Bundle<'_> {
    /// A bit for each ray that may meet the box of a node's child no later than its own limit.
    #[inline(always)]
    pub fn meeting<S: Simd>(&self, simd: S, node: &WideNode, child: usize, limits: &Lanes<MOST>) -> u32 {
        let mut bits = 0;
        for at in (0..self.rays.len()).step_by(S::f32s::LEN) {
            let mut near = S::f32s::splat(simd, self.interval.min);
            let mut far = vector(simd, limits, at);
            for axis in 0..3 {
                let first = (self.frustum.backward >> axis & 1) as usize;
                let inverse = vector(simd, &self.packet.inverse[axis], at);
                let enter = S::f32s::splat(simd, node.side[axis][first][child]);
                let leave = S::f32s::splat(simd, node.side[axis][first ^ 1][child]);
                near = near.max(enter.mul_sub(inverse, vector(simd, &self.packet.near_offset[axis], at)));
                far = far.min(leave.mul_sub(inverse, vector(simd, &self.packet.far_offset[axis], at)));
            }
            bits |= (near.simd_le(far).to_bitmask() as u32) << at;
        }
        bits & self.asked
    }

    /// The rays of a vector, prepared for triangles.
    #[inline(always)]
    pub fn lines<S: Simd>(&self, simd: S, at: usize) -> Rays<S::f32s> {
        let p = self.packet;
        let errors = [
            vector(simd, &p.reach, at),
            vector(simd, &p.weight, at),
            vector(simd, &p.along, at),
            vector(simd, &p.depth, at),
            vector(simd, &p.floor, at),
        ];
        let lines = [vectors(simd, &p.origin, at), vectors(simd, &p.direction, at)];
        Rays::new(simd, lines, errors, self.interval.min)
    }

    /// Those of some rays of a vector, a bit for each, that do not leave the primitive of this number.
    #[inline(always)]
    pub fn not_leaving(&self, at: usize, rays: u32, primitive: u32) -> u32 {
        let mut others = rays;
        if !self.leaving {
            return others;
        }
        for lane in lanes_of(rays) {
            others &= !(u32::from(self.rays[at + lane].home == primitive) << lane);
        }
        others
    }
}

impl<S: Simd> Way<S> for Bundle<'_> {
    #[inline(always)]
    fn backward(&self) -> u32 {
        self.frustum.backward
    }

    #[inline(always)]
    fn meet(&self, simd: S, node: &WideNode, max: f32, enter: &mut [f32; WIDTH]) -> u32 {
        self.frustum.meet(simd, node, self.interval.min, max, enter) & self.fan.entering(simd, node)
    }
}

/// The numbers of the bits that are set.
#[inline(always)]
pub fn lanes_of(mut bits: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lane = bits.trailing_zeros() as usize;
        (bits != 0).then(|| {
            bits &= bits - 1;
            lane % MOST
        })
    })
}
