//! Ray against triangle: watertight, decided exactly.
//!
//! The line of the ray passes the triangle if it passes all three edges on the same side. The
//! side of edge a→b is the sign of d · ((a−o) × (b−o)). In `f64` that sign is almost always
//! certain; where the rounding error could hide it, it is computed without rounding
//! ([`exact::edge`]), and a line that meets the edge exactly is moved aside by an infinitesimal
//! that is the same for every triangle ([`exact::edge_tie`]). So two triangles that share an
//! edge never disagree: a closed mesh has no gap and no double hit, at edges and at vertices,
//! at any scale and any distance.
//!
//! Source of the idea: Woop, Benthin & Wald, "Watertight Ray/Triangle Intersection", JCGT 2013;
//! here without the shear, so that the decision is that of exact arithmetic on the input.

pub mod abreast;

use super::ExactRay;
use crate::math::{DVec3, UNIT_ROUNDOFF, Vec3, exact, sum3};
use crate::simd::{Level, Simd, SimdBase, SimdMask, dispatch, f64x4, mask64x4};

/// A hit of one triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleHit {
    /// Ray parameter, rounded once; may be infinite if it leaves the range of `f32`.
    pub t: f32,
    /// Barycentric weight of the second vertex, in [0, 1].
    pub u: f32,
    /// Barycentric weight of the third vertex, in [0, 1].
    pub v: f32,
}

/// Relative error of an edge function, generously: eight roundings of 2⁻⁵³ on each of six
/// products of magnitude |d|∞·|a−o|∞·|b−o|∞ are below 2⁻⁴⁷ of one such product.
const EDGE_ERROR: f64 = 1.0 / (1u64 << 47) as f64;

/// Where the line of the ray passes the triangle, front or back, at any t (also negative).
///
/// `None` if it passes outside, edge-on, or the triangle has no area. Both sides count. An edge
/// that the line meets exactly belongs to exactly one of the two triangles that share it.
pub fn intersect(ray: &ExactRay, vertices: &[Vec3; 3]) -> Option<TriangleHit> {
    dispatch!(Level::baseline(), simd => intersect_with(simd, ray, vertices))
}

/// The same with given instructions. The corners go side by side through sums, products, quotients
/// and comparisons, none of them fused, so that every processor gets the same bits.
#[inline(always)]
pub fn intersect_with<S: Simd>(simd: S, ray: &ExactRay, vertices: &[Vec3; 3]) -> Option<TriangleHit> {
    let corner = Corners::of(simd, ray, vertices);
    let weight = corner.edges(simd, ray);
    let error = EDGE_ERROR * ray.reach * corner.reach * corner.reach;
    let certain = in_use(weight.abs().simd_gt(f64x4::splat(simd, error)));
    if certain != ALL {
        return intersect_exactly(ray, vertices);
    }
    let positive = in_use(weight.simd_gt(f64x4::splat(simd, 0.0)));
    if positive != 0 && positive != ALL {
        return None;
    }
    // Certain signs are not yet precise values: in a thin triangle the weights' error moves the
    // point along its length, by at most `error · size / total`.
    let weight = lanes(weight);
    let total = weight[0] + weight[1] + weight[2];
    if error * corner.size() > total.abs() * corner.reach * UNIT_ROUNDOFF {
        return intersect_exactly(ray, vertices);
    }
    Some(corner.hit(simd, ray, weight))
}

/// The same where rounding could hide a sign, or move the point too far along a thin triangle.
#[cold]
#[inline(never)]
fn intersect_exactly(ray: &ExactRay, vertices: &[Vec3; 3]) -> Option<TriangleHit> {
    let mut weight = [0.0; 4];
    let side = exact_sides(ray, vertices, &mut weight);
    let inside = side.iter().all(|&s| s < 0.0) || side.iter().all(|&s| s > 0.0);
    let hit =
        || dispatch!(Level::baseline(), simd => Corners::of(simd, ray, vertices).hit(simd, ray, weight));
    inside.then(hit)
}

/// Four numbers of which three are used, one for each corner.
type Lanes = [f64; 4];

/// The bits of those three.
const ALL: u32 = 7;

/// Which of them a comparison holds for.
#[inline(always)]
fn in_use<S: Simd>(mask: mask64x4<S>) -> u32 {
    mask.to_bitmask() as u32 & ALL
}

#[inline(always)]
fn lanes<S: Simd>(v: f64x4<S>) -> Lanes {
    let mut lanes = [0.0; 4];
    v.store_slice(&mut lanes);
    lanes
}

/// In place of each corner's number that of the next.
#[inline(always)]
fn next<S: Simd>(simd: S, v: f64x4<S>) -> f64x4<S> {
    let [a, b, c, _] = lanes(v);
    f64x4::from_slice(simd, &[b, c, a, b])
}

