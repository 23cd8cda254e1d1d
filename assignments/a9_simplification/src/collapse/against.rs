//! Which faces look against the original? Those whose normals point away from every triangle that is
//! nearest to their middles.
//!
//! To find the nearest of all triangles for each face takes as long as a fast simplification. But most
//! faces have no triangle near by that looks another way: it is enough to know some distance that is
//! no less than that of the nearest, and to ask each triangle that is as near as that to its middle.

use crate::collapse::eight::eight_from;
use crate::collapse::locate::{locate, square};
use crate::collapse::nearby::Nearby;
use crate::collapse::probes::Probes;
use crate::collapse::surface::Surface;
use crate::collapse::witness::FARTHER;
use common::math::DVec3;
use common::math::lanes::LANES;
use common::simd::{self, Simd, dispatch};

/// Of how many faces the mean reach is that of all.
const SAMPLES: usize = 1000;

/// A surface that was made of another.
pub(super) struct Made<'a> {
    pub original: &'a Surface,
    pub left: &'a Surface,
    /// For every point that is left one of the original's that should be close.
    pub near: &'a [u32],
    /// For every face that is left which of the original's it was.
    pub was: &'a [u32],
}

/// A face that is left: where it is and where to it looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Probe {
    pub middle: DVec3,
    pub normal: DVec3,
    /// What the original is not farther than.
    pub reach: f64,
}

impl Made<'_> {
    /// A point of the original that should be close to a face.
    #[inline(always)]
    pub(super) fn start(&self, face: usize) -> u32 {
        self.near[self.left.faces[face].corners()[0] as usize]
    }

    #[inline(always)]
    pub(super) fn probe(&self, face: usize) -> Probe {
        let (middle, normal) = middle(self.left.places(face));
        let triangle = Triangle::of(self.original, self.was[face]);
        let start = self.original.at(self.start(face));
        let square = triangle.square_at_most(middle).min(start.distance_squared(middle));
        Probe { middle, normal, reach: square.sqrt() * FARTHER }
    }

    /// How far one looks from the middles of faces: the mean of some.
    pub(super) fn mean_reach(&self) -> f64 {
        let faces = (0..self.was.len()).step_by(1 + self.was.len() / SAMPLES);
        let count = faces.len().max(1) as f64;
        faces.map(|face| self.probe(face).reach).sum::<f64>() / count
    }

    /// The faces that may look against the original, whose triangles are sorted: few more than those that do.
    pub(super) fn suspects(&self, sorted: &Nearby) -> Vec<u32> {
        dispatch!(simd::level(), s => self.suspects_with(s, sorted))
    }

    #[inline(always)]
    fn suspects_with<S: Simd>(&self, simd: S, sorted: &Nearby) -> Vec<u32> {
        let (mut suspects, last) = (Vec::new(), self.was.len() as u32);
        for first in (0..last).step_by(LANES) {
            let faces = eight_from(first, last);
            let probes = Probes::new(simd, self, &faces, sorted);
            for face in first..last.min(first + LANES as u32) {
                let lane = (face - first) as usize;
                let mut nearest = f64::INFINITY;
                sorted.tell(simd, &probes.asked, lane, |other| {
                    if let Some(square) = probes.of(lane).against(self.original, other) {
                        nearest = nearest.min(square);
                    }
                });
                if nearest < f64::INFINITY
                    && !probes.of(lane).looks_along(self.original, self.start(face as usize), nearest)
                {
                    suspects.push(face);
                }
            }
        }
        suspects
    }
}

impl Probe {
    /// The squared distance of a triangle if it is within reach and looks the other way.
    fn against(&self, original: &Surface, face: u32) -> Option<f64> {
        let triangle = Triangle::of(original, face);
        if triangle.normal.dot(self.normal) >= 0.0 {
            return None;
        }
        let reach2 = self.reach * self.reach * FARTHER;
        let above = triangle.normal.dot(self.middle - triangle.corners[0]);
        if above * above > reach2 * FARTHER * triangle.normal.length_squared() {
            return None;
        }
        Some(triangle.square(self.middle)).filter(|square| *square <= reach2)
    }

    /// Whether it is known at a glance that something along which it looks is as near as what is not.
    fn looks_along(&self, original: &Surface, start: u32, against: f64) -> bool {
        let (square, landing) = locate(original, start, self.middle);
        square <= against && original.normal(landing.face as usize).dot(self.normal) >= 0.0
    }
}

/// A face of the original.
pub(super) struct Triangle {
    /// Where its corners are.
    pub corners: [DVec3; 3],
    /// As long as twice the area.
    pub normal: DVec3,
}

impl Triangle {
    #[inline(always)]
    pub(super) fn of(original: &Surface, face: u32) -> Self {
        let corners = original.places(face as usize);
        Self { corners, normal: middle(corners).1 }
    }

    /// Squared distance of a point from some place in it: below the point, unless that is outside. No number for what has
    /// no area.
    #[inline(always)]
    fn square_at_most(&self, p: DVec3) -> f64 {
        let [a, b, c] = self.corners;
        let (u, v, w) = (b - a, c - a, p - a);
        let (uu, uv, vv, uw, vw) = (u.dot(u), u.dot(v), v.dot(v), u.dot(w), v.dot(w));
        // Weights of b and c, and of all three, up to a factor; what is outside is brought back.
        let (of_b, of_c, all) = (vv * uw - uv * vw, uu * vw - uv * uw, uu * vv - uv * uv);
        let (of_b, of_c) = (of_b.max(0.0), of_c.max(0.0));
        let share = 1.0 / all.max(of_b + of_c);
        (w - u * (of_b * share) - v * (of_c * share)).length_squared()
    }

    /// Squared distance to a point.
    #[inline(always)]
    pub(super) fn square(&self, p: DVec3) -> f64 {
        square(p, self.corners)
    }
}

/// Middle and normal of a triangle.
pub(super) fn middle([a, b, c]: [DVec3; 3]) -> (DVec3, DVec3) {
    ((a + b + c) / 3.0, (b - a).cross(c - a))
}
