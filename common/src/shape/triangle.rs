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

use super::ExactRay;
use crate::math::{DVec3, UNIT_ROUNDOFF, Vec3, exact, sum3};

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
#[inline(always)]
pub fn intersect(ray: &ExactRay, vertices: &[Vec3; 3]) -> Option<TriangleHit> {
    let corner = Corners::of(ray, vertices);
    let mut weight = corner.edges(ray);
    let error = EDGE_ERROR * ray.reach * corner.reach * corner.reach;
    let certain = weight[0].abs() > error && weight[1].abs() > error && weight[2].abs() > error;
    if !certain {
        return intersect_exactly(ray, vertices, &corner);
    }
    let front = weight[0] < 0.0 && weight[1] < 0.0 && weight[2] < 0.0;
    let back = weight[0] > 0.0 && weight[1] > 0.0 && weight[2] > 0.0;
    if !front && !back {
        return None;
    }
    // Certain signs are not yet precise values: in a thin triangle the weights' error moves the
    // point along its length, by at most `error · size / total`.
    let total = weight[0] + weight[1] + weight[2];
    if error * corner.size() > total.abs() * corner.reach * UNIT_ROUNDOFF {
        exact_sides(ray, vertices, &mut weight);
    }
    Some(corner.hit(ray, &weight))
}

/// The same where rounding could hide a sign.
#[cold]
#[inline(never)]
fn intersect_exactly(ray: &ExactRay, vertices: &[Vec3; 3], corner: &Corners) -> Option<TriangleHit> {
    let mut weight = [0.0; 4];
    let side = exact_sides(ray, vertices, &mut weight);
    let inside = side.iter().all(|&s| s < 0.0) || side.iter().all(|&s| s > 0.0);
    inside.then(|| corner.hit(ray, &weight))
}

/// Four numbers of which three are used, one for each corner: loops over them become vector
/// code, without fused operations, so that every processor gets the same bits.
type Lanes = [f64; 4];

/// A triangle as its ray sees it.
struct Corners {
    /// Corner less origin, `from_origin[axis][corner]`.
    from_origin: [Lanes; 3],
    /// Largest magnitude therein.
    reach: f64,
}

impl Corners {
    #[inline(always)]
    fn of(ray: &ExactRay, vertices: &[Vec3; 3]) -> Self {
        let mut from_origin = [[0.0; 4]; 3];
        let mut reach = 0.0;
        for axis in 0..3 {
            for k in 0..4 {
                from_origin[axis][k] = f64::from(vertices[k % 3][axis]) - ray.origin[axis];
            }
        }
        for k in 0..3 {
            for lanes in &from_origin {
                reach = greater(reach, lanes[k].abs());
            }
        }
        Self { from_origin, reach }
    }

    /// Edge function d · (p × q) of the edge opposite each corner.
    #[inline(always)]
    fn edges(&self, ray: &ExactRay) -> Lanes {
        let turned = |by: usize| {
            let turn = |lanes: &Lanes| [lanes[by], lanes[(by + 1) % 3], lanes[(by + 2) % 3], lanes[by]];
            [turn(&self.from_origin[0]), turn(&self.from_origin[1]), turn(&self.from_origin[2])]
        };
        let (p, q) = (turned(1), turned(2));
        let mut weight = [0.0; 4];
        for k in 0..4 {
            let x = p[1][k] * q[2][k] - p[2][k] * q[1][k];
            let y = p[2][k] * q[0][k] - p[0][k] * q[2][k];
            let z = p[0][k] * q[1][k] - p[1][k] * q[0][k];
            weight[k] = sum3(ray.direction.x * x, ray.direction.y * y, ray.direction.z * z);
        }
        weight
    }

    /// Largest side of the box around the two edges at the first corner.
    #[inline(always)]
    fn size(&self) -> f64 {
        let side = |lanes: &Lanes| greater((lanes[1] - lanes[0]).abs(), (lanes[2] - lanes[0]).abs());
        let [x, y, z] = &self.from_origin;
        greater(side(x), greater(side(y), side(z)))
    }

