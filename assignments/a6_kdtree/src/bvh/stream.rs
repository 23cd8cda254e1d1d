//! Many rays that go from node to node in lists, prepared for that.
//!
//! All boxes are made wider by one bound of the errors, so that a record need not hold a ray's own.
//! With u = 2⁻²⁴, sides and origins within 3·G of each other along every axis, G being the greatest
//! coordinate of the tree's bounds, a side s that is made wider by r is met at (s ± r)·i − o·i, which
//! is wrong by u·3·G·|i| at most for the wider side, the inverse, the two products and the difference
//! each; r = 16u·3·G is taken.

use super::bundle::lanes_of;
use super::packet::{Packet, RAYS, limits};
use super::record::Record;
use common::math::Bounds;
use common::math::lanes::load;
use common::simd::{Simd, SimdBase, SimdMask, f32x8};

/// Ways that signs of directions can be.
pub const OCTANTS: usize = 8;

/// Records of a stream that the second cache holds beside all else, and rays of which there are fewer
/// make none.
pub const MANY: usize = 4096;

/// Nor do those of which there is less than one for so many nodes: lists would be short.
const NODES_PER_RAY: usize = 16;

/// Farther from the scene's origin than this, times the greatest coordinate, no ray may start.
const FARTHEST: f32 = 2.0;

/// 16u for everything within [`FARTHEST`] and 1.
const ROOM: f32 = (1.0 + FARTHEST) / (1 << 20) as f32;

/// Products of a length and an inverse beyond this, or below its inverse, could overflow or underflow.
const ORDINARY: f32 = (1u64 << 60) as f32;

/// The rays of a stream.
pub struct Stream {
    /// Of packets of rays; not all of a packet need be in the stream.
    pub records: Vec<Record>,
    /// Which of all rays each record belongs to.
    pub numbers: Vec<u32>,
    /// The records of those that are in the stream, by the signs of their directions, a bit for each
    /// axis.
    pub octants: [Vec<u32>; OCTANTS],
    /// By how much boxes are made wider.
    pub room: f32,
    greatest: f32,
}

impl Stream {
    /// An empty one, if so many rays are worth it in a tree of so many nodes within `bounds`.
    pub fn of_many(rays: usize, nodes: usize, bounds: &Bounds) -> Option<Self> {
        if rays < MANY || MANY * NODES_PER_RAY < nodes {
            return None;
        }
        let greatest = bounds.min.abs().max(bounds.max.abs()).max_element();
        Some(Self {
            records: Vec::new(),
            numbers: Vec::new(),
            octants: [const { Vec::new() }; OCTANTS],
            room: greatest * ROOM,
            greatest,
        })
    }

    /// Whether nobody is in it.
    pub fn is_empty(&self) -> bool {
        self.records.is_empty()
    }

    /// Whether those that are in it had better flow before others join.
    pub fn is_full(&self) -> bool {
        self.records.len() >= MANY
    }

    /// Forgets all that are in it.
    pub fn clear(&mut self) {
        self.records.clear();
        self.numbers.clear();
        for octant in &mut self.octants {
            octant.clear();
        }
    }

    /// Takes those of a packet's rays that are `asked` for, a bit for each. They have these numbers,
    /// and hits later than `last` do not matter to them. Returns those that it cannot take: they run
    /// along an axis, or start far away.
    #[inline(always)]
    pub fn take<S: Simd>(
        &mut self,
        simd: S,
        packet: &Packet,
        asked: u32,
        numbers: &[u32; RAYS],
        last: &[f32; RAYS],
    ) -> u32 {
        let of = |x: f32| f32x8::splat(simd, x);
        let (origin, inverse) = (load(simd, &packet.origin), load(simd, &packet.inverse));
        let mut fit = asked;
        for axis in 0..3 {
            let product = inverse[axis].abs() * of(self.greatest);
            let ordinary = product.simd_lt(of(ORDINARY)) & product.simd_gt(of(1.0 / ORDINARY));
            let is_near = origin[axis].abs().simd_le(of(self.greatest * FARTHEST));
            fit &= (ordinary & is_near).to_bitmask() as u32;
        }
        if fit == 0 {
            return asked;
        }
        let last = f32x8::from_slice(simd, last);
        let limit = limits(simd, last, f32x8::from_slice(simd, &packet.reach));
        let first = self.records.len();
        self.numbers.extend_from_slice(numbers);
        // Not from a slice, which would be copied by a call.
        self.records.resize(first + RAYS, Record::NONE);
        Record::put(simd, &mut self.records[first..], packet, [limit, last]);
        for lane in lanes_of(fit) {
            let [bx, by, bz] = packet.backward.map(|rays| rays >> lane & 1);
            self.octants[(bx | by << 1 | bz << 2) as usize].push((first + lane) as u32);
        }
        asked & !fit
    }
}

/// Where some of all rays join a stream.
pub struct Inlet<'s> {
    /// The stream.
    pub stream: &'s mut Stream,
    /// Which of all rays is the first at hand …
    pub first: usize,
    /// … and how far behind it the others are, if they are not one after the other.
    pub numbers: &'s [u32],
}

impl Inlet<'_> {
    /// Which of all rays those at hand are from `first` on, up to the eighth or the last of `rays`,
    /// which is repeated.
    #[inline(always)]
    pub fn eight(&self, first: usize, rays: usize) -> [u32; RAYS] {
        let number = |lane: usize| {
            let ray = first + lane.min(rays - 1);
            let behind = if self.numbers.is_empty() { ray as u32 } else { self.numbers[ray] };
            self.first as u32 + behind
        };
        [number(0), number(1), number(2), number(3), number(4), number(5), number(6), number(7)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use common::math::Vec3;
    use common::ray::Ray;
    use common::simd::{dispatch, level};

    const BOUNDS: Bounds = Bounds { min: Vec3::new(-1.0, 0.0, -3.0), max: Vec3::new(2.0, 4.0, 1.0) };

    #[test]
    fn a6t2_streams_are_for_many_rays() {
        let is_made = |rays, nodes| Stream::of_many(rays, nodes, &BOUNDS).is_some();
        assert!(is_made(MANY, 1) && is_made(MANY, MANY * NODES_PER_RAY));
        assert!(!is_made(MANY - 1, 1) && !is_made(1 << 30, MANY * NODES_PER_RAY + 1));
    }

    #[test]
    fn a6t2_a_stream_takes_rays_that_its_boxes_are_wide_enough_for() {
        let good = Ray::new(Vec3::new(1.0, 2.0, -7.9), Vec3::new(0.1, -2.0, 0.3));
        let mut rays = [good; RAYS];
        rays[1].direction.y = 0.0;
        rays[2].direction.y = 1e-25;
        rays[3].origin.z = -8.1;
        rays[4].direction *= 1e30;
        rays[5].direction = -good.direction;
        let mut stream = Stream::of_many(MANY, 1, &BOUNDS).unwrap();
        let numbers = std::array::from_fn(|i| 100 + i as u32);
        let left = dispatch!(level(), s => {
            let packet = Packet::of(s, &rays, &BOUNDS);
            stream.take(s, &packet, 0b1011_1111, &numbers, &[9.0; RAYS])
        });
        assert_eq!(left, 0b1_1110, "the others are taken, but the one that was not asked for");
        assert_eq!((&stream.octants[2], &stream.octants[5]), (&vec![0, 7], &vec![5]));
        assert_eq!((stream.numbers[7], stream.records[7].last()), (107, 9.0));
        assert!(!stream.is_empty());
        stream.clear();
        assert!(stream.is_empty() && stream.octants.iter().all(Vec::is_empty));
    }
}
