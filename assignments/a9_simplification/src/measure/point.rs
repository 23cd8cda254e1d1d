//! A9T4: the point of a triangle that is nearest to a point.

use common::math::DVec3;

/// The point of the triangle (border included) that is nearest to `p`; triangles without area are
/// the segments that they are.
///
/// Space falls into seven regions by what of the triangle is nearest: a corner, a side or the
/// inside (Ericson, "Real-Time Collision Detection", 2005, section 5.1.5). In corner regions the
/// answer is exact, elsewhere it is rounded like a sum of three products.
pub fn nearest_on_triangle(p: DVec3, [a, b, c]: [DVec3; 3]) -> DVec3 {
    let (ab, ac) = (b - a, c - a);
    // How far along the two sides at a the point lies, as seen from each corner.
    let along = |corner: DVec3| (ab.dot(p - corner), ac.dot(p - corner));
    let (a_ab, a_ac) = along(a);
    if a_ab <= 0.0 && a_ac <= 0.0 {
        return a;
    }
    let (b_ab, b_ac) = along(b);
    if b_ab >= 0.0 && b_ac <= b_ab {
        return b;
    }
    let (c_ab, c_ac) = along(c);
    if c_ac >= 0.0 && c_ab <= c_ac {
        return c;
    }
    // Areas of the three triangles that p's projection makes with the sides; a negative one says
    // that the side is between p and the triangle.
    let across_ab = a_ab * b_ac - b_ab * a_ac;
    if across_ab <= 0.0 && a_ab >= 0.0 && b_ab <= 0.0 && a_ab > b_ab {
        return a + ab * (a_ab / (a_ab - b_ab));
    }
    let across_ac = c_ab * a_ac - a_ab * c_ac;
    if across_ac <= 0.0 && a_ac >= 0.0 && c_ac <= 0.0 && a_ac > c_ac {
        return a + ac * (a_ac / (a_ac - c_ac));
    }
    let across_bc = b_ab * c_ac - c_ab * b_ac;
    let (from_b, to_c) = (b_ac - b_ab, c_ab - c_ac);
    if across_bc <= 0.0 && from_b >= 0.0 && to_c >= 0.0 && from_b + to_c > 0.0 {
        return b + (c - b) * (from_b / (from_b + to_c));
    }
    let area = across_ab + across_ac + across_bc;
    let inside = a + ab * (across_ac / area) + ac * (across_ab / area);
    // Without area nothing is inside, and what was computed is no number or no nearer.
    if area > 0.0 && inside.is_finite() { inside } else { nearest_on_sides(p, [a, b, c]) }
}

fn nearest_on_sides(p: DVec3, [a, b, c]: [DVec3; 3]) -> DVec3 {
    let points = [(a, b), (b, c), (c, a)].map(|(from, to)| nearest_on_segment(p, from, to));
    let nearer = |x: DVec3, y: DVec3| if y.distance_squared(p) < x.distance_squared(p) { y } else { x };
    nearer(nearer(points[0], points[1]), points[2])
}

fn nearest_on_segment(p: DVec3, from: DVec3, to: DVec3) -> DVec3 {
    let way = to - from;
    let share = way.dot(p - from) / way.length_squared();
    // No number (a segment that is a point) is neither above 0 nor 1.
    if share > 0.0 { from + way * share.min(1.0) } else { from }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const FLAT: [DVec3; 3] = [DVec3::ZERO, DVec3::new(4.0, 0.0, 0.0), DVec3::new(0.0, 3.0, 0.0)];

    #[test]
    fn a9t4_each_region_has_its_answer() {
        for (p, nearest) in [
            ([-1.0, -1.0, 2.0], [0.0, 0.0, 0.0]),
            ([6.0, -1.0, -2.0], [4.0, 0.0, 0.0]),
            ([-1.0, 9.0, 1.0], [0.0, 3.0, 0.0]),
            ([1.5, -7.0, 3.0], [1.5, 0.0, 0.0]),
            ([-2.0, 1.0, 3.0], [0.0, 1.0, 0.0]),
            ([2.0 + 3.0, 1.5 + 4.0, 1.0], [2.0, 1.5, 0.0]),
            ([1.0, 1.0, -5.0], [1.0, 1.0, 0.0]),
            ([1.0, 1.0, 0.0], [1.0, 1.0, 0.0]),
        ] {
            let found = nearest_on_triangle(p.into(), FLAT);
            assert!(found.distance(nearest.into()) < 1e-14, "{p:?}: {found}");
        }
    }

    #[test]
    fn a9t4_triangles_without_area_are_segments_and_points() {
        let (x, y) = (DVec3::X, DVec3::Y);
        for triangle in [[x, -x, x * 0.5], [x * 0.5, x, -x], [x, x, -x], [-x, x, x], [x, -x, x]] {
            let found = nearest_on_triangle(DVec3::new(0.25, 1.0, 0.0), triangle);
            assert!(found.distance(x * 0.25) < 1e-15, "{triangle:?}: {found}");
        }
        assert_eq!(nearest_on_triangle(DVec3::ZERO, [y; 3]), y);
    }

    fn point(reach: f64) -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(-reach..reach).prop_map(DVec3::from_array)
    }

    proptest! {
        /// Against many points of the triangle: none is nearer, and the answer is one of them.
        #[test]
        fn a9t4_no_point_of_the_triangle_is_nearer(p in point(3.0), a in point(1.0), b in point(1.0), c in point(1.0)) {
            let found = nearest_on_triangle(p, [a, b, c]);
            let distance = found.distance(p);
            let mut least = f64::INFINITY;
            const STEPS: u32 = 64;
            for i in 0..=STEPS {
                for j in 0..=STEPS - i {
                    let (u, v) = (f64::from(i) / f64::from(STEPS), f64::from(j) / f64::from(STEPS));
                    least = least.min((a + (b - a) * u + (c - a) * v).distance(p));
                }
            }
            let longest = (b - a).length().max((c - a).length());
            prop_assert!(distance <= least + 1e-12 && distance >= least - longest / f64::from(STEPS));
            let normal = (b - a).cross(c - a).normalize_or_zero();
            prop_assert!(normal.dot(found - a).abs() < 1e-9, "off the plane");
        }
    }
}
