//! Eight triangles against one ray, in `f32`, to discard what is surely missed.
//!
//! The filter shears space so that the ray runs along an axis (Woop et al. 2013) and evaluates
//! the edge functions in single precision beside a bound of their error. A lane is discarded
//! only if the line certainly passes outside, or the triangle certainly lies outside the
//! interval; every other lane is decided by [`super::triangle::intersect`]. So the filter may
//! use any instructions: it cannot change a picture.
//!
//! Error bound, with u = 2⁻²⁴, M ≥ |vertex − origin|∞ and K = largest sheared coordinate: a
//! sheared coordinate x − s·z carries at most 6uM (two differences, a quotient, a product, a
//! difference), taken as E = 8uM; an edge function at most 4EK + 2E² + 4uK² from coordinates
//! and its own rounding, taken as K(4E + 8uK) + 2E² and one smallest normal for underflow.

use crate::math::{Bounds, Interval, Vec3};
use crate::ray::Ray;
use crate::simd::{Simd, SimdBase, SimdMask, f32x8};

/// How many triangles a block holds.
pub const LANES: usize = 8;

const UNIT: f32 = 1.0 / (1 << 24) as f32;

/// Eight triangles, coordinates side by side: `corner[vertex][axis][lane]`.
#[derive(Clone, Copy, Debug)]
pub struct TriangleBlock {
    corner: [[[f32; LANES]; 3]; 3],
    /// Index of each lane's triangle in the caller's array; lanes past `len` repeat the last.
    pub index: [u32; LANES],
    /// How many lanes are in use, 1 to 8.
    pub len: u32,
}

impl TriangleBlock {
    /// Packs up to eight triangles with their indices. Unused lanes are NaN-free copies.
    ///
    /// # Panics
    /// If `triangles` yields nothing.
    pub fn pack(triangles: impl IntoIterator<Item = (u32, [Vec3; 3])>) -> Self {
        let mut block = Self {
            corner: [[[0.0; LANES]; 3]; 3],
            index: [0; LANES],
            len: 0,
        };
        for (lane, (index, vertices)) in triangles.into_iter().take(LANES).enumerate() {
            block.set(lane, index, &vertices);
            block.len = lane as u32 + 1;
        }
        assert!(block.len > 0, "a block needs a triangle");
        for lane in block.len as usize..LANES {
            block.copy_lane(block.len as usize - 1, lane);
        }
        block
    }

    fn set(&mut self, lane: usize, index: u32, vertices: &[Vec3; 3]) {
        for (corner, vertex) in self.corner.iter_mut().zip(vertices) {
            for axis in 0..3 {
                corner[axis][lane] = vertex[axis];
            }
        }
        self.index[lane] = index;
    }

    fn copy_lane(&mut self, from: usize, to: usize) {
        for corner in &mut self.corner {
            for axis in corner {
                axis[to] = axis[from];
            }
        }
        self.index[to] = self.index[from];
    }

    /// The corners of one lane.
    #[inline]
    pub fn vertices(&self, lane: usize) -> [Vec3; 3] {
        self.corner
            .map(|c| Vec3::new(c[0][lane], c[1][lane], c[2][lane]))
    }

    /// A bit for every used lane that the filter cannot discard for `interval`.
    #[inline(always)]
    pub fn candidates<S: Simd>(&self, simd: S, filter: &Filter, interval: Interval) -> u32 {
        let [kx, ky, kz] = filter.axes;
        let splat = |x: f32| f32x8::splat(simd, x);
        let [ox, oy, oz] = filter.origin.map(splat);
        let [sx, sy] = filter.shear.map(splat);
        let load = |vertex: usize, axis: usize| f32x8::from_slice(simd, &self.corner[vertex][axis]);
        let [za, zb, zc] = [0, 1, 2].map(|v| load(v, kz) - oz);
        let [ax, bx, cx] = [(0, za), (1, zb), (2, zc)].map(|(v, z)| load(v, kx) - ox - sx * z);
        let [ay, by, cy] = [(0, za), (1, zb), (2, zc)].map(|(v, z)| load(v, ky) - oy - sy * z);

        let (u, v, w) = (cx * by - cy * bx, ax * cy - ay * cx, bx * ay - by * ax);
        let reach = ax
            .abs()
            .max(bx.abs())
            .max(cx.abs())
            .max(ay.abs())
            .max(by.abs())
            .max(cy.abs());
        let e = splat(filter.coordinate_error);
        let error =
            reach * (e * splat(4.0) + reach * splat(8.0 * UNIT)) + splat(filter.error_floor);
        // Discard on mixed certain signs; NaN and infinity compare false and are kept.
        let outside = u.min(v).min(w).simd_lt(-error) & u.max(v).max(w).simd_gt(error);

        let (near, far) = filter.depth_range(interval);
        let (nearest, farthest) = (za.min(zb).min(zc), za.max(zb).max(zc));
        let beyond = nearest.simd_gt(splat(far)) | farthest.simd_lt(splat(near));
        !(outside | beyond).to_bitmask() as u32 & ((1 << self.len) - 1)
    }
}

/// A ray prepared for [`TriangleBlock::candidates`].
#[derive(Clone, Copy, Debug)]
pub struct Filter {
    axes: [usize; 3],
    origin: [f32; 3],
    shear: [f32; 2],
    along: f32,
    coordinate_error: f32,
    error_floor: f32,
}

impl Filter {
    /// Prepares a usable ray for triangles that lie within `bounds`.
    #[inline]
    pub fn new(ray: &Ray, bounds: &Bounds) -> Self {
        let d = ray.direction;
        let size = d.abs();
        let z = if size.x > size.y && size.x > size.z {
            0
        } else if size.y > size.z {
            1
        } else {
            2
        };
        let axes = [(z + 1) % 3, (z + 2) % 3, z];
        let error = 8.0 * UNIT * bounds.reach_from(ray.origin);
        Self {
            axes,
            origin: axes.map(|k| ray.origin[k]),
            shear: [d[axes[0]] / d[z], d[axes[1]] / d[z]],
            along: d[z],
            coordinate_error: error,
            error_floor: 2.0 * error * error + f32::MIN_POSITIVE,
        }
    }

    /// The interval as a range of differences along the main axis, widened by more than the
    /// error of the differences and of t.
    #[inline]
    fn depth_range(&self, interval: Interval) -> (f32, f32) {
        let (a, b) = (interval.min * self.along, interval.max * self.along);
        let (low, high) = if a < b { (a, b) } else { (b, a) };
        let pad = |x: f32| self.coordinate_error + x.abs() * (8.0 * UNIT) + f32::MIN_POSITIVE;
        let widen = |x: f32, by: f32| if x.is_finite() { x + by } else { x };
        (widen(low, -pad(low)), widen(high, pad(high)))
    }
}
