//! The cost of moving vertices: the quadric of Garland and Heckbert, "Surface simplification using
//! quadric error metrics" (1997).
//!
//! It is the summed squared distance to the planes of all triangles that have gone into a vertex,
//! weighted by area. A small share of the squared distance to the old vertices is added; it keeps
//! the equations solvable on flat parts and the triangles even.

use glam::{DMat3, DVec3};

/// Share of the distance to vertices in the cost, beside the distance to planes.
const EVENNESS: f64 = 1e-4;

/// A quadratic function of position: x·Ax + 2b·x + c.
#[derive(Clone, Copy)]
pub struct Quadric {
    a: DMat3,
    b: DVec3,
    c: f64,
}

impl Quadric {
    /// Zero everywhere.
    pub const ZERO: Quadric = Quadric { a: DMat3::ZERO, b: DVec3::ZERO, c: 0.0 };

    /// The weighted squared distance to the plane through `p` with unit normal `n`, with a little
    /// of that to `p` itself.
    pub fn new(p: DVec3, n: DVec3, weight: f64) -> Self {
        let a = weight
            * (DMat3::from_cols(n * n.x, n * n.y, n * n.z) + DMat3::from_diagonal(DVec3::splat(EVENNESS)));
        let b = -(a * p);
        Quadric { a, b, c: -b.dot(p) }
    }

    /// The sum of both functions.
    pub fn plus(&self, other: &Quadric) -> Quadric {
        Quadric { a: self.a + other.a, b: self.b + other.b, c: self.c + other.c }
    }

    /// Where the function is least, and its value there.
    pub fn least(&self) -> (DVec3, f64) {
        let p = -(self.a.inverse() * self.b);
        (p, (p.dot(self.a * p) + 2.0 * self.b.dot(p) + self.c).max(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_planes_meet_where_the_sum_is_least() {
        let meeting = DVec3::new(1.0, 2.0, 3.0);
        let planes = [DVec3::X, DVec3::Y, DVec3::Z].map(|n| Quadric::new(meeting, n, 0.7));
        let (p, cost) = planes[0].plus(&planes[1]).plus(&planes[2]).least();
        assert!((p - meeting).length() < 1e-12);
        assert!(cost < 1e-12);
    }

    #[test]
    fn parallel_planes_share_the_distance_and_flat_parts_stay_solvable() {
        let (low, high) = (DVec3::ZERO, DVec3::new(0.0, 0.0, 2.0));
        let sum = Quadric::new(low, DVec3::Z, 1.0).plus(&Quadric::new(high, DVec3::Z, 1.0));
        let (p, cost) = sum.least();
        assert!((p - DVec3::Z).length() < 1e-9);
        assert!((cost - 2.0).abs() < 0.01, "two planes at distance one cost two, not {cost}");
    }
}
