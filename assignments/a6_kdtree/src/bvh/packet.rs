//! Up to eight rays side by side, prepared for boxes and triangles.

pub use super::abreast::RAYS;

use super::abreast::columns;
use super::beam::Beam;
use super::slabs::{ORDINARY, Slabs};
use common::math::{Bounds, Vec3};
use common::ray::Ray;
use common::shape::filter::{Errors, Filter, MARGIN};
use common::simd::{Simd, SimdBase, SimdMask, f32x8};
use std::ops::Range;

/// A bit for each ray.
pub const EVERY: u32 = (1 << RAYS) - 1;

/// One number for each ray.
pub type Lanes<const N: usize = RAYS> = [f32; N];

/// The rays, one axis after the other, and what their tests want to know.
#[repr(align(32))]
pub struct Packet<const N: usize = RAYS> {
    /// Origins, by axis.
    pub origin: [Lanes<N>; 3],
    /// Directions, by axis.
    pub direction: [Lanes<N>; 3],
    /// Inverse of the direction; large but finite where the ray runs along the slab.
    pub inverse: [Lanes<N>; 3],
    /// Bound of the error of where the ray meets a side, in units of t.
    pub error: [Lanes<N>; 3],
    /// Origin times inverse, made larger by the error …
    pub near_offset: [Lanes<N>; 3],
    /// … and smaller.
    pub far_offset: [Lanes<N>; 3],
    /// How wrong tests of triangles may be; see [`Errors`].
    pub reach: Lanes<N>,
    pub(super) weight: Lanes<N>,
    pub(super) along: Lanes<N>,
    pub(super) depth: Lanes<N>,
    pub(super) floor: Lanes<N>,
    /// A bit for every ray that can hit anything at all.
    pub usable: u32,
    /// A bit for every ray whose box tests are sure not to overflow.
    pub ordinary: u32,
    /// By axis, a bit for every ray that meets the high side first.
    pub backward: [u32; 3],
}

impl Packet {
    /// Prepares one to eight rays for a tree within `bounds`; unused places repeat the last.
    #[inline(always)]
    pub fn of<S: Simd>(simd: S, rays: &[Ray], bounds: &Bounds) -> Self {
        let mut packet = Self::EMPTY;
        packet.put(simd, 0, rays, bounds);
        packet
    }
}

impl<const N: usize> Packet<N> {
    /// The same for the eight places from `at` on.
    #[inline(always)]
    pub fn put<S: Simd>(&mut self, simd: S, at: usize, rays: &[Ray], bounds: &Bounds) {
        let [origin, direction] = columns(simd, rays, rays[rays.len() - 1]);
        let zero = f32x8::splat(simd, 0.0);
        let (mut far, mut step) = (zero, zero);
        let (lanes, eight) = (at..at + RAYS, EVERY << at);
        for axis in 0..3 {
            let (o, d) = (origin[axis], direction[axis]);
            let [min, max] = [bounds.min[axis], bounds.max[axis]];
            let slab = Slabs::new(simd, o, d, f32x8::splat(simd, min), f32x8::splat(simd, max));
            o.store_slice(&mut self.origin[axis][lanes.clone()]);
            d.store_slice(&mut self.direction[axis][lanes.clone()]);
            slab.inverse.store_slice(&mut self.inverse[axis][lanes.clone()]);
            slab.error.store_slice(&mut self.error[axis][lanes.clone()]);
            slab.near_offset.store_slice(&mut self.near_offset[axis][lanes.clone()]);
            slab.far_offset.store_slice(&mut self.far_offset[axis][lanes.clone()]);
            let backward = (slab.inverse.simd_lt(zero).to_bitmask() as u32) << at;
            self.backward[axis] = self.backward[axis] & !eight | backward;
            far = far.max(slab.far);
            step = step.max(d.abs());
        }
        let usable = (Ray::are_usable(simd, origin, direction).to_bitmask() as u32) << at;
        self.usable = self.usable & !eight | usable;
        let [reach, weight, along, depth, floor] = Errors::abreast(simd, far, step);
        reach.store_slice(&mut self.reach[lanes.clone()]);
        weight.store_slice(&mut self.weight[lanes.clone()]);
        along.store_slice(&mut self.along[lanes.clone()]);
        depth.store_slice(&mut self.depth[lanes.clone()]);
        floor.store_slice(&mut self.floor[lanes.clone()]);
        let ordinary = (far.simd_lt(step * f32x8::splat(simd, ORDINARY)).to_bitmask() as u32) << at;
        self.ordinary = self.ordinary & !eight | ordinary;
        if ordinary != eight {
            self.give_up(lanes);
        }
    }
}

