//! Triangles of any blocks side by side.

use super::triangle_block::{LANES, TriangleBlock};
use crate::math::lanes::{Vectors, load};
use crate::simd::{Bytes, Select, Simd, SimdBase, SimdMask, f32x8, mask32x8, u32x8};

/// The corners of eight triangles. Each is given by its number among all places of all blocks, of which there
/// are eight in each.
///
/// # Panics
/// If there is no such block.
#[inline(always)]
pub fn corners_of<S: Simd>(
    simd: S,
    blocks: &[TriangleBlock],
    numbers: &[u32; LANES],
) -> [Vectors<f32x8<S>>; 3] {
    if S::f32s::LEN < LANES {
        return one_by_one(simd, blocks, numbers);
    }
    let all = u32x8::from_slice(simd, numbers);
    // The four bytes of a lane.
    let lanes = (all & u32x8::splat(simd, LANES as u32 - 1)) * u32x8::splat(simd, 0x0404_0404);
    let bytes = (lanes + u32x8::splat(simd, 0x0302_0100)).to_bytes();
    let [mut a, mut b, mut c] = chosen(blocks, numbers[0], simd, bytes);
    let mut left = !in_block_of(simd, all, numbers[0]) & ((1 << LANES) - 1);
    // Rays beside each other often meet triangles of one block.
    while left != 0 {
        let number = numbers[left.trailing_zeros() as usize % LANES];
        let these = in_block_of(simd, all, number);
        let is_one = mask32x8::from_bitmask(simd, u64::from(these));
        let [d, e, f] = chosen(blocks, number, simd, bytes);
        for axis in 0..3 {
            a[axis] = is_one.select(d[axis], a[axis]);
            b[axis] = is_one.select(e[axis], b[axis]);
            c[axis] = is_one.select(f[axis], c[axis]);
        }
        left &= !these;
    }
    [a, b, c]
}

/// A bit for each triangle that is in the block of another one.
#[inline(always)]
fn in_block_of<S: Simd>(simd: S, all: u32x8<S>, number: u32) -> u32 {
    (all >> 3).simd_eq(u32x8::splat(simd, number >> 3)).to_bitmask() as u32
}

/// In each lane the corners of one of the triangles in the block of this one.
#[inline(always)]
fn chosen<S: Simd>(
    blocks: &[TriangleBlock],
    number: u32,
    simd: S,
    bytes: <u32x8<S> as Bytes>::Bytes,
) -> [Vectors<f32x8<S>>; 3] {
    let block = &blocks[number as usize / LANES];
    let [a, b, c] = block.corners(simd);
    [
        [a[0].swizzle_dyn(bytes), a[1].swizzle_dyn(bytes), a[2].swizzle_dyn(bytes)],
        [b[0].swizzle_dyn(bytes), b[1].swizzle_dyn(bytes), b[2].swizzle_dyn(bytes)],
        [c[0].swizzle_dyn(bytes), c[1].swizzle_dyn(bytes), c[2].swizzle_dyn(bytes)],
    ]
}

/// The same where lanes cannot be chosen fast.
#[inline(always)]
fn one_by_one<S: Simd>(simd: S, blocks: &[TriangleBlock], numbers: &[u32; LANES]) -> [Vectors<f32x8<S>>; 3] {
    let mut corners = [[[0.0; LANES]; 3]; 3];
    for (place, &number) in numbers.iter().enumerate() {
        blocks[number as usize / LANES].copy_corners(number as usize, &mut corners, place);
    }
    [load(simd, &corners[0]), load(simd, &corners[1]), load(simd, &corners[2])]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;
    use crate::math::lanes::store;
    use crate::simd::{by_name, dispatch};
    use rand_core::{Rng, SeedableRng};
    use rand_pcg::Pcg64Mcg;

    #[test]
    fn a6t2_every_lane_holds_its_triangle() {
        const BLOCKS: usize = 5;
        let corner = |i: usize| Vec3::new(i as f32, i as f32 + 0.25, i as f32 + 0.5);
        let triangle = |i: usize| [corner(3 * i), corner(3 * i + 1), corner(3 * i + 2)];
        let pack = |block: usize| {
            let lanes = block * LANES..(block + 1) * LANES;
            TriangleBlock::pack(lanes.map(|i| (i as u32, triangle(i))))
        };
        let blocks: Vec<TriangleBlock> = (0..BLOCKS).map(pack).collect();
        let mut random = Pcg64Mcg::seed_from_u64(6);
        for round in 0..200 {
            // Of few blocks, or of all.
            let most = ((round % BLOCKS + 1) * LANES) as u32;
            let numbers: [u32; LANES] = std::array::from_fn(|_| random.next_u32() % most);
            for level in ["baseline", "sse4", "avx2", "avx512"].into_iter().filter_map(by_name) {
                let [a, b, c] = dispatch!(level, s => s.vectorize(
                    #[inline(always)]
                    || corners_of(s, &blocks, &numbers).map(store),
                ));
                for (lane, &number) in numbers.iter().enumerate() {
                    let found = [a, b, c].map(|v| Vec3::new(v[0][lane], v[1][lane], v[2][lane]));
                    assert_eq!(found, triangle(number as usize), "{numbers:?} {lane}");
                }
            }
        }
    }
}
