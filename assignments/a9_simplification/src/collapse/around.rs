//! Where on the faces around a point is the place next to a given one? Eight faces side by side: the arithmetic of
//! [`nearest`](crate::collapse::locate::nearest), step by step, so that each has the bits that it would have alone.

use crate::collapse::surface::Surface;
use common::math::DVec3;
use common::math::lanes::{LANES, Stored, Vectors, add, dot, load, scale, store_wide, subtract, widen};
use common::simd::{Select, Simd, SimdBase, f64x8};

/// Up to eight faces.
pub(super) struct Faces {
    /// Their numbers.
    pub numbers: [u32; LANES],
    /// How many they are.
    pub count: usize,
    corners: [Stored<f32>; 3],
}

/// The nearest places on eight faces.
pub(super) struct Nearest {
    /// Weights of the corners.
    pub weights: Stored<f64>,
    /// Squared distances.
    pub squares: [f64; LANES],
}

impl Faces {
    /// Those of the first half-edges of some; the rest is left.
    #[inline(always)]
    pub(super) fn of(surface: &Surface, half_edges: &mut impl Iterator<Item = u32>) -> Self {
        let mut faces = Self { numbers: [0; LANES], count: 0, corners: Default::default() };
        for h in half_edges.take(LANES) {
            let (lane, face) = (faces.count, h >> 2);
            let points = surface.faces[face as usize].corners();
            for (corner, point) in faces.corners.iter_mut().zip(points) {
                let at = surface.points[point as usize].at;
                corner[0][lane] = at.x;
                corner[1][lane] = at.y;
                corner[2][lane] = at.z;
            }
            faces.numbers[lane] = face;
            faces.count += 1;
        }
        faces
    }

    #[inline(always)]
    fn corner<S: Simd>(&self, simd: S, i: usize, unit: f64x8<S>) -> Vectors<f64x8<S>> {
        let [x, y, z] = load(simd, &self.corners[i]);
        scale([widen(simd, x), widen(simd, y), widen(simd, z)], unit)
    }

    /// The places on them that are nearest to p; `unit` is the surface's scale.
    #[inline(always)]
    pub(super) fn nearest<S: Simd>(&self, simd: S, unit: f64, p: DVec3) -> Nearest {
        let of = |x: f64| f64x8::splat(simd, x);
        let p = [of(p.x), of(p.y), of(p.z)];
        let unit = of(unit);
        let [a, b, c] = [self.corner(simd, 0, unit), self.corner(simd, 1, unit), self.corner(simd, 2, unit)];
        let [u, v, w] = weights(simd, p, [a, b, c]);
        let place = add(add(scale(a, u), scale(b, v)), scale(c, w));
        let apart = subtract(place, p);
        let mut squares = [0.0; LANES];
        dot(apart, apart).store_slice(&mut squares);
        Nearest { weights: store_wide([u, v, w]), squares }
    }
}

