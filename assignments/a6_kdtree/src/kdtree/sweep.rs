//! The sweep along one axis, many events at a time.
//!
//! Where no box lies in a plane, every event can be priced by itself: ends come before starts at
//! the same position, so an end that is not the last there counts too much on the right, a start
//! that is not the first too much on the left, and neither is cheaper than the plane really is.
//! So nothing has to be grouped, and what a plane costs is computed side by side.

use super::event::{Event, Kind};
use super::sah::{EMPTY_BONUS, STEP, price, weight};
use common::simd::{self, Simd, SimdBase, dispatch, f32x8};

/// Events that are priced together.
const CHUNK: usize = 32;

/// The node's extent along the axis, and the chance that a ray meets a part of it of length x:
/// face + x·around.
pub struct Line {
    /// Where it begins.
    pub low: f32,
    /// Where it ends.
    pub high: f32,
    /// For a part without length.
    pub face: f32,
    /// Per length.
    pub around: f32,
}

/// A plane and the weight on both sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Where.
    pub at: f32,
    /// Weight below it.
    pub left: u32,
    /// Weight above it.
    pub right: u32,
}

/// The cheapest plane inside the node of sorted events, none of them planar; `total` is the
/// weight of all references.
pub fn cheapest(events: &[Event], line: &Line, total: u32) -> Option<Plane> {
    dispatch!(simd::level(), s => cheapest_in(s, events, line, total))
}

#[inline(always)]
fn cheapest_in<S: Simd>(simd: S, events: &[Event], line: &Line, total: u32) -> Option<Plane> {
    let (mut best, mut found) = (f32::INFINITY, None);
    let (mut left, mut right) = (0, total);
    for events in events.chunks(CHUNK) {
        // The place 0 is a NaN, which is nowhere inside.
        let mut chunk = Chunk { place: [0; CHUNK], left: [0; CHUNK], right: [0; CHUNK] };
        for (i, event) in events.iter().enumerate() {
            let start = event.kind() / Kind::Start as u32;
            let weight = weight(event.is_solid());
            right -= weight * (1 - start);
            (chunk.place[i], chunk.left[i], chunk.right[i]) = (event.place(), left, right);
            left += weight * start;
        }
        let mut costs = [f32::INFINITY; CHUNK];
        chunk.price(line, &mut costs);
        let least = least_of(simd, &costs);
        if least < best {
            let i = costs.iter().position(|cost| *cost == least).unwrap_or(0);
            best = least;
            found = Some(Plane {
                at: Event::position(chunk.place[i]),
                left: chunk.left[i],
                right: chunk.right[i],
            });
        }
    }
    found
}

/// What is before and behind some planes.
struct Chunk {
    place: [u32; CHUNK],
    left: [u32; CHUNK],
    right: [u32; CHUNK],
}

impl Chunk {
    /// What each plane costs; without a branch, so that it becomes vector code.
    #[inline(always)]
    fn price(&self, line: &Line, costs: &mut [f32; CHUNK]) {
        for (i, cost) in costs.iter_mut().enumerate() {
            let at = Event::position(self.place[i]);
            let (left, right) = (self.left[i], self.right[i]);
            let below = (line.face + (at - line.low) * line.around) * price(left);
            let above = (line.face + (line.high - at) * line.around) * price(right);
            let bonus = if (left == 0) | (right == 0) { EMPTY_BONUS } else { 1.0 };
            let sum = (STEP + below + above) * bonus;
            *cost = if (at > line.low) & (at < line.high) { sum } else { f32::INFINITY };
        }
    }
}

#[inline(always)]
fn least_of<S: Simd>(simd: S, costs: &[f32; CHUNK]) -> f32 {
    let mut least = f32x8::splat(simd, f32::INFINITY);
    for costs in costs.chunks_exact(8) {
        least = least.min(f32x8::from_slice(simd, costs));
    }
    let mut lanes = [0.0; 8];
    least.store_slice(&mut lanes);
    lanes.into_iter().fold(f32::INFINITY, |a, b| if b < a { b } else { a })
}
