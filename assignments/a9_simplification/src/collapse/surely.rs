//! What a step surely keeps of the shapes around an edge: single precision, eight faces at a time.

use crate::collapse::rim::{MOST, Rim};
use crate::collapse::ring::{FOLDED, LEAST_COSINE, LEAST_QUALITY};
use common::math::Vec3;
use common::math::lanes::{LANES, Vectors, add, dot, each, subtract};
use common::simd::{Select, Simd, SimdBase, SimdMask, f32x8, mask32x8, u32x8};

/// What holds by so much in single precision surely holds: far more than its rounding, as slivers are left to others.
const MARGIN: f32 = 1.05;
/// A sliver is what has less than this share of the quality that a sliver has.
const CLEAR: f32 = 4.0;
/// A right angle is not what has more than this cosine.
const CLEAR_COSINE: f32 = 0.03;
impl Rim {
    /// Whether nothing turns over, becomes a sliver or is folded, before or after.
    #[inline(always)]
    pub(super) fn keeps_shape<S: Simd>(&self, simd: S, place: Vec3) -> bool {
        let zero = f32x8::splat(simd, 0.0);
        let [mut before, mut after] = [[[zero; 3]; MOST / LANES]; 2];
        let [mut sum_before, mut sum_after] = [[zero; 3]; 2];
        let blocks = self.count.div_ceil(LANES);
        for block in 0..blocks {
            let Some(normals) = self.normals(simd, block * LANES, place) else { return false };
            [before[block], after[block]] = normals;
            sum_before = add(sum_before, before[block]);
            sum_after = add(sum_after, after[block]);
        }
        let (opposite, other) = (self.point(0), self.point(self.of_start));
        let vanish = [self.edge.cross(opposite), other.cross(self.edge)];
        let (before_all, after_all) = (sum(sum_before) + vanish[0] + vanish[1], sum(sum_after));
        let folded = FOLDED as f32 * MARGIN;
        if !vanish.iter().all(|normal| is_along(*normal, before_all, folded)) {
            return false;
        }
        for block in 0..blocks {
            let along = are_along(simd, before[block], before_all, folded)
                & are_along(simd, after[block], after_all, CLEAR_COSINE);
            if !is_all(along | !are_below(simd, self.count, block * LANES)) {
                return false;
            }
        }
        true
    }

    /// Normals of eight faces before and after, zero where there are none, if none turns over or becomes a sliver.
    #[inline(always)]
    fn normals<S: Simd>(&self, simd: S, first: usize, place: Vec3) -> Option<[Vectors<f32x8<S>>; 2]> {
        let (zero, of) = (f32x8::splat(simd, 0.0), |x: f32| f32x8::splat(simd, x));
        let lanes = |axis: usize, at: usize| f32x8::from_slice(simd, &self.points[axis][at..at + LANES]);
        let p = [lanes(0, first), lanes(1, first), lanes(2, first)];
        let q = [lanes(0, first + 1), lanes(1, first + 1), lanes(2, first + 1)];
        // Faces at the start of the edge come first; that is where the origin is.
        let at_start = are_below(simd, self.of_start, first);
        let end = |x: f32| at_start.select(zero, of(x));
        let from = [end(self.edge.x), end(self.edge.y), end(self.edge.z)];
        let to = [of(place.x), of(place.y), of(place.z)];
        let (before, size_before) = face(from, p, q);
        let (after, size_after) = face(to, p, q);
        let (before2, after2) = (dot(before, before), dot(after, after));
        let least = of((LEAST_QUALITY * LEAST_QUALITY / 12.0) as f32 * CLEAR);
        let is_no_sliver = after2.simd_gt(least * size_after * size_after)
            & before2.simd_gt(least * size_before * size_before);
        let cosine = dot(before, after);
        let turn = of((LEAST_COSINE * LEAST_COSINE) as f32 * MARGIN);
        let has_not_turned = cosine.simd_gt(zero) & (cosine * cosine).simd_gt(turn * before2 * after2);
        let look = self.looks(simd, first);
        let along = dot(look, after);
        // The largest component is 511.
        let clear = of(511.0 * 511.0 * CLEAR_COSINE * CLEAR_COSINE);
        let looks_along = along.simd_gt(zero) & (along * along).simd_gt(of(3.0) * clear * after2);
        let is_there = are_below(simd, self.count, first);
        let is_fine = is_no_sliver & has_not_turned & looks_along;
        let there = |x: f32x8<S>| is_there.select(x, zero);
        is_all(is_fine | !is_there).then(|| [each(before, there), each(after, there)])
    }

    #[inline(always)]
    fn point(&self, i: usize) -> Vec3 {
        Vec3::new(self.points[0][i], self.points[1][i], self.points[2][i])
    }

    /// What eight faces remember.
    #[inline(always)]
    fn looks<S: Simd>(&self, simd: S, first: usize) -> Vectors<f32x8<S>> {
        let of = |x: u32| u32x8::splat(simd, x);
        // Ten bits for each component; that of the sign is turned, so that all are 512 more than they are.
        let packed = u32x8::from_slice(simd, &self.looks[first..first + LANES]) ^ of(0x2008_0200);
        let component =
            |shift: u32| simd.cvt_f32_u32x8((packed >> shift) & of(1023)) - f32x8::splat(simd, 512.0);
        [component(0), component(10), component(20)]
    }
}

/// Which of eight numbers from `first` on are below another.
#[inline(always)]
fn are_below<S: Simd>(simd: S, limit: usize, first: usize) -> mask32x8<S> {
    let eight = f32x8::from_slice(simd, &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
    eight.simd_lt(f32x8::splat(simd, limit as f32 - first as f32))
}

/// Normals of faces, and the sums of their squared sides.
#[inline(always)]
fn face<S: Simd>(
    from: Vectors<f32x8<S>>,
    p: Vectors<f32x8<S>>,
    q: Vectors<f32x8<S>>,
) -> (Vectors<f32x8<S>>, f32x8<S>) {
    let (u, v, w) = (subtract(p, from), subtract(q, from), subtract(q, p));
    let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    (normal, dot(u, u) + dot(v, v) + dot(w, w))
}

#[inline(always)]
fn is_all<S: Simd>(mask: mask32x8<S>) -> bool {
    mask.to_bitmask() == 0xff
}

#[inline(always)]
fn sum<S: Simd>([x, y, z]: Vectors<f32x8<S>>) -> Vec3 {
    let sum = |v: f32x8<S>| {
        let mut lanes = [0.0; LANES];
        v.store_slice(&mut lanes);
        let [a, b, c, d, e, f, g, h] = lanes;
        ((a + b) + (c + d)) + ((e + f) + (g + h))
    };
    Vec3::new(sum(x), sum(y), sum(z))
}

/// Whether normals make an angle with `all` whose cosine is surely more than this.
#[inline(always)]
fn are_along<S: Simd>(simd: S, normals: Vectors<f32x8<S>>, all: Vec3, cosine: f32) -> mask32x8<S> {
    let of = |x: f32| f32x8::splat(simd, x);
    let along = dot(normals, [of(all.x), of(all.y), of(all.z)]);
    let least = of(cosine * cosine * all.length_squared());
    along.simd_gt(of(0.0)) & (along * along).simd_gt(least * dot(normals, normals))
}

#[inline(always)]
fn is_along(normal: Vec3, all: Vec3, cosine: f32) -> bool {
    let along = normal.dot(all);
    along > 0.0 && along * along > cosine * cosine * all.length_squared() * normal.length_squared()
}
