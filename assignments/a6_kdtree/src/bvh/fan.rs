//! Rays of a row lie in a plane, more or less: those of a camera, and those to a lamp from what these met.
//!
//! The plane's normal n is that of the first and the last direction. Where rays are along n, from their origins
//! until they have left the tree's box, lies between two numbers; a triangle with all corners below or all above
//! them is met by none. With u = 2⁻²⁴ a dot product is wrong by at most 3u of what its terms add up to in magnitude;
//! 8u of all that goes into the two numbers and the corners is taken.

use super::bundle::MOST;
use super::packet::{Packet, RAYS};
use super::wide::WideNode;
use common::math::lanes::greatest_lane;
use common::math::{Bounds, Vec3};
use common::shape::triangle_block::TriangleBlock;
use common::simd::{Simd, SimdBase, SimdFloat, SimdMask, f32x8};

/// See above: 8u.
const ROUNDING: f32 = 1.0 / (1 << 21) as f32;

/// The space between two planes.
pub struct Fan {
    normal: Vec3,
    low: f32,
    high: f32,
}

impl Fan {
    /// What `count` rays, a multiple of eight, do not leave within the box, forward or also `backward`.
    #[inline(always)]
    pub fn around<S: Simd>(
        simd: S,
        packet: &Packet<MOST>,
        count: usize,
        backward: bool,
        bounds: &Bounds,
    ) -> Self {
        let direction = |lane: usize| {
            let [x, y, z] = &packet.direction;
            Vec3::new(x[lane], y[lane], z[lane])
        };
        let normal = direction(0).cross(direction(count - 1));
        let of = |x: f32| f32x8::splat(simd, x);
        let zero = of(0.0);
        let (mut low, mut high) = (of(f32::INFINITY), of(f32::NEG_INFINITY));
        let (mut size, mut sum) = (zero, zero);
        for at in (0..count).step_by(RAYS) {
            let (mut start, mut speed, mut most) = (zero, zero, zero);
            let reach = f32x8::from_slice(simd, &packet.reach[at..at + RAYS]);
            for axis in 0..3 {
                let n = of(normal[axis]);
                let o = f32x8::from_slice(simd, &packet.origin[axis][at..at + RAYS]);
                let d = f32x8::from_slice(simd, &packet.direction[axis][at..at + RAYS]);
                start = n.mul_add(o, start);
                speed = n.mul_add(d, speed);
                most = n.abs().mul_add(d.abs().mul_add(reach, o.abs()), most);
            }
            let way = speed * reach;
            let (end, begin) = (start + way, if backward { start - way } else { start });
            (low, high) = (low.min(end.min(begin)), high.max(end.max(begin)));
            (size, sum) = (size.max(most), sum + most);
        }
        // What overflowed somewhere says nothing.
        if !sum.simd_lt(of(f32::INFINITY)).all_true() {
            return Self { normal: Vec3::ZERO, low: -1.0, high: 1.0 };
        }
        let corner = bounds.min.abs().max(bounds.max.abs());
        let room = ROUNDING * (normal.abs().dot(corner) + greatest_lane(simd, size)) + f32::MIN_POSITIVE;
        let (low, high) = (-greatest_lane(simd, -low), greatest_lane(simd, high));
        Self { normal, low: low - room, high: high + room }
    }

    /// A bit for each child of a node whose box one of the rays may meet.
    #[inline(always)]
    pub fn entering<S: Simd>(&self, simd: S, node: &WideNode) -> u32 {
        let (mut least, mut most) = (f32x8::splat(simd, 0.0), f32x8::splat(simd, 0.0));
        for (axis, sides) in node.side.iter().enumerate() {
            let first = usize::from(self.normal[axis] < 0.0);
            let n = f32x8::splat(simd, self.normal[axis]);
            least = n.mul_add(f32x8::from_slice(simd, &sides[first]), least);
            most = n.mul_add(f32x8::from_slice(simd, &sides[first ^ 1]), most);
        }
        let outside =
            least.simd_gt(f32x8::splat(simd, self.high)) | most.simd_lt(f32x8::splat(simd, self.low));
        !outside.to_bitmask() as u32
    }

    /// A bit for each triangle of a block that one of the rays may meet.
    #[inline(always)]
    pub fn meeting<S: Simd>(&self, simd: S, block: &TriangleBlock) -> u32 {
        block.reaching(simd, self.normal, self.low, self.high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use common::ray::Ray;
    use common::shape::ExactRay;
    use common::shape::triangle::intersect;
    use common::simd::{by_name, dispatch};
    use rand_core::{Rng, SeedableRng};
    use rand_pcg::Pcg64Mcg;

    fn vector(random: &mut Pcg64Mcg) -> Vec3 {
        Vec3::from_array(std::array::from_fn(|_| random.next_u32() as f32 / u32::MAX as f32 - 0.5))
    }

    #[test]
    fn a6t2_what_a_row_of_rays_meets_reaches_into_its_fan() {
        let mut random = Pcg64Mcg::seed_from_u64(4);
        let (mut met, mut reached, mut all) = (0, 0, 0);
        for round in 0..2000 {
            let scale = [1.0, 1e-12, 1e12, 1e30][round % 4];
            // From one place, or to one.
            let (from, to, along) = (vector(&mut random), vector(&mut random), vector(&mut random) * 0.2);
            let rays: [Ray; MOST] = std::array::from_fn(|i| {
                let aside = along * (i as f32 / MOST as f32);
                let origin = if round % 3 == 0 { from + aside } else { from };
                Ray::new(
                    origin * scale,
                    (to - origin + if round % 3 == 0 { Vec3::ZERO } else { aside }) * scale,
                )
            });
            let triangles: [[Vec3; 3]; RAYS] = std::array::from_fn(|i| {
                let at = if i < 4 { rays[i].at(0.7).as_vec3() / scale } else { vector(&mut random) };
                [0, 1, 2].map(|_| (at + vector(&mut random) * 0.05) * scale)
            });
            let bounds = Bounds::of_points(triangles.iter().flatten().copied());
            let block = TriangleBlock::pack((0..).zip(triangles));
            for level in ["baseline", "sse4", "avx2", "avx512"].into_iter().filter_map(by_name) {
                let bits = dispatch!(level, s => {
                    let mut packet = Packet::EMPTY;
                    for at in (0..MOST).step_by(RAYS) {
                        packet.put(s, at, &rays[at..at + RAYS], &bounds);
                    }
                    Fan::around(s, &packet, MOST, round % 2 == 0, &bounds).meeting(s, &block)
                });
                for (i, triangle) in triangles.iter().enumerate() {
                    let counts = |t: f32| round % 2 == 0 || t >= 0.0;
                    let hit = |ray| intersect(&ExactRay::new(ray), triangle).is_some_and(|hit| counts(hit.t));
                    let is_met = rays.iter().any(hit);
                    assert!(bits >> i & 1 == 1 || !is_met, "{round}: {triangle:?}");
                    met += usize::from(is_met);
                    reached += bits as usize >> i & 1;
                    all += 1;
                }
            }
        }
        assert!(met > all / 6 && reached < all * 3 / 4, "{met} met, {reached} reached of {all}");
    }
}