/// Weights of the corners; what is told first there is chosen last here.
#[inline(always)]
fn weights<S: Simd>(simd: S, p: Vectors<f64x8<S>>, [a, b, c]: [Vectors<f64x8<S>>; 3]) -> Vectors<f64x8<S>> {
    let (zero, one) = (f64x8::splat(simd, 0.0), f64x8::splat(simd, 1.0));
    let (ab, ac, ap) = (subtract(b, a), subtract(c, a), subtract(p, a));
    let (along_ab, along_ac) = (dot(ab, ap), dot(ac, ap));
    let (bb, bc, cc) = (dot(ab, ab), dot(ab, ac), dot(ac, ac));
    let (ab_from_b, ac_from_b) = (along_ab - bb, along_ac - bc);
    let (ab_from_c, ac_from_c) = (along_ab - bc, along_ac - cc);
    let beyond_ab = along_ab * ac_from_b - ab_from_b * along_ac;
    let beyond_ac = ab_from_c * along_ac - along_ab * ac_from_c;
    let beyond_bc = ab_from_b * ac_from_c - ab_from_c * ac_from_b;
    let (from_b, from_c) = (ac_from_b - ab_from_b, ab_from_c - ac_from_c);

    let at_a = along_ab.simd_le(zero) & along_ac.simd_le(zero);
    let at_b = ab_from_b.simd_ge(zero) & ac_from_b.simd_le(ab_from_b);
    let on_ab = beyond_ab.simd_le(zero) & along_ab.simd_ge(zero) & ab_from_b.simd_le(zero) & bb.simd_gt(zero);
    let at_c = ac_from_c.simd_ge(zero) & ab_from_c.simd_le(ac_from_c);
    let on_ac = beyond_ac.simd_le(zero) & along_ac.simd_ge(zero) & ac_from_c.simd_le(zero);
    let on_bc = beyond_bc.simd_le(zero) & from_b.simd_ge(zero) & from_c.simd_ge(zero);

    // How far along a side, if it is on one.
    let (way, length) = (on_bc.select(from_b, zero), on_bc.select(from_b + from_c, one));
    let (way, length) = (on_ac.select(along_ac, way), on_ac.select(cc, length));
    let (way, length) = (on_ab.select(along_ab, way), on_ab.select(bb, length));
    let t = way / length;
    let rest = one - t;

    let sum = beyond_bc + beyond_ac + beyond_ab;
    let inside = [beyond_bc / sum, beyond_ac / sum, beyond_ab / sum];
    let steps = [
        (on_bc, [zero, rest, t]),
        (on_ac, [rest, zero, t]),
        (at_c, [zero, zero, one]),
        (on_ab, [rest, t, zero]),
        (at_b, [zero, one, zero]),
        (at_a, [one, zero, zero]),
    ];
    let mut weights = inside;
    for (is_there, there) in steps {
        weights = [
            is_there.select(there[0], weights[0]),
            is_there.select(there[1], weights[1]),
            is_there.select(there[2], weights[2]),
        ];
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collapse::locate::nearest;
    use crate::collapse::surface::{Face, NONE, Point};
    use common::math::Vec3;
    use common::simd::{self, dispatch};

    /// Triangles of all sorts, some without area, and places above their insides, sides and corners.
    #[test]
    fn eight_side_by_side_have_the_nearest_place_of_each_alone() {
        let at = |i: u32| {
            let f = |k: u32| ((i * k) % 5) as f32 - 2.0;
            Point { at: Vec3::new(f(1), f(i / 5 + 2), f(i / 7 + 1) * 0.3), out: NONE }
        };
        let points: Vec<Point> = (0..40).map(at).collect();
        let faces: Vec<Face> =
            (0..400).map(|i| Face::new([i % 40, (i / 3) % 40, (i * 7 + 1) % 40])).collect();
        let surface = Surface { faces, points, alive: 400, scale: 0.25 };
        let mut compared = 0;
        for i in 0..60 {
            let p = DVec3::new(f64::from(i % 9) - 4.0, f64::from(i % 7) - 3.0, f64::from(i % 3)) * 0.2;
            let mut all = (0..400).map(|face| 4 * face);
            loop {
                let faces = Faces::of(&surface, &mut all);
                let found = dispatch!(simd::level(), s => faces.nearest(s, surface.scale, p));
                for lane in 0..faces.count {
                    let [a, b, c] = surface.places(faces.numbers[lane] as usize);
                    let alone = nearest(p, a, b, c);
                    let beside = [0, 1, 2].map(|i: usize| found.weights[i][lane]);
                    let bits = |weights: [f64; 3]| weights.map(|w| if w == 0.0 { 0 } else { w.to_bits() });
                    assert!(
                        bits(alone) == bits(beside) || alone[0].is_nan() && beside[0].is_nan(),
                        "{alone:?} {beside:?}"
                    );
                    compared += 1;
                }
                if faces.count == 0 {
                    break;
                }
            }
        }
        assert_eq!(compared, 60 * 400);
    }
}
