//! Quadrics that are summed up as points merge (Garland & Heckbert 1997, "Surface simplification
//! using quadric error metrics").
//!
//! Planes that were counted for an edge long ago are still there when it has become a vertex, and tell less
//! and less of what is around it. So all of them are forgotten now and then, and the triangles that are
//! left are the original from then on: that is better than to remember, and than to move the points that
//! are left to where the original wants them.
//!
//! Each is kept about the point that it belongs to, not about the origin: numbers stay small where
//! distances are, and nothing cancels far from the origin.

use crate::collapse::abreast::{Symmetrics, price_all};
use crate::collapse::banded::Banded;
use crate::collapse::cost::{Cost, Merge, Offer, cheapest_by_form, without_bias};
use crate::collapse::eight::normals;
use crate::collapse::memoryless::line;
use crate::collapse::quadric::Symmetric;
use crate::collapse::ring::Ring;
use crate::collapse::rows::rows_turned;
use crate::collapse::single::{Quadric, planes};
use crate::collapse::surface::{NONE, Surface};
use common::math::DVec3;
use common::math::lanes::{LANES, dot, scale, subtract, widen};
use common::simd::{self, Simd, SimdBase, dispatch, f64x8, prefetch};

/// Share of the trace by which a minimum must be determined: well above the rounding of single precision.
const LEAST_RANK: f64 = 1e-6;

/// How much the squared length of an edge counts, in terms of the planes at its ends: about as much as that rounding.
const SHAPE: f64 = 1e-7;

/// For every point the sum over all triangles that went into it of √area times the squared
/// distance to the plane: the area itself gives a root mean square that is a few parts in a hundred less, and spots that
/// are a quarter as far off again.
#[derive(Clone)]
pub(super) struct Accumulated {
    of: Vec<Quadric>,
}

impl Accumulated {
    /// Of all points of a surface.
    pub(super) fn new(surface: &Surface) -> Self {
        let of = surface.points.iter().map(|point| Quadric::default().at(point.at)).collect();
        let mut new = Self { of };
        new.sum_up(surface);
        new
    }

    /// Adds the planes of the faces that are there.
    fn sum_up(&mut self, surface: &Surface) {
        dispatch!(simd::level(), s => self.sum_up_with(s, surface));
    }

    #[inline(always)]
    fn sum_up_with<S: Simd>(&mut self, simd: S, surface: &Surface) {
        let (mut faces, mut count) = ([0; LANES], 0);
        for (i, face) in surface.faces.iter().enumerate() {
            if face.is_gone() {
                continue;
            }
            faces[count] = i as u32;
            count += 1;
            if count == LANES {
                self.add_planes(simd, surface, (&faces, count));
                count = 0;
            }
        }
        // What is left over stands beside faces that are summed up already.
        if count > 0 {
            self.add_planes(simd, surface, (&faces, count));
        }
    }

    /// Adds the planes of the first so many of eight faces.
    #[inline(always)]
    fn add_planes<S: Simd>(&mut self, simd: S, surface: &Surface, (faces, count): (&[u32; LANES], usize)) {
        let planes = planes(simd, normals(simd, surface, faces));
        for lane in 0..count {
            let face = &surface.faces[faces[lane] as usize];
            for point in face.corners() {
                self.of[point as usize].add_row(simd, planes[lane]);
            }
            if face.is_at_boundary() {
                self.add_lines(surface, 4 * faces[lane]);
            }
        }
    }

    /// Adds the lines along the boundary of a face, given by its first half-edge.
    #[cold]
    fn add_lines(&mut self, surface: &Surface, first: u32) {
        for h in (first..first + 3).filter(|&h| surface.twin(h) == NONE) {
            let (start, end) = (surface.start(h), surface.end(h));
            let line = line(surface.at(end) - surface.at(start)).single();
            self.of[start as usize].add(&line);
            self.of[end as usize].add(&line);
        }
    }
}

