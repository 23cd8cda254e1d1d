//! Which rays surely pass a ball by, or leave it behind them: single precision.

use super::abreast::Abreast;
use common::math::Vec3;
use common::math::lanes::{each, load, subtract};
use common::ray::Ray;
use common::simd::{Simd, SimdBase, SimdFloat, SimdMask, f32x8};

/// By how much a ball is made larger, as a part of all coordinates that the test works with. With
/// u = 2⁻²⁴ centre and radius are off by u, and so is the way from the centre: together less than 2⁻²¹.
const ROOM: f32 = 1.0 / (1 << 20) as f32;

/// What the products may lose, as a part of |from|²·|d|²: each dot product has at most 3u of the
/// lengths of both its factors, twice over where it is squared; with the roundings of the products
/// themselves less than 20u.
const LOST: f32 = 1.0 / (1 << 18) as f32;

/// What squares may lose below the range of normal numbers.
const FLOOR: f32 = 16.0 * f32::MIN_POSITIVE;

/// Rays in lanes: many, or one in all of them.
pub struct Beams<S: Simd> {
    origin: [f32x8<S>; 3],
    direction: [f32x8<S>; 3],
    /// Sum of the magnitudes of the origin.
    size: f32x8<S>,
    /// Squares of the directions' lengths.
    length_squared: f32x8<S>,
}

/// Balls in lanes: many, or one in all of them.
pub struct Targets<S: Simd> {
    /// Centres, by axis.
    pub center: [f32x8<S>; 3],
    /// Radii.
    pub radius: f32x8<S>,
    /// Sums of the magnitudes of centre and radius.
    pub size: f32x8<S>,
}

impl<S: Simd> Beams<S> {
    #[inline(always)]
    fn new(origin: [f32x8<S>; 3], direction: [f32x8<S>; 3]) -> Self {
        let [x, y, z] = origin;
        Self {
            origin,
            direction,
            size: x.abs() + y.abs() + z.abs(),
            length_squared: dot(direction, direction),
        }
    }

    /// Up to eight rays.
    #[inline(always)]
    pub fn side_by_side(simd: S, rays: &Abreast) -> Self {
        Self::new(load(simd, &rays.origin), load(simd, &rays.direction))
    }

    /// The same ray in all lanes.
    #[inline(always)]
    pub fn everywhere(simd: S, ray: &Ray) -> Self {
        let of = |v: Vec3| each([0, 1, 2], |axis: usize| f32x8::splat(simd, v[axis]));
        Self::new(of(ray.origin), of(ray.direction))
    }

    /// A bit for every lane whose ray may meet the ball; what is behind it is no matter if only
    /// what is `ahead` counts.
    #[inline(always)]
    pub fn meeting(&self, simd: S, balls: &Targets<S>, ahead: bool) -> u32 {
        let of = |x: f32| f32x8::splat(simd, x);
        let from = subtract(self.origin, balls.center);
        let reach = balls.radius + (self.size + balls.size) * of(ROOM);
        let reach_squared = reach.mul_add(reach, of(FLOOR));
        let (away, distance_squared) = (dot(from, self.direction), dot(from, from));
        // |from|²·|d|² − (from·d)² is |d|² times the squared distance of the line from the centre.
        // Fused or not, this only says who is asked.
        let whole = distance_squared * self.length_squared;
        let aside = whole.mul_sub(of(1.0 - LOST), away * away);
        // Written so that NaN is in doubt, and what became infinite, too.
        let mut passed = aside.simd_gt(reach_squared.mul_add(self.length_squared, of(FLOOR)))
            & whole.simd_lt(of(f32::INFINITY));
        if ahead {
            passed |= distance_squared.simd_gt(reach_squared) & away.simd_gt(of(0.0));
        }
        let passed = passed.to_bitmask();
        !passed as u32 & 0xff
    }
}

/// Whatever the order of adding: this only says who is asked.
#[inline(always)]
fn dot<S: Simd>([ax, ay, az]: [f32x8<S>; 3], [bx, by, bz]: [f32x8<S>; 3]) -> f32x8<S> {
    ax.mul_add(bx, ay.mul_add(by, az * bz))
}
