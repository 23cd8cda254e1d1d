//! Vertices at the same place become one point.
//!
//! Files repeat a position wherever normals or texture coordinates differ on its two sides, and
//! some (STL) wherever triangles meet; to draw edges together one must know that it is one place.

use crate::collapse::surface::NONE;
use common::math::Vec3;
use common::mesh::Mesh;

/// Which vertices are at the same place.
pub(super) struct Welded {
    /// For every vertex the number of its point, [`NONE`] if no triangle uses it.
    pub point_of: Vec<u32>,
    /// Where the points are.
    pub places: Vec<Vec3>,
}

/// Welds those vertices that triangles use; points are numbered as they first appear among the
/// vertices. Positions are the same if all coordinates are equal.
pub(super) fn weld(positions: &[Vec3], triangles: &[[u32; 3]]) -> Welded {
    let mut point_of = vec![NONE; positions.len()];
    for &corner in triangles.as_flattened() {
        point_of[corner as usize] = 0;
    }
    let mut places: Vec<Vec3> = Vec::with_capacity(positions.len());
    let mut table = Table::for_entries(positions.len());
    for (point, &at) in point_of.iter_mut().zip(positions).filter(|(point, _)| **point != NONE) {
        let new = places.len() as u32;
        *point = table.find_or_add(hash(&at.to_array(), 0), new, |known| places[known as usize] == at);
        if *point == new {
            places.push(at);
        }
    }
    Welded { point_of, places }
}

/// For every vertex the first that has the same position, normal and texture coordinates.
pub(super) fn same(mesh: &Mesh) -> Vec<u32> {
    let mut table = Table::for_entries(mesh.positions.len());
    let all = |v: usize| (mesh.positions[v], mesh.normals.get(v), mesh.uvs.get(v));
    let first = |v: usize| {
        let normal = mesh.normals.get(v).map_or(0, |normal| hash(&normal.to_array(), 1));
        let uv = mesh.uvs.get(v).map_or(0, |uv| hash(&uv.to_array(), 2));
        let mixed = hash(&mesh.positions[v].to_array(), normal ^ uv);
        table.find_or_add(mixed, v as u32, |known| all(known as usize) == all(v))
    };
    (0..mesh.positions.len()).map(first).collect()
}

/// Multiplies and shifts. Adding 0 turns −0 into 0, which compares equal and so must hash equal.
fn hash(numbers: &[f32], seed: u64) -> u64 {
    numbers.iter().fold(seed, |mixed, &number| {
        let mixed = (mixed ^ u64::from((number + 0.0).to_bits())).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        mixed ^ (mixed >> 29)
    })
}

/// Open addressing; a slot holds the number of an entry or [`NONE`].
struct Table {
    slots: Vec<u32>,
}

impl Table {
    fn for_entries(count: usize) -> Self {
        Self { slots: vec![NONE; (count + count / 2 + 2).next_power_of_two()] }
    }

    /// The known entry that is the same, or else the new one.
    fn find_or_add(&mut self, hash: u64, new: u32, is_same: impl Fn(u32) -> bool) -> u32 {
        let last = self.slots.len() - 1;
        let mut slot = (hash >> 20) as usize & last;
        while self.slots[slot] != NONE && !is_same(self.slots[slot]) {
            slot = (slot + 1) & last;
        }
        if self.slots[slot] == NONE {
            self.slots[slot] = new;
        }
        self.slots[slot]
    }
}