impl Accumulated {
    /// Where an edge starts, the edge, and its A, r and c as in [`cheapest_by_form`].
    #[inline(always)]
    fn form(&self, surface: &Surface, h: u32) -> (DVec3, DVec3, (Symmetric, DVec3, f64)) {
        let [p, q] = [&self.of[surface.start(h) as usize], &self.of[surface.end(h) as usize]];
        let from = p.place() * surface.scale;
        let edge = q.place() * surface.scale - from;
        let across = q.a().times(edge);
        let sum = p.plus(q);
        (from, edge, (sum.a(), across - sum.b(), sum.c() + edge.dot(across - q.b() * 2.0)))
    }
}

impl Accumulated {
    /// What eight edges cost; no number where [`Cost::price`] must tell.
    #[inline(always)]
    fn price_eight<S: Simd>(&self, simd: S, surface: &Surface, edges: &[u32; LANES]) -> [f64; LANES] {
        let (mut starts, mut ends) = ([&self.of[0].0; LANES], [&self.of[0].0; LANES]);
        for lane in 0..LANES {
            starts[lane] = &self.of[surface.start(edges[lane]) as usize].0;
            ends[lane] = &self.of[surface.end(edges[lane]) as usize].0;
        }
        let (p, q) = (rows_turned(simd, &starts), rows_turned(simd, &ends));
        let unit = f64x8::splat(simd, surface.scale);
        let along = |i: usize| widen(simd, q[i]) * unit - widen(simd, p[i]) * unit;
        let edge = [along(10), along(11), along(12)];
        let two = f64x8::splat(simd, 2.0);
        let sum = |i: usize| widen(simd, p[i] + q[i]);
        let of_end = |i: usize| widen(simd, q[i]);
        let a_of_end = [of_end(0), of_end(1), of_end(2), of_end(3), of_end(4), of_end(5)];
        let across = Symmetrics(a_of_end).times(edge);
        let a = Symmetrics([sum(0), sum(1), sum(2), sum(3), sum(4), sum(5)]);
        let r = subtract(across, [sum(6), sum(7), sum(8)]);
        let c = sum(9) + dot(edge, subtract(across, scale([of_end(6), of_end(7), of_end(8)], two)));
        let y = a.least(simd, r, edge, LEAST_RANK);
        let error = dot(y, subtract(a.times(y), scale(r, two))) + c;
        a.costs(simd, edge, y, error, SHAPE)
    }
}

impl Cost for Accumulated {
    type Line = Banded;

    const PATIENCE: u32 = 4;
    const EARLY_PATIENCE: u32 = 16;
    const IS_QUICK: bool = true;

    #[inline(always)]
    fn prefetch(&self, point: u32) {
        prefetch(&self.of[point as usize..]);
    }

    #[inline(always)]
    fn price(&self, surface: &Surface, h: u32) -> Offer {
        let (from, edge, form) = self.form(surface, h);
        cheapest_by_form(from, edge, (LEAST_RANK, SHAPE), form)
    }

    fn price_all(&self, surface: &Surface, what: impl FnMut(u32, f64)) {
        let eight = |edges: &[u32; LANES]| dispatch!(simd::level(), s => self.price_eight(s, surface, edges));
        price_all(surface, eight, |h| self.price(surface, h).cost, what);
    }

    fn place(&self, surface: &Surface, h: u32, offer: &Offer) -> DVec3 {
        let (from, edge, (a, r, _)) = self.form(surface, h);
        from + without_bias(a, r, edge, LEAST_RANK, offer.place - from)
    }

    fn forget(&mut self, surface: &Surface) {
        let points = surface.points.iter().zip(&mut self.of);
        points.filter(|(point, _)| point.out != NONE).for_each(|(p, of)| *of = Quadric::default().at(p.at));
        self.sum_up(surface);
    }

    fn let_go(&mut self) {
        self.of = Vec::new();
    }

    #[cfg(test)]
    fn bytes(&self) -> usize {
        self.of.capacity() * size_of::<Quadric>()
    }

    fn merged(&mut self, surface: &Surface, _: &Ring, merge: &Merge) {
        let [p, q] = [merge.kept, merge.gone].map(|point| self.of[point as usize]);
        let [p, q] = [p.moved(merge.place - merge.from[0]), q.moved(merge.place - merge.from[1])];
        let place = surface.points[merge.kept as usize].at;
        self.of[merge.kept as usize] = p.plus(&q).at(place);
    }
}
