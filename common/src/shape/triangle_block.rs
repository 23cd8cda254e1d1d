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
        let mut block = Self { corner: [[[0.0; LANES]; 3]; 3], index: [0; LANES], len: 0 };
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
        self.corner.map(|c| Vec3::new(c[0][lane], c[1][lane], c[2][lane]))
    }

    /// A bit for every used lane that the filter cannot discard for `interval`.
    ///
    /// Written without closures: one that is not inlined would lose the instructions that
    /// `simd` stands for.
    #[inline(always)]
    pub fn candidates<S: Simd>(&self, simd: S, filter: &Filter, interval: Interval) -> u32 {
        let oz = f32x8::splat(simd, filter.origin[2]);
        let za = self.load(simd, 0, filter.axes[2]) - oz;
        let zb = self.load(simd, 1, filter.axes[2]) - oz;
        let zc = self.load(simd, 2, filter.axes[2]) - oz;
        let [ax, bx, cx] = self.sheared(simd, filter, 0, [za, zb, zc]);
        let [ay, by, cy] = self.sheared(simd, filter, 1, [za, zb, zc]);

        let (u, v, w) = (cx * by - cy * bx, ax * cy - ay * cx, bx * ay - by * ax);
        let reach_x = ax.abs().max(bx.abs()).max(cx.abs());
        let reach = reach_x.max(ay.abs()).max(by.abs()).max(cy.abs());
        let coordinate = f32x8::splat(simd, 4.0 * filter.coordinate_error);
        let floor = f32x8::splat(simd, filter.error_floor);
        let error = reach * (coordinate + reach * f32x8::splat(simd, 8.0 * UNIT)) + floor;
        // Discard on mixed certain signs; NaN and infinity compare false and are kept.
        let outside = u.min(v).min(w).simd_lt(-error) & u.max(v).max(w).simd_gt(error);

        let (near, far) = filter.depth_range(interval);
        let (nearest, farthest) = (za.min(zb).min(zc), za.max(zb).max(zc));
        let beyond = nearest.simd_gt(f32x8::splat(simd, far)) | farthest.simd_lt(f32x8::splat(simd, near));
        !(outside | beyond).to_bitmask() as u32 & ((1 << self.len) - 1)
    }

    #[inline(always)]
    fn load<S: Simd>(&self, simd: S, vertex: usize, axis: usize) -> f32x8<S> {
        f32x8::from_slice(simd, &self.corner[vertex][axis])
    }

    /// The three corners' coordinates along one of the two axes across the ray.
    #[inline(always)]
    fn sheared<S: Simd>(&self, simd: S, filter: &Filter, across: usize, z: [f32x8<S>; 3]) -> [f32x8<S>; 3] {
        let axis = filter.axes[across];
        let origin = f32x8::splat(simd, filter.origin[across]);
        let shear = f32x8::splat(simd, filter.shear[across]);
        [
            self.load(simd, 0, axis) - origin - shear * z[0],
            self.load(simd, 1, axis) - origin - shear * z[1],
            self.load(simd, 2, axis) - origin - shear * z[2],
        ]
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
