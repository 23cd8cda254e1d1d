//! A ray of a stream: one cache line, first what boxes want to know, then what triangles do.

use super::beam::Beam;
use super::packet::RAYS;
use super::single;
use common::math::lanes::{Vectors, turn};
use common::shape::faces::Rays;
use common::shape::filter::{Errors, Filter};
use common::simd::{Simd, SimdBase, f32x4, f32x8};

/// The quarters are loaded and stored at once.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
pub struct Record {
    /// Inverse of the direction; origin times inverse; then until where boxes and until where hits
    /// matter.
    boxes: [[f32; 4]; 2],
    /// Origin; direction; the two numbers of [`Errors::new`].
    line: [[f32; 4]; 2],
}

impl Record {
    /// No ray.
    pub const NONE: Self = Self { boxes: [[0.0; 4]; 2], line: [[0.0; 4]; 2] };

    /// Makes records of origins, directions and their inverses, the two numbers of [`Errors::new`],
    /// and until where boxes and until where hits matter.
    #[inline(always)]
    pub fn put<S: Simd>(
        simd: S,
        records: &mut [Self],
        [o, d, i]: [Vectors<f32x8<S>>; 3],
        [far, step]: [f32x8<S>; 2],
        [limit, last]: [f32x8<S>; 2],
    ) {
        let offset = [o[0] * i[0], o[1] * i[1], o[2] * i[2]];
        put_quarter(simd, records, [i[0], i[1], i[2], offset[0]], |r| &mut r.boxes[0]);
        put_quarter(simd, records, [offset[1], offset[2], limit, last], |r| &mut r.boxes[1]);
        put_quarter(simd, records, [o[0], o[1], o[2], d[0]], |r| &mut r.line[0]);
        put_quarter(simd, records, [d[1], d[2], far, step], |r| &mut r.line[1]);
    }

    /// The ray, prepared for triangles.
    #[inline(always)]
    pub fn filter(&self) -> Filter {
        let [[ox, oy, oz, dx], [dy, dz, far, step]] = self.line;
        Filter { origin: [ox, oy, oz], direction: [dx, dy, dz], errors: Errors::new(far, step) }
    }

    /// The ray, prepared for boxes that are to be made wider by `room`; the signs of its direction
    /// are those of `octant`.
    #[inline(always)]
    pub fn beam(&self, room: f32, octant: u32) -> Beam {
        let [[ix, iy, iz, x], [y, z, _, _]] = self.boxes;
        let [ex, ey, ez] = [room * ix.abs(), room * iy.abs(), room * iz.abs()];
        Beam::new([ix, iy, iz], [x + ex, y + ey, z + ez], [x - ex, y - ey, z - ez], octant)
    }

    /// Boxes that are entered later do not matter.
    #[inline(always)]
    pub fn limit(&self) -> f32 {
        self.boxes[1][2]
    }

    /// Hits later than this do not matter.
    #[inline(always)]
    pub fn last(&self) -> f32 {
        self.boxes[1][3]
    }

    /// Hits later than `last` do not matter from now on.
    #[inline(always)]
    pub fn end_at(&mut self, last: f32, margin: f32) {
        let [_, _, limit, end] = &mut self.boxes[1];
        (*limit, *end) = (single::limit(last, margin), last);
    }

    /// What boxes want to know of eight rays: inverses, offsets, limits.
    #[inline(always)]
    pub fn beams<S: Simd>(simd: S, records: [&Self; RAYS]) -> [f32x8<S>; 7] {
        let [ix, iy, iz, x] = columns(simd, quarters(records, |r| &r.boxes[0]));
        let [y, z, limit, _] = columns(simd, quarters(records, |r| &r.boxes[1]));
        [ix, iy, iz, x, y, z, limit]
    }

    /// What triangles want to know of eight rays whose hits count from `min` on.
    #[inline(always)]
    pub fn lines<S: Simd>(simd: S, records: [&Self; RAYS], min: f32) -> Rays<f32x8<S>> {
        let [ox, oy, oz, dx] = columns(simd, quarters(records, |r| &r.line[0]));
        let [dy, dz, far, step] = columns(simd, quarters(records, |r| &r.line[1]));
        Rays::new(simd, [[ox, oy, oz], [dx, dy, dz]], Errors::abreast(simd, far, step), min)
    }
}

/// Four numbers of each of eight records.
#[inline(always)]
fn quarters<'r>(
    [a, b, c, d, e, f, g, h]: [&'r Record; RAYS],
    quarter: impl Fn(&'r Record) -> &'r [f32; 4],
) -> [&'r [f32; 4]; RAYS] {
    [quarter(a), quarter(b), quarter(c), quarter(d), quarter(e), quarter(f), quarter(g), quarter(h)]
}

/// Four numbers of each of eight rays, side by side.
#[inline(always)]
pub fn columns<S: Simd>(simd: S, [a, b, c, d, e, f, g, h]: [&[f32; 4]; RAYS]) -> [f32x8<S>; 4] {
    let of = |row| f32x4::from_slice(simd, row);
    let low = turn(simd, [of(a), of(b), of(c), of(d)]);
    let high = turn(simd, [of(e), of(f), of(g), of(h)]);
    [
        simd.combine_f32x4(low[0], high[0]),
        simd.combine_f32x4(low[1], high[1]),
        simd.combine_f32x4(low[2], high[2]),
        simd.combine_f32x4(low[3], high[3]),
    ]
}

/// The same turned back: first those of the first four rays.
#[inline(always)]
pub fn rows<S: Simd>(simd: S, [a, b, c, d]: [f32x8<S>; 4]) -> [[f32x4<S>; 4]; 2] {
    // Not in a closure, which would be compiled for other instructions.
    let (a, e) = simd.split_f32x8(a);
    let (b, f) = simd.split_f32x8(b);
    let (c, g) = simd.split_f32x8(c);
    let (d, h) = simd.split_f32x8(d);
    [turn(simd, [a, b, c, d]), turn(simd, [e, f, g, h])]
}

/// Puts four numbers of each of eight rays into their records.
#[inline(always)]
fn put_quarter<S: Simd>(
    simd: S,
    records: &mut [Record],
    numbers: [f32x8<S>; 4],
    quarter: impl Fn(&mut Record) -> &mut [f32; 4],
) {
    let [low, high] = rows(simd, numbers);
    for lane in 0..RAYS / 2 {
        low[lane].store_slice(quarter(&mut records[lane]));
        high[lane].store_slice(quarter(&mut records[lane + RAYS / 2]));
    }
}
