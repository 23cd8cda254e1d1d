//! Does a triangle have an area? Decided without rounding.
//!
//! Three points of space lie on a line exactly if they do so in the xy, yz and zx projections;
//! each projection is a 2×2 determinant. A floating-point filter decides nearly always; where
//! it cannot, the determinant is summed exactly (Shewchuk, "Adaptive Precision Floating-Point
//! Arithmetic and Fast Robust Geometric Predicates", 1997).

use crate::math::{DVec3, Vec3};

/// Bound of the relative rounding error of a 2×2 determinant of differences in `f64`: four
/// roundings of half an epsilon each would do, this is four times that.
const FILTER: f64 = 8.0 * f64::EPSILON;

/// Whether the triangle with these (finite) corners has an area above zero. No rounding, no
/// tolerance: a sliver of the smallest representable height has one.
pub fn has_area(corners: [Vec3; 3]) -> bool {
    let [a, b, c] = corners.map(|corner| corner.as_dvec3());
    clearly_has_area(b - a, c - a) || !is_collinear(a, b, c)
}

/// The filter: a component of the cross product that rounding cannot have made from zero.
fn clearly_has_area(ab: DVec3, ac: DVec3) -> bool {
    let clear = |p: f64, q: f64| (p - q).abs() > FILTER * (p.abs() + q.abs());
    clear(ab.x * ac.y, ab.y * ac.x) || clear(ab.y * ac.z, ab.z * ac.y) || clear(ab.z * ac.x, ab.x * ac.z)
}

fn is_collinear(a: DVec3, b: DVec3, c: DVec3) -> bool {
    let flat = |i: usize, j: usize| {
        // (b−a)×(c−a) multiplied out. A product of two f32 numbers is exact in f64.
        sum_is_zero([b[i] * c[j], -(b[i] * a[j]), -(a[i] * c[j]), -(b[j] * c[i]), b[j] * a[i], a[j] * c[i]])
    };
    flat(0, 1) && flat(1, 2) && flat(2, 0)
}

/// Whether the exact sum of the terms is zero: each is added to a list of non-overlapping parts
/// whose exact sum is that of all terms so far, so that only zeros remain of a zero sum.
fn sum_is_zero(terms: [f64; 6]) -> bool {
    let mut parts = [0.0; 6];
    for (count, term) in terms.into_iter().enumerate() {
        let mut carry = term;
        for part in &mut parts[..count] {
            (carry, *part) = two_sum(carry, *part);
        }
        parts[count] = carry;
    }
    parts.iter().all(|&part| part == 0.0)
}

/// The rounded sum and its exact rounding error (Knuth).
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let b_rounded = sum - a;
    let a_rounded = sum - b_rounded;
    (sum, (a - a_rounded) + (b - b_rounded))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn repeated_and_collinear_corners_have_no_area() {
        let p = Vec3::new(0.1, -0.7, 3e20);
        assert!(!has_area([p, p, Vec3::X]));
        assert!(!has_area([p, Vec3::X, p]));
        assert!(!has_area([Vec3::X, p, p]));
        assert!(!has_area([Vec3::ZERO, Vec3::splat(0.1), Vec3::splat(0.3)]));
    }

    #[test]
    fn the_thinnest_slivers_have_an_area() {
        let tiny = f32::from_bits(1);
        let huge = f32::MAX;
        assert!(has_area([Vec3::ZERO, Vec3::X, Vec3::new(0.5, tiny, 0.0)]));
        assert!(has_area([Vec3::ZERO, Vec3::splat(huge), Vec3::new(huge, huge, huge.next_down())]));
        assert!(has_area([Vec3::new(tiny, 0.0, 0.0), Vec3::new(0.0, tiny, 0.0), Vec3::ZERO]));
        assert!(has_area([Vec3::new(huge, tiny, 0.0), Vec3::ZERO, Vec3::X]));
    }

    /// The determinants again, in integers: f32 coordinates that are small whole numbers.
    fn has_area_in_integers(corners: [[i32; 3]; 3]) -> bool {
        let [a, b, c] = corners.map(|corner| corner.map(i128::from));
        let det = |i: usize, j: usize| (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
        det(0, 1) != 0 || det(1, 2) != 0 || det(2, 0) != 0
    }

    proptest! {
        #[test]
        fn agrees_with_integer_arithmetic(
            a in prop::array::uniform3(-0xff_ffff_i32..=0xff_ffff),
            step in prop::array::uniform3(-100_i32..=100),
            (m, n) in (-100_000_i32..=100_000, -100_000_i32..=100_000),
            nudge in prop::array::uniform3(-1_i32..=1),
        ) {
            let along = |k: i32| [0, 1, 2].map(|i| (a[i] / 2 + k / 2 * step[i]).clamp(-0xff_ffff, 0xff_ffff));
            let (b, mut c) = (along(m), along(n));
            for i in 0..3 {
                c[i] = (c[i] + nudge[i]).clamp(-0xff_ffff, 0xff_ffff);
            }
            let corners = [a.map(|x| x / 2), b, c];
            let points = corners.map(|corner| Vec3::from_array(corner.map(|x| x as f32)));
            prop_assert_eq!(has_area(points), has_area_in_integers(corners));
        }
    }
}
