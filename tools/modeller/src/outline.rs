//! Outlines as polygons: sampled evenly, drawn in parallel to themselves.

use crate::glyphs::{Contour, Piece, vector};
use glam::DVec2;

/// A closed polygon; the last corner is joined to the first.
pub type Ring = Vec<DVec2>;

/// Steps in which a curve is measured.
const FINE: usize = 256;

/// How a contour is sampled, in its own units.
#[derive(Clone, Copy, Debug)]
pub struct Sampling {
    /// About how far apart the corners of the polygon are.
    pub spacing: f64,
    /// How far from a sharp corner of the outline the next one is at least: an outline drawn
    /// further inside would otherwise run backwards there.
    pub clearance: f64,
}

/// The polygon of a contour, all its sharp corners among the polygon's.
pub fn sampled(contour: &Contour, sampling: Sampling) -> Ring {
    let curves = curves(contour);
    let mut ring = Ring::new();
    for (i, &curve) in curves.iter().enumerate() {
        let before = curves[(i + curves.len() - 1) % curves.len()];
        let after = curves[(i + 1) % curves.len()];
        let clearance = |sharp| if sharp { sampling.clearance } else { 0.0 };
        let ends = [clearance(is_corner(before, curve)), clearance(is_corner(curve, after))];
        ring.extend(along(curve, sampling.spacing, ends));
    }
    ring
}

/// The control points of all pieces; a straight one has its own on the line.
fn curves(contour: &Contour) -> Vec<[DVec2; 4]> {
    let mut from = vector(contour.start);
    let mut curves = Vec::new();
    for piece in contour.pieces {
        let (a, b, to) = match *piece {
            Piece::Line(to) => {
                (from.lerp(vector(to), 1.0 / 3.0), vector(to).lerp(from, 1.0 / 3.0), vector(to))
            }
            Piece::Curve(a, b, to) => (vector(a), vector(b), vector(to)),
        };
        curves.push([from, a, b, to]);
        from = to;
    }
    curves
}

/// Does the outline turn by more than about 15° where one curve ends and the other begins?
fn is_corner(one: [DVec2; 4], other: [DVec2; 4]) -> bool {
    let (end, start) = (one[3] - one[2], other[1] - other[0]);
    end.dot(start) < 0.966 * end.length() * start.length()
}

/// Points evenly spaced along a curve, its start among them and its end not; none nearer to an
/// end than `clear` says.
fn along(curve: [DVec2; 4], spacing: f64, clear: [f64; 2]) -> Vec<DVec2> {
    let line: Vec<DVec2> = (0..=FINE).map(|k| bezier(curve, k as f64 / FINE as f64)).collect();
    let length: f64 = line.windows(2).map(|w| w[0].distance(w[1])).sum();
    let steps = (length / spacing).round().max(1.0);
    let mut points = vec![line[0]];
    let (mut walked, mut next) = (0.0, 1.0);
    for w in line.windows(2) {
        let step = w[0].distance(w[1]);
        while next < steps && next / steps * length <= walked + step {
            let at = next / steps * length;
            if clear[0] <= at && at <= length - clear[1] {
                points.push(w[0].lerp(w[1], (at - walked) / step));
            }
            next += 1.0;
        }
        walked += step;
    }
    points
}

/// De Casteljau's construction.
fn bezier([a, b, c, d]: [DVec2; 4], t: f64) -> DVec2 {
    let (ab, bc, cd) = (a.lerp(b, t), b.lerp(c, t), c.lerp(d, t));
    ab.lerp(bc, t).lerp(bc.lerp(cd, t), t)
}

/// The polygon whose edges lie `distance` to the left of the edges of `ring`: inside a
/// counter-clockwise outline, and in the solid part around a clockwise hole.
pub fn parallel(ring: &Ring, distance: f64) -> Ring {
    let n = ring.len();
    let left = |from: DVec2, to: DVec2| (to - from).perp() / from.distance(to);
    let corner = |i: usize| {
        let (before, here, after) = (ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]);
        let (a, b) = (left(before, here), left(here, after));
        // The mitre: at this point both edges have moved by `distance`.
        here + distance * (a + b) / (1.0 + a.dot(b))
    };
    (0..n).map(corner).collect()
}

/// The enclosed area: positive if the polygon runs counter-clockwise.
pub fn area(ring: &Ring) -> f64 {
    let n = ring.len();
    (0..n).map(|i| ring[i].perp_dot(ring[(i + 1) % n])).sum::<f64>() / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::glyphs;

    #[test]
    fn samples_are_even_and_keep_clear_of_corners() {
        let sampling = Sampling { spacing: 20.0, clearance: 50.0 };
        for glyph in [glyphs::SIX, glyphs::POINT, glyphs::EIGHT, glyphs::THREE, glyphs::SEVEN] {
            for contour in glyph {
                let ring = sampled(contour, sampling);
                let n = ring.len();
                let gaps = (0..n).map(|i| ring[i].distance(ring[(i + 1) % n]));
                assert!(
                    gaps.clone().all(|gap| (15.0..75.0).contains(&gap)),
                    "{:?}",
                    gaps.collect::<Vec<_>>()
                );
            }
        }
        let seven = sampled(&glyphs::SEVEN[0], sampling);
        let corner = vector((270, 850));
        let near = seven.iter().filter(|p| p.distance(corner) < 49.0).count();
        assert_eq!(near, 1, "the corner itself");
    }

    #[test]
    fn a_parallel_square_is_a_square() {
        let square = vec![DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
        assert_eq!(area(&square), 1.0);
        assert!((area(&parallel(&square, 0.25)) - 0.25).abs() < 1e-15);
        assert!((area(&parallel(&square, -0.5)) - 4.0).abs() < 1e-15);
    }
}