    /// The point of these weights: a convex combination of the corners' own parameters, so that
    /// t cannot leave the triangle's range, however grazing the ray.
    #[inline(always)]
    fn hit(&self, ray: &ExactRay, weight: &Lanes) -> TriangleHit {
        let total = weight[0] + weight[1] + weight[2];
        let mut share = [0.0; 4];
        let mut part = [0.0; 4];
        for k in 0..4 {
            let [x, y, z] = &self.from_origin;
            let d = ray.direction;
            share[k] = weight[k] / total;
            part[k] = share[k] * sum3(x[k] * d.x, y[k] * d.y, z[k] * d.z);
        }
        let t = sum3(part[0], part[1], part[2]) / ray.length_squared;
        TriangleHit { t: t as f32, u: share[1] as f32, v: share[2] as f32 }
    }
}

#[inline(always)]
fn greater(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
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
mod tests {
    use super::*;
    use crate::ray::Ray;

    fn hit(o: [f32; 3], d: [f32; 3], v: [[f32; 3]; 3]) -> Option<TriangleHit> {
        intersect(&ExactRay::new(&Ray::new(o.into(), d.into())), &v.map(Vec3::from))
    }

    const UNIT: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

    #[test]
    fn middle_has_t_u_v() {
        let h = hit([0.25, 0.5, 2.0], [0.0, 0.0, -2.0], UNIT).unwrap();
        assert_eq!(h, TriangleHit { t: 1.0, u: 0.25, v: 0.5 });
        assert!(hit([0.25, 0.5, -2.0], [0.0, 0.0, 2.0], UNIT).is_some(), "the back is hit too");
        assert!(hit([0.75, 0.5, 2.0], [0.0, 0.0, -1.0], UNIT).is_none());
    }

    #[test]
    fn shared_edges_and_corners_belong_to_one() {
        let other = [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        for x in [0.0, 0.25, 0.5, 0.75, 1.0] {
            let ray = ([x, 1.0 - x, 1.0], [0.0, 0.0, -1.0]);
            let hits = [UNIT, other].iter().filter(|v| hit(ray.0, ray.1, **v).is_some()).count();
            let corner = x == 0.0 || x == 1.0;
            assert!(hits == 1 || corner && hits == 0, "x = {x}: {hits} hits");
        }
    }

    #[test]
    fn no_area_and_edge_on_are_missed() {
        assert!(
            hit([0.5, 0.5, 1.0], [0.0, 0.0, -1.0], [[0.0; 3], [1.0, 1.0, 0.0], [2.0, 2.0, 0.0]]).is_none()
        );
        assert!(hit([-1.0, 0.25, 0.0], [1.0, 0.0, 0.0], UNIT).is_none());
        assert!(hit([0.0; 3], [0.0, 0.0, 1.0], [[0.0; 3]; 3]).is_none());
    }

    /// The signs of this sliver's weights are certain in `f64`, but their values were off by
    /// 10⁻⁵, and t with them: it was 0.9999926.
    #[test]
    fn thin_triangles_have_precise_t() {
        let f = f32::from_bits;
        let o = [f(0x3ff6_54fa), f(0xbf69_9e9c), f(0x3faf_b259)];
        let d = [f(0xbff6_54fa), f(0x3f69_9e9c), f(0xc000_a320)];
        let h = hit(
            o,
            d,
            [
                [f(0x2c6e_71d3), f(0x2bc7_d538), f(0x3e94_4e43)],
                [f(0xac40_9d0b), f(0x2b29_31bb), f(0xbf44_667e)],
                [f(0x2bf6_55c7), f(0x2c2e_5150), f(0xbee5_2230)],
            ],
        );
        assert_eq!(h.map(|h| h.t), Some(1.0));
    }

    #[test]
    fn the_whole_range_of_f32() {
        for scale in [1e-45, 1e-38, 1e-20, 1.0, 1e20, 1e38] {
            let v = UNIT.map(|p| p.map(|x| x * scale));
            let h = hit([0.0, 0.0, scale], [0.0, 0.0, -1.0], v.map(|p| [p[0] - 0.0, p[1], p[2]]));
            assert!(h.is_none_or(|h| h.t.is_finite()), "{scale}");
            let h = hit([scale * 0.25, scale * 0.25, -scale], [0.0, 0.0, 1e-30], v);
            assert!(scale < 1e-40 || h.is_some(), "{scale}");
        }
    }
}
