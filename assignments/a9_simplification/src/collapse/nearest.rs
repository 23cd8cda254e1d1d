//! Nearest point of a triangle.

use common::math::DVec3;

/// Weights of the corners a, b, c at the nearest point of the triangle to p (Ericson, "Real-Time Collision Detection", 5.1.5).
#[inline(always)]
pub(super) fn nearest(p: DVec3, a: DVec3, b: DVec3, c: DVec3) -> [f64; 3] {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    let (bb, bc, cc) = (ab.dot(ab), ab.dot(ac), ac.dot(ac));
    if d1 <= 0.0 && d2 <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    // Dot products with b − p and c − p follow from those with a − p.
    let (d3, d4) = (d1 - bb, d2 - bc);
    if d3 >= 0.0 && d4 <= d3 {
        return [0.0, 1.0, 0.0];
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let t = d1 / bb;
        return [1.0 - t, t, 0.0];
    }
    let (d5, d6) = (d1 - bc, d2 - cc);
    if d6 >= 0.0 && d5 <= d6 {
        return [0.0, 0.0, 1.0];
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let t = d2 / cc;
        return [1.0 - t, 0.0, t];
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        let t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return [0.0, 1.0 - t, t];
    }
    let s = 1.0 / (va + vb + vc);
    [va * s, vb * s, vc * s]
}
