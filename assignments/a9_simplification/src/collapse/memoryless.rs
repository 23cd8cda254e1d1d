//! Memoryless quadrics.

use crate::collapse::engine::{Cost, Offer};
use crate::collapse::quadric::Symmetric;
use crate::collapse::surface::{NONE, Surface, previous};
use crate::collapse::knob::knob;
use common::math::DVec3;

pub(super) struct Memoryless {
    of: Vec<Symmetric>,
    fresh: Vec<bool>,
    pub weight: f64,
    pub boundary: f64,
    pub tikhonov: f64,
    pub shape: f64,
}

impl Memoryless {
    pub(super) fn new(surface: &Surface) -> Self {
        Self {
            of: vec![Symmetric::default(); surface.points.len()],
            fresh: vec![false; surface.points.len()],
            weight: knob("W", 1.0),
            boundary: knob("BND", 1.0),
            tikhonov: knob("TIK", 1e-9),
            shape: knob("SHAPE", 0.0),
        }
    }

    #[inline(always)]
    fn refresh(&mut self, surface: &Surface, point: u32) {
        if self.fresh[point as usize] {
            return;
        }
        self.fresh[point as usize] = true;
        let from = surface.at(point);
        let first = surface.points[point as usize].out;
        let mut spoke = first;
        let mut side = surface.at(surface.end(spoke)) - from;
        let mut sum = Symmetric::default();
        if surface.twin(first) == NONE {
            sum += self.line(side);
        }
        loop {
            let incoming = previous(spoke);
            let following = surface.at(surface.start(incoming)) - from;
            let normal = side.cross(following);
            let n2 = normal.length_squared();
            if n2 > 0.0 {
                let n = n2.sqrt();
                let w = if self.weight == 1.0 { 1.0 / n } else if self.weight == 0.5 { 1.0 / (n * n.sqrt()) } else { n2.powf(0.5 * self.weight - 1.0) };
                sum += Symmetric::outer(normal, w);
            }
            side = following;
            spoke = surface.twin(incoming);
            if spoke == first {
                break;
            }
            if spoke == NONE {
                sum += self.line(side);
                break;
            }
        }
        self.of[point as usize] = sum;
    }

    /// Squared distances to a line, times the length squared.
    fn line(&self, e: DVec3) -> Symmetric {
        let e2 = e.length_squared();
        let k = self.boundary * if self.weight == 1.0 { 1.0 } else { e2.powf(self.weight - 1.0) };
        let mut q = Symmetric::outer(e, -k);
        q.add_diagonal(k * e2);
        q
    }
}

impl Cost for Memoryless {
    fn price(&mut self, surface: &Surface, h: u32) -> Offer {
        let (a, b) = (surface.start(h), surface.end(h));
        self.refresh(surface, a);
        self.refresh(surface, b);
        let (qa, qb) = (&self.of[a as usize], &self.of[b as usize]);
        let from = surface.at(a);
        let e = surface.at(b) - from;
        let mut sum = *qa + *qb;
        let trace = sum.trace();
        let eps = self.tikhonov * trace;
        sum.add_diagonal(eps);
        let right = qb.times(e) + e * (0.5 * eps);
        let y = sum.solve(right);
        let z = y - e;
        let mut cost = qa.square(y) + qb.square(z);
        let mut place = from + y;
        if !(y.length_squared() < 4.0 * e.length_squared() && z.length_squared() < 4.0 * e.length_squared()) {
            let candidates = [0.0, 0.5, 1.0].map(|t| {
                let y = e * t;
                (qa.square(y) + qb.square(y - e), y)
            });
            let best = candidates.iter().min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
            cost = best.0;
            place = from + best.1;
        }
        cost += self.shape * trace * e.length_squared();
        Offer { cost, place }
    }

    fn collapsed(&mut self, surface: &Surface, kept: u32, _gone: u32) {
        self.fresh[kept as usize] = false;
        for h in surface.fan(kept) {
            self.fresh[surface.end(h) as usize] = false;
            self.fresh[surface.start(previous(h)) as usize] = false;
        }
    }
}
