//! Where on a surface is the point next to a given one? Looked for near a point of the surface
//! that is near already; what is found may not be the nearest of all.

use crate::collapse::around::{Faces, Nearest};
use crate::collapse::surface::{NONE, Surface};
use common::math::DVec3;
use common::math::lanes::LANES;
use common::simd::{self, dispatch};

/// At how many points one looks around at most.
const MOST_FANS: usize = 32;

/// A point on a face.
#[derive(Clone, Copy)]
pub(super) struct Landing {
    /// The face, [`NONE`] if there is none.
    pub face: u32,
    /// Weights of its corners; their sum is 1.
    pub weights: [f32; 3],
}

impl Landing {
    /// Nowhere.
    pub(super) const NOWHERE: Self = Self { face: NONE, weights: [0.0; 3] };

    /// Whether it is neither on a side nor at a corner.
    pub(super) fn is_inside(&self) -> bool {
        self.weights.iter().all(|&weight| weight > 0.0)
    }

    /// The corner of the face that has most weight.
    pub(super) fn corner(&self, surface: &Surface) -> u32 {
        let [a, b, c] = self.weights;
        let most = if a >= b && a >= c {
            0
        } else if b >= c {
            1
        } else {
            2
        };
        surface.faces[self.face as usize].corners()[most]
    }
}

/// Looks around `start`, then around the nearest corner of what was found, and so on. Returns the
/// squared distance, too.
pub(super) fn locate(surface: &Surface, start: u32, p: DVec3) -> (f64, Landing) {
    let mut best = (f64::MAX, Landing::NOWHERE);
    let mut around = start;
    for _ in 0..MOST_FANS {
        let so_far = best.0;
        look_around(surface, around, p, &mut best);
        // Inside a face the distance to the surface has a minimum already.
        if best.1.is_inside() || best.0 == so_far {
            break;
        }
        let corner = best.1.corner(surface);
        if corner == around {
            break;
        }
        around = corner;
    }
    best
}

fn look_around(surface: &Surface, point: u32, p: DVec3, best: &mut (f64, Landing)) {
    let mut fan = surface.fan(point);
    loop {
        let faces = Faces::of(surface, &mut fan);
        let Nearest { weights: [u, v, w], squares } =
            dispatch!(simd::level(), s => faces.nearest(s, surface.scale, p));
        for lane in 0..faces.count {
            if squares[lane] < best.0 {
                let weights = [u[lane] as f32, v[lane] as f32, w[lane] as f32];
                *best = (squares[lane], Landing { face: faces.numbers[lane], weights });
            }
        }
        if faces.count < LANES {
            return;
        }
    }
}

/// Squared distance from p to a triangle.
#[inline(always)]
pub(super) fn square(p: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let [u, v, w] = nearest(p, a, b, c);
    (a * u + b * v + c * w).distance_squared(p)
}

/// Weights of the corners a, b, c at the point of their triangle that is nearest to p: which of
/// the corners, sides or the inside it belongs to is told by the signs of products (Ericson 2005,
/// "Real-Time Collision Detection", 5.1.5). A triangle without area gives one of its points.
#[inline(always)]
pub(super) fn nearest(p: DVec3, a: DVec3, b: DVec3, c: DVec3) -> [f64; 3] {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (along_ab, along_ac) = (ab.dot(ap), ac.dot(ap));
    if along_ab <= 0.0 && along_ac <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let (bb, bc, cc) = (ab.dot(ab), ab.dot(ac), ac.dot(ac));
    // The same products with b − p and c − p.
    let (ab_from_b, ac_from_b) = (along_ab - bb, along_ac - bc);
    if ab_from_b >= 0.0 && ac_from_b <= ab_from_b {
        return [0.0, 1.0, 0.0];
    }
    let beyond_ab = along_ab * ac_from_b - ab_from_b * along_ac;
    // Where a and b are one point, the side from a to c has its turn.
    if beyond_ab <= 0.0 && along_ab >= 0.0 && ab_from_b <= 0.0 && bb > 0.0 {
        let t = along_ab / bb;
        return [1.0 - t, t, 0.0];
    }
    let (ab_from_c, ac_from_c) = (along_ab - bc, along_ac - cc);
    if ac_from_c >= 0.0 && ab_from_c <= ac_from_c {
        return [0.0, 0.0, 1.0];
    }
    let beyond_ac = ab_from_c * along_ac - along_ab * ac_from_c;
    if beyond_ac <= 0.0 && along_ac >= 0.0 && ac_from_c <= 0.0 {
        let t = along_ac / cc;
        return [1.0 - t, 0.0, t];
    }
    let beyond_bc = ab_from_b * ac_from_c - ab_from_c * ac_from_b;
    let (from_b, from_c) = (ac_from_b - ab_from_b, ab_from_c - ac_from_c);
    if beyond_bc <= 0.0 && from_b >= 0.0 && from_c >= 0.0 {
        let t = from_b / (from_b + from_c);
        return [0.0, 1.0 - t, t];
    }
    let sum = beyond_bc + beyond_ac + beyond_ab;
    [beyond_bc / sum, beyond_ac / sum, beyond_ab / sum]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two corners, or all three, at one place: the nearest point is that of the segment, and no NaN.
    #[test]
    fn triangles_without_area_have_a_nearest_point() {
        let (p, far) = (DVec3::new(0.25, 1.0, 0.0), DVec3::X);
        for corners in [
            [DVec3::ZERO, DVec3::ZERO, far],
            [DVec3::ZERO, far, DVec3::ZERO],
            [far, DVec3::ZERO, DVec3::ZERO],
        ] {
            let [a, b, c] = corners;
            let [u, v, w] = nearest(p, a, b, c);
            assert!((a * u + b * v + c * w - DVec3::X * 0.25).length() < 1e-15, "{corners:?}: {u} {v} {w}");
        }
        assert_eq!(nearest(p, far, far, far).iter().sum::<f64>(), 1.0);
    }
}
