//! Convex polygons that are cut by planes and held against triangles.

use crate::collapse::locate::nearest;
use common::math::DVec3;

/// How many corners a polygon may have.
const CORNERS: usize = 12;

/// A convex polygon.
#[derive(Clone, Copy)]
pub(super) struct Polygon {
    corners: [DVec3; CORNERS],
    pub count: usize,
}

impl Polygon {
    /// A triangle.
    pub(super) fn triangle([a, b, c]: [DVec3; 3]) -> Self {
        let mut corners = [DVec3::ZERO; CORNERS];
        corners[..3].copy_from_slice(&[a, b, c]);
        Self { corners, count: 3 }
    }

    /// Its corners in their order.
    pub(super) fn corners(&self) -> impl Iterator<Item = DVec3> {
        self.corners[..self.count].iter().copied()
    }

    /// The mean of its corners.
    pub(super) fn middle(&self) -> DVec3 {
        self.corners().sum::<DVec3>() / self.count as f64
    }

    /// Square of how far it reaches from its middle.
    pub(super) fn reach2(&self) -> f64 {
        let middle = self.middle();
        self.corners().map(|p| (p - middle).length_squared()).fold(0.0, f64::max)
    }

    /// Distance of its middle and how far it reaches from there.
    pub(super) fn about_middle(&self, find: impl Fn(DVec3) -> (f64, u32)) -> f64 {
        find(self.middle()).0.sqrt() + self.reach2().sqrt()
    }

    /// Cut across its longest side, or from corner to corner if it has too many of them to be cut
    /// elsewhere.
    pub(super) fn halves(self) -> [Self; 2] {
        if self.is_full() {
            let (mut first, mut second) = (Self { count: 0, ..self }, Self { count: 0, ..self });
            self.corners[..=self.count / 2].iter().for_each(|&p| first.push(p));
            self.corners[self.count / 2..self.count].iter().for_each(|&p| second.push(p));
            second.push(self.corners[0]);
            return [first, second];
        }
        let sides = (0..self.count).map(|i| (self.corners[i], self.corners[(i + 1) % self.count]));
        let longest =
            sides.max_by(|s, t| (s.1 - s.0).length_squared().total_cmp(&(t.1 - t.0).length_squared()));
        let (p, q) = longest.expect("a polygon has sides");
        let (middle, along) = ((p + q) / 2.0, q - p);
        let mut kept = self;
        let rest = kept.clip(|x| (x - middle).dot(along));
        [kept, rest.unwrap_or(kept)]
    }

    /// Largest distance to a triangle.
    pub(super) fn distance(&self, a: DVec3, b: DVec3, c: DVec3) -> f64 {
        let squares = self.corners().map(|p| {
            let [u, v, w] = nearest(p, a, b, c);
            (a * u + b * v + c * w - p).length_squared()
        });
        squares.fold(0.0, f64::max).sqrt()
    }

    /// Whether a cut would not fit.
    fn is_full(&self) -> bool {
        self.count + 2 > CORNERS
    }

    fn push(&mut self, p: DVec3) {
        self.corners[self.count] = p;
        self.count += 1;
    }

    /// Keeps what is not above zero, and returns the rest if there is any. A polygon with too many
    /// corners is not cut.
    pub(super) fn clip(&mut self, height: impl Fn(DVec3) -> f64) -> Option<Self> {
        let whole = *self;
        let heights: [f64; CORNERS] =
            std::array::from_fn(|i| if i < whole.count { height(whole.corners[i]) } else { 0.0 });
        let above = heights[..whole.count].iter().filter(|&&h| h > 0.0).count();
        if above == 0 || whole.is_full() {
            return None;
        }
        if above == whole.count {
            self.count = 0;
            return Some(whole);
        }
        let (mut kept, mut rest) = (Self { count: 0, ..whole }, Self { count: 0, ..whole });
        for i in 0..whole.count {
            let j = (i + 1) % whole.count;
            let (p, q) = (whole.corners[i], whole.corners[j]);
            if heights[i] > 0.0 {
                rest.push(p)
            } else {
                kept.push(p)
            }
            if (heights[i] > 0.0) != (heights[j] > 0.0) {
                let crossing = p + (q - p) * (heights[i] / (heights[i] - heights[j]));
                kept.push(crossing);
                rest.push(crossing);
            }
        }
        *self = kept;
        Some(rest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A regular polygon of so many corners.
    fn regular(count: usize) -> Polygon {
        let mut polygon = Polygon { corners: [DVec3::ZERO; CORNERS], count: 0 };
        for i in 0..count {
            let (sine, cosine) = (std::f64::consts::TAU * i as f64 / count as f64).sin_cos();
            polygon.push(DVec3::new(cosine, sine, 0.0));
        }
        polygon
    }

    fn area(polygon: &Polygon) -> f64 {
        let first = polygon.corners[0];
        let fan = polygon.corners[..polygon.count].windows(2);
        fan.map(|w| (w[0] - first).cross(w[1] - first).z / 2.0).sum()
    }

    /// A polygon that cannot be cut into less would be cut for ever.
    #[test]
    fn halves_are_less_than_the_whole_and_all_of_it() {
        for count in 3..=CORNERS {
            let whole = regular(count);
            let [one, other] = whole.halves();
            assert!(area(&one) > 0.0 && area(&other) > 0.0, "{count}");
            assert!((area(&one) + area(&other) - area(&whole)).abs() < 1e-12, "{count}");
        }
    }
}
