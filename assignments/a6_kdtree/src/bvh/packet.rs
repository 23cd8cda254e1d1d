//! Up to eight rays side by side, prepared for boxes and triangles.

use super::beam::Beam;
use super::slabs::{ORDINARY, Slabs};
use super::wide::{WIDTH, WideNode};
use common::math::{Bounds, Vec3};
use common::ray::Ray;
use common::shape::filter::{Errors, Filter, MARGIN};
use common::simd::{Select, Simd, SimdBase, SimdFloat, SimdMask, f32x8};

/// Rays in a packet.
pub const RAYS: usize = 8;

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
    reach: Lanes<N>,
    weight: Lanes<N>,
    along: Lanes<N>,
    depth: Lanes<N>,
    floor: Lanes<N>,
    /// A bit for every ray that can hit anything at all.
    pub usable: u32,
    /// A bit for every axis along which the high side comes first.
    pub backward: [u32; N],
}

impl Packet {
    /// Prepares one to eight rays for a tree within `bounds`; unused places repeat the last.
    #[inline(always)]
    pub fn of<S: Simd>(simd: S, rays: &[Ray], bounds: &Bounds) -> Self {
        let mut packet = Self::EMPTY;
        for lane in 0..RAYS {
            let ray = &rays[if lane < rays.len() { lane } else { rays.len() - 1 }];
            for axis in 0..3 {
                packet.origin[axis][lane] = ray.origin[axis];
                packet.direction[axis][lane] = ray.direction[axis];
            }
        }
        let (mut far, mut step) = (f32x8::splat(simd, 0.0), f32x8::splat(simd, 0.0));
        let mut usable = (1 << RAYS) - 1;
        for axis in 0..3 {
            let [o, d] = [&packet.origin, &packet.direction].map(|v| f32x8::from_slice(simd, &v[axis]));
            let [min, max] = [bounds.min, bounds.max].map(|corner| f32x8::splat(simd, corner[axis]));
            let slab = Slabs::new(simd, o, d, min, max);
            slab.inverse.store_slice(&mut packet.inverse[axis]);
            slab.error.store_slice(&mut packet.error[axis]);
            slab.near_offset.store_slice(&mut packet.near_offset[axis]);
            slab.far_offset.store_slice(&mut packet.far_offset[axis]);
            far = far.max(slab.far);
            step = step.max(d.abs());
            usable &= o.abs().max(d.abs()).simd_lt(f32x8::splat(simd, f32::INFINITY)).to_bitmask() as u32;
            let backward = slab.inverse.simd_lt(f32x8::splat(simd, 0.0)).to_bitmask() as u32;
            for lane in 0..RAYS {
                packet.backward[lane] |= (backward >> lane & 1) << axis;
            }
        }
        packet.usable = usable & step.simd_gt(f32x8::splat(simd, 0.0)).to_bitmask() as u32;
        let (mut fars, mut steps) = ([0.0; RAYS], [0.0; RAYS]);
        far.store_slice(&mut fars);
        step.store_slice(&mut steps);
        for lane in 0..RAYS {
            packet.set_errors(lane, &Errors::new(fars[lane], steps[lane]));
        }
        let ordinary = far.simd_lt(step * f32x8::splat(simd, ORDINARY)).to_bitmask() as u32;
        if ordinary != (1 << RAYS) - 1 {
            packet.give_up();
        }
        packet
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
            backward: [slab.inverse.simd_lt(f32x8::splat(simd, 0.0)).to_bitmask() as u32 & 7],
        };
        let far = greater(greater(far[0][0], far[1][0]), far[2][0]);
        let step = ray.direction.abs().max_element();
        packet.set_errors(0, &Errors::new(far, step));
        let ordinary = far < ORDINARY * step;
        if !ordinary {
            packet.give_up();
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
        backward: [0; N],
    };

    /// Lets all rays meet every box.
    #[cold]
    fn give_up(&mut self) {
        self.inverse = [[0.0; N]; 3];
        self.error = [[f32::INFINITY; N]; 3];
        self.near_offset = [[f32::INFINITY; N]; 3];
        self.far_offset = [[f32::NEG_INFINITY; N]; 3];
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
        Beam::new(inverse, near_offset, far_offset, self.backward[lane])
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

impl Packet {
    /// A bit for every ray that may meet the box of a node's child between `min` and its own
    /// entry of `max`. All rays must have the directions' signs `backward`.
    #[inline(always)]
    pub fn rays_meeting<S: Simd>(
        &self,
        simd: S,
        node: &WideNode,
        child: usize,
        backward: u32,
        min: f32,
        max: &Lanes,
    ) -> u32 {
        let mut near = f32x8::splat(simd, min);
        let mut far = f32x8::from_slice(simd, max);
        for axis in 0..3 {
            let first = (backward >> axis & 1) as usize;
            let inverse = f32x8::from_slice(simd, &self.inverse[axis]);
            let enter = f32x8::splat(simd, node.side[axis][first][child]);
            let leave = f32x8::splat(simd, node.side[axis][first ^ 1][child]);
            near = near.max(enter.mul_sub(inverse, f32x8::from_slice(simd, &self.near_offset[axis])));
            far = far.min(leave.mul_sub(inverse, f32x8::from_slice(simd, &self.far_offset[axis])));
        }
        near.simd_le(far).to_bitmask() as u32
    }
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

/// The one of some children, a bit for each, that is entered first by the order of centres
/// along the node's axis, for a ray of these signs.
#[inline(always)]
pub fn first_child(lanes: u32, axis: u32, backward: u32) -> usize {
    let (low, high) = (lanes.trailing_zeros(), 31 - lanes.leading_zeros());
    (if backward >> axis & 1 == 0 { low } else { high }) as usize % WIDTH
}

#[inline(always)]
fn greater(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}