/// [`sum3`] in every lane. (What `min` and `max` make of zeros of two signs differs between
/// processors; a sum of three has them only if all three are zero.)
#[inline(always)]
fn sums<S: Simd>(x: f64x4<S>, y: f64x4<S>, z: f64x4<S>) -> f64x4<S> {
    let (a, b, c) = ((x + y) + z, (y + z) + x, (z + x) + y);
    a.min(b).max(b.max(a).min(c))
}

/// Where the corners are from the ray's origin, along one axis.
#[inline(always)]
fn along_axis<S: Simd>(simd: S, ray: &ExactRay, [a, b, c]: &[Vec3; 3], axis: usize) -> f64x4<S> {
    let [a, b, c] = [f64::from(a[axis]), f64::from(b[axis]), f64::from(c[axis])];
    f64x4::from_slice(simd, &[a, b, c, a]) - f64x4::splat(simd, ray.origin[axis])
}

/// A triangle as its ray sees it.
struct Corners<S: Simd> {
    /// Corner less origin, by axis, a lane for each corner.
    from_origin: [f64x4<S>; 3],
    /// Largest magnitude therein.
    reach: f64,
}

impl<S: Simd> Corners<S> {
    #[inline(always)]
    fn of(simd: S, ray: &ExactRay, vertices: &[Vec3; 3]) -> Self {
        let x = along_axis(simd, ray, vertices, 0);
        let y = along_axis(simd, ray, vertices, 1);
        let z = along_axis(simd, ray, vertices, 2);
        let [a, b, c, _] = lanes(x.abs().max(y.abs()).max(z.abs()));
        Self { from_origin: [x, y, z], reach: greater(greater(a, b), c) }
    }

    /// Edge function d · (p × q) of the edge opposite each corner.
    #[inline(always)]
    fn edges(&self, simd: S, ray: &ExactRay) -> f64x4<S> {
        let [px, py, pz] = self.from_origin;
        let [qx, qy, qz] = [next(simd, px), next(simd, py), next(simd, pz)];
        let d = ray.direction;
        let x = f64x4::splat(simd, d.x) * (py * qz - pz * qy);
        let y = f64x4::splat(simd, d.y) * (pz * qx - px * qz);
        let z = f64x4::splat(simd, d.z) * (px * qy - py * qx);
        // From each corner to the next: opposite the one after that.
        next(simd, sums(x, y, z))
    }

    /// Largest side of the box around the two edges at the first corner.
    #[inline(always)]
    fn size(&self) -> f64 {
        let [x, y, z] = self.from_origin;
        greater(side(x), greater(side(y), side(z)))
    }

    /// The point of these weights: a convex combination of the corners' own parameters, so that
    /// t cannot leave the triangle's range, however grazing the ray.
    #[inline(always)]
    fn hit(&self, simd: S, ray: &ExactRay, weight: Lanes) -> TriangleHit {
        let total = weight[0] + weight[1] + weight[2];
        let share = f64x4::from_slice(simd, &weight) / f64x4::splat(simd, total);
        let ([x, y, z], d) = (self.from_origin, ray.direction);
        let along =
            sums(x * f64x4::splat(simd, d.x), y * f64x4::splat(simd, d.y), z * f64x4::splat(simd, d.z));
        let (part, share) = (lanes(share * along), lanes(share));
        let t = sum3(part[0], part[1], part[2]) / ray.length_squared;
        TriangleHit { t: t as f32, u: share[1] as f32, v: share[2] as f32 }
    }
}

#[inline(always)]
fn greater(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// Largest distance of the other two corners from the first, along an axis.
#[inline(always)]
fn side<S: Simd>(axis: f64x4<S>) -> f64 {
    let [a, b, c, _] = lanes(axis);
    greater((b - a).abs(), (c - a).abs())
}

/// Edge functions without rounding; `weight` receives their values, the result their signs
/// with ties broken. Both have one sign throughout, or the triangle is missed.
#[cold]
#[inline(never)]
fn exact_sides(ray: &ExactRay, vertices: &[Vec3; 3], weight: &mut Lanes) -> [f64; 3] {
    let (o, d) = (ray.origin.to_array(), ray.direction.to_array());
    std::array::from_fn(|i| {
        let corner = |k: usize| vertices[k % 3].as_dvec3().to_array();
        let (from, to) = (corner(i + 1), corner(i + 2));
        weight[i] = exact::edge(o, d, from, to);
        if weight[i] == 0.0 { exact::edge_tie(d, from, to) } else { weight[i] }
    })
}

/// The unit normal (v1−v0)×(v2−v0), from `f64`; zero if the triangle has no area.
pub fn normal(vertices: &[Vec3; 3]) -> DVec3 {
    let [a, b, c] = vertices.map(|v| v.as_dvec3());
    (b - a).cross(c - a).normalize_or_zero()
}

#[cfg(test)]
mod tests;
