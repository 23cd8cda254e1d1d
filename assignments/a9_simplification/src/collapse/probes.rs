//! Eight faces of a surface that was made of another: where they are, where to they look, and how far the original is
//! from their middles at most.

use crate::collapse::against::{Made, Probe};
use crate::collapse::eight::{by_largest, corners_at, normals_of, points_at};
use crate::collapse::nearby::{Asked, Nearby};
use crate::collapse::witness::FARTHER;
use common::math::DVec3;
use common::math::lanes::{LANES, Stored, Vectors, add, dot, narrow, scale, store_wide, subtract};
use common::simd::{Simd, SimdBase, SimdFloat, f64x8};

/// Eight [`Probe`]s, and what they ask.
pub(super) struct Probes {
    middle: Stored<f64>,
    normal: Stored<f64>,
    reach: [f64; LANES],
    pub asked: Asked,
}

impl Probes {
    /// Those of eight faces, with the bits that each would have alone.
    #[inline(always)]
    pub(super) fn new<S: Simd>(simd: S, made: &Made, faces: &[u32; LANES], sorted: &Nearby) -> Self {
        let (mut was, mut starts) = ([0; LANES], [0; LANES]);
        for lane in 0..LANES {
            was[lane] = made.was[faces[lane] as usize];
            starts[lane] = made.start(faces[lane] as usize);
        }
        let corners = corners_at(simd, made.left, faces);
        let normal = normals_of(corners);
        let three = f64x8::splat(simd, 3.0);
        let [x, y, z] = add(add(corners[0], corners[1]), corners[2]);
        let middle = [x / three, y / three, z / three];
        let to_start = subtract(points_at(simd, made.original, &starts), middle);
        let square = square_at_most(simd, corners_at(simd, made.original, &was), middle);
        // What is no number has lost.
        let reach = square.min_precise(dot(to_start, to_start)).sqrt() * f64x8::splat(simd, FARTHER);
        let [x, y, z] = by_largest(normal);
        let way = [narrow(simd, x), narrow(simd, y), narrow(simd, z)];
        let mut probes = Self {
            middle: store_wide(middle),
            normal: store_wide(normal),
            reach: [0.0; LANES],
            asked: sorted.ask(simd, (middle, reach), way),
        };
        reach.store_slice(&mut probes.reach);
        probes
    }

    /// One of them.
    #[inline(always)]
    pub(super) fn of(&self, lane: usize) -> Probe {
        let ([x, y, z], [u, v, w]) = (&self.middle, &self.normal);
        Probe {
            middle: DVec3::new(x[lane], y[lane], z[lane]),
            normal: DVec3::new(u[lane], v[lane], w[lane]),
            reach: self.reach[lane],
        }
    }
}

/// See [`Triangle::square_at_most`](crate::collapse::against::Triangle::square_at_most).
#[inline(always)]
fn square_at_most<S: Simd>(simd: S, [a, b, c]: [Vectors<f64x8<S>>; 3], p: Vectors<f64x8<S>>) -> f64x8<S> {
    let zero = f64x8::splat(simd, 0.0);
    let (u, v, w) = (subtract(b, a), subtract(c, a), subtract(p, a));
    let (uu, uv, vv, uw, vw) = (dot(u, u), dot(u, v), dot(v, v), dot(u, w), dot(v, w));
    let (of_b, of_c, all) = (vv * uw - uv * vw, uu * vw - uv * uw, uu * vv - uv * uv);
    let (of_b, of_c) = (of_b.max(zero), of_c.max(zero));
    let share = f64x8::splat(simd, 1.0) / all.max(of_b + of_c);
    let away = subtract(subtract(w, scale(u, of_b * share)), scale(v, of_c * share));
    dot(away, away)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collapse::scattered::{random, scattered};
    use common::simd::{self, dispatch};

    #[test]
    fn eight_probes_are_those_of_each() {
        let mut random = random();
        let mut original = scattered(400, &mut random);
        let left = scattered(400, &mut random);
        // One without area.
        let [a, b, c] = original.faces[7].corners().map(|point| point as usize);
        original.points[c].at = (original.points[a].at + original.points[b].at) / 2.0;
        let near: Vec<u32> = (0..1200).map(|point| point * 7 % 1200).collect();
        let was: Vec<u32> = (0..400).map(|face| face * 3 % 400).collect();
        let made = Made { original: &original, left: &left, near: &near, was: &was };
        let sorted = Nearby::new(&original, 0.1);
        for first in (0..400).step_by(LANES) {
            let faces = std::array::from_fn(|lane| first + lane as u32);
            let probes = dispatch!(simd::level(), s => Probes::new(s, &made, &faces, &sorted));
            for (lane, face) in faces.into_iter().enumerate() {
                assert_eq!(probes.of(lane), made.probe(face as usize));
            }
        }
    }
}