impl Packet<1> {
    /// Prepares one usable ray for a tree within `bounds`.
    #[inline(always)]
    pub fn alone<S: Simd>(simd: S, ray: &Ray, bounds: &Bounds) -> Self {
        let axes =
            |v: Vec3, last: f32| f32x8::from_slice(simd, &[v.x, v.y, v.z, last, last, last, last, last]);
        let d = axes(ray.direction, 1.0);
        let slab = Slabs::new(simd, axes(ray.origin, 0.0), d, axes(bounds.min, 0.0), axes(bounds.max, 0.0));
        let mut lanes = [0.0; RAYS];
        let mut by_axis = |v: f32x8<S>| {
            v.store_slice(&mut lanes);
            [[lanes[0]], [lanes[1]], [lanes[2]]]
        };
        let far = by_axis(slab.far);
        let backward = slab.inverse.simd_lt(f32x8::splat(simd, 0.0)).to_bitmask() as u32;
        let mut packet = Self {
            origin: [[ray.origin.x], [ray.origin.y], [ray.origin.z]],
            direction: [[ray.direction.x], [ray.direction.y], [ray.direction.z]],
            inverse: by_axis(slab.inverse),
            error: by_axis(slab.error),
            near_offset: by_axis(slab.near_offset),
            far_offset: by_axis(slab.far_offset),
            reach: [0.0],
            weight: [0.0],
            along: [0.0],
            depth: [0.0],
            floor: [0.0],
            usable: 1,
            ordinary: 1,
            backward: [backward & 1, backward >> 1 & 1, backward >> 2 & 1],
        };
        let far = greater(greater(far[0][0], far[1][0]), far[2][0]);
        let step = ray.direction.abs().max_element();
        packet.set_errors(0, &Errors::new(far, step));
        packet.ordinary = u32::from(far < ORDINARY * step);
        if packet.ordinary == 0 {
            packet.give_up(0..1);
        }
        packet
    }
}

impl Packet<1> {
    /// Makes every box `room` wider on all sides.
    #[inline(always)]
    pub fn widen(&mut self, room: f32) {
        for axis in 0..3 {
            let error = room * self.inverse[axis][0].abs();
            self.near_offset[axis][0] += error;
            self.far_offset[axis][0] -= error;
        }
    }
}

impl<const N: usize> Packet<N> {
    /// No rays.
    pub const EMPTY: Self = Self {
        origin: [[0.0; N]; 3],
        direction: [[0.0; N]; 3],
        inverse: [[0.0; N]; 3],
        error: [[0.0; N]; 3],
        near_offset: [[0.0; N]; 3],
        far_offset: [[0.0; N]; 3],
        reach: [0.0; N],
        weight: [0.0; N],
        along: [0.0; N],
        depth: [0.0; N],
        floor: [0.0; N],
        usable: 0,
        ordinary: 0,
        backward: [0; 3],
    };

    /// Lets rays that are not ordinary meet every box.
    #[cold]
    fn give_up(&mut self, lanes: Range<usize>) {
        for lane in lanes {
            if self.ordinary >> lane & 1 == 1 {
                continue;
            }
            for axis in 0..3 {
                self.inverse[axis][lane] = 0.0;
                self.error[axis][lane] = f32::INFINITY;
                self.near_offset[axis][lane] = f32::INFINITY;
                self.far_offset[axis][lane] = f32::NEG_INFINITY;
            }
        }
    }

    #[inline(always)]
    fn set_errors(&mut self, lane: usize, errors: &Errors) {
        self.reach[lane] = errors.reach;
        self.weight[lane] = errors.weight;
        self.along[lane] = errors.along;
        self.depth[lane] = errors.depth;
        self.floor[lane] = errors.floor;
    }

    /// One ray, prepared for boxes.
    #[inline(always)]
    pub fn beam(&self, lane: usize) -> Beam {
        let Self { inverse: [ix, iy, iz], near_offset: [nx, ny, nz], far_offset: [fx, fy, fz], .. } = self;
        let inverse = [ix[lane], iy[lane], iz[lane]];
        let near_offset = [nx[lane], ny[lane], nz[lane]];
        let far_offset = [fx[lane], fy[lane], fz[lane]];
        let [bx, by, bz] = self.backward.map(|rays| rays >> lane & 1);
        Beam::new(inverse, near_offset, far_offset, bx | by << 1 | bz << 2)
    }

    /// One ray, prepared for triangles.
    #[inline(always)]
    pub fn filter(&self, lane: usize) -> Filter {
        let [ox, oy, oz] = &self.origin;
        let [dx, dy, dz] = &self.direction;
        Filter {
            origin: [ox[lane], oy[lane], oz[lane]],
            direction: [dx[lane], dy[lane], dz[lane]],
            errors: Errors {
                reach: self.reach[lane],
                weight: self.weight[lane],
                along: self.along[lane],
                depth: self.depth[lane],
                floor: self.floor[lane],
            },
        }
    }

    /// By how much of t two hits must differ for their order to be certain, beside the rounding
    /// of t itself; see [`common::shape::ExactRay::margin`].
    #[inline(always)]
    pub fn margin(&self, lane: usize) -> f32 {
        self.reach[lane] * MARGIN
    }
}

#[inline(always)]
fn greater(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}
