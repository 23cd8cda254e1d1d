//! Vertices at the same place become one point.
//!
//! Files repeat a position wherever normals or texture coordinates differ on its two sides, and
//! some (STL) wherever triangles meet; to draw edges together one must know that it is one place.

use crate::collapse::surface::NONE;
use common::math::Vec3;

/// Which vertices are at the same place.
pub(super) struct Welded {
    /// For every vertex the number of its point, [`NONE`] if no triangle uses it.
    pub point_of: Vec<u32>,
    /// Where the points are.
    pub places: Vec<Vec3>,
}

/// Welds those vertices that triangles use; points are numbered as they first appear among the
/// vertices. Positions are equal if all bits are, but −0 is 0.
pub(super) fn weld(positions: &[Vec3], triangles: &[[u32; 3]]) -> Welded {
    let mut point_of = vec![NONE; positions.len()];
    for &corner in triangles.as_flattened() {
        point_of[corner as usize] = 0;
    }
    let mut places = Vec::with_capacity(positions.len());
    let mut table = Table::for_entries(positions.len());
    for (point, &at) in point_of.iter_mut().zip(positions).filter(|(point, _)| **point != NONE) {
        *point = table.find_or_add(at, &mut places);
    }
    Welded { point_of, places }
}

/// Open addressing over the places; a slot holds the number of a place or [`NONE`].
struct Table {
    slots: Vec<u32>,
    shift: u32,
}

impl Table {
    fn for_entries(count: usize) -> Self {
        let size = (count + count / 2 + 2).next_power_of_two();
        Self { slots: vec![NONE; size], shift: 64 - size.trailing_zeros() }
    }

    fn find_or_add(&mut self, at: Vec3, places: &mut Vec<Vec3>) -> u32 {
        let mut slot = self.home(at);
        loop {
            match self.slots[slot] {
                NONE => {
                    self.slots[slot] = places.len() as u32;
                    places.push(at);
                    return self.slots[slot];
                }
                found if places[found as usize] == at => return found,
                _ => slot = (slot + 1) & (self.slots.len() - 1),
            }
        }
    }

    /// The slot to look at first: the highest bits of a product (Knuth's multiplicative hashing).
    fn home(&self, at: Vec3) -> usize {
        // Adding 0 turns −0 into 0, which compares equal and so must hash equal.
        let [x, y, z] = (at + Vec3::ZERO).to_array().map(|c| u64::from(c.to_bits()));
        let mixed = (x ^ (y << 32)).wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ (z << 17);
        ((mixed ^ (mixed >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9) >> self.shift) as usize
    }
}
