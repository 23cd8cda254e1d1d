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

use crate::collapse::cost::{Cost, Merge, Offer, cheapest};
use crate::collapse::quadric::Symmetric;
use crate::collapse::queue::Queue;
use crate::collapse::ring::Ring;
use crate::collapse::surface::{NONE, Surface};
use common::math::DVec3;
use common::simd::prefetch;

/// How much the edge of a boundary counts, in terms of triangles of about its size.
const BOUNDARY: f64 = 20.0;

/// yᵀ·A·y + 2·b·y + c for y relative to the point. Entries of A are as in [`Symmetric`], without
/// its alignment, which would make half as much again of it.
#[derive(Clone, Copy, Default)]
struct Quadric {
    a: [f64; 6],
    b: DVec3,
    c: f64,
}

/// For every point the sum over all triangles that went into it of area times the squared
/// distance to the plane.
#[derive(Clone)]
pub(super) struct Accumulated {
    of: Vec<Quadric>,
}

impl Quadric {
    #[inline(always)]
    fn a(&self) -> Symmetric {
        Symmetric(self.a)
    }

    fn add(&mut self, plane_or_line: Symmetric) {
        self.a = (self.a() + plane_or_line).0;
    }

    #[inline(always)]
    fn at(&self, y: DVec3) -> f64 {
        // Not below zero but for rounding.
        y.dot(self.a().times(y) + self.b * 2.0) + self.c
    }

    /// The same about a point that is `step` away.
    fn moved(&self, step: DVec3) -> Self {
        Self { a: self.a, b: self.b + self.a().times(step), c: self.at(step).max(0.0) }
    }
}

impl Accumulated {
    /// Of all points of a surface.
    pub(super) fn new(surface: &Surface) -> Self {
        let mut new = Self { of: vec![Quadric::default(); surface.points.len()] };
        new.sum_up(surface);
        new
    }

    /// Adds the planes of the faces that are there.
    fn sum_up(&mut self, surface: &Surface) {
        for i in (0..surface.faces.len() as u32).filter(|&i| surface.is_alive(i)) {
            let normal = surface.normal(i as usize);
            let length = normal.length();
            let plane = Symmetric::outer(normal, if length > 0.0 { 1.0 / length } else { 0.0 });
            for h in 4 * i..4 * i + 3 {
                let point = surface.start(h);
                self.of[point as usize].add(plane);
                if surface.twin(h) == NONE {
                    let end = surface.end(h);
                    let line = Symmetric::line(surface.at(end) - surface.at(point), BOUNDARY);
                    self.of[point as usize].add(line);
                    self.of[end as usize].add(line);
                }
            }
        }
    }
}

impl Cost for Accumulated {
    type Line = Queue;

    const PATIENCE: u32 = 4;

    #[inline(always)]
    fn prefetch(&self, point: u32) {
        prefetch(&self.of[point as usize..]);
    }

    #[inline(always)]
    fn price(&self, surface: &Surface, h: u32) -> Offer {
        let [p, q] = [surface.start(h), surface.end(h)].map(|point| &self.of[point as usize]);
        let form = |edge| (p.a() + q.a(), q.a().times(edge) - p.b - q.b);
        cheapest(surface, h, form, |y, z| (p.at(y) + q.at(z)).max(0.0))
    }

    fn forget(&mut self, surface: &Surface) {
        let points = surface.points.iter().zip(&mut self.of);
        points.filter(|(point, _)| point.out != NONE).for_each(|(_, of)| *of = Quadric::default());
        self.sum_up(surface);
    }

    #[cfg(test)]
    fn bytes(&self) -> usize {
        self.of.capacity() * size_of::<Quadric>()
    }

    fn merged(&mut self, _: &Surface, _: &Ring, merge: &Merge) {
        let [p, q] = [merge.kept, merge.gone].map(|point| self.of[point as usize]);
        let [p, q] = [p.moved(merge.place - merge.from[0]), q.moved(merge.place - merge.from[1])];
        self.of[merge.kept as usize] = Quadric { a: (p.a() + q.a()).0, b: p.b + q.b, c: p.c + q.c };
    }
}
