//! The run: the cheapest edge is drawn together if nothing breaks, until few enough are left.
//!
//! Prices are not kept up to date. A step makes its neighbours dearer as a rule, so that what is
//! queued is too cheap if it is wrong; an edge whose turn comes is priced anew and put back if it
//! is dearer than that.

use crate::collapse::build::Built;
use crate::collapse::cost::{Cost, Merge, Offer};
use crate::collapse::queue::Line;
use crate::collapse::rim::Rim;
use crate::collapse::ring::Ring;
use crate::collapse::surface::{NONE, Surface, next, previous};
use crate::collapse::wedges::{Wedges, Where};
use common::math::{DVec3, Vec3};
use common::simd::prefetch;

/// How many turns before its own the face of an edge is asked for …
const FACE_AHEAD: usize = 24;
/// … and what is known of its ends.
const POINTS_AHEAD: usize = 12;

/// What share of the faces is left when what was before is forgotten, again and again …
const MEMORY: f64 = 0.7;
/// … and when it is for the first time: of the original much is still there.
const FIRST_MEMORY: f64 = 0.49;

/// What share of the faces has to be gone before all edges that are left are worth another look.
const WORTHWHILE: usize = 1024;

/// When it is somebody's turn.
type Turn<C> = <<C as Cost>::Line as Line>::Turn;

/// A surface that is being simplified.
#[derive(Clone)]
pub(super) struct Run<C: Cost> {
    pub surface: Surface,
    /// For every point itself or one that it went into.
    pub parent: Vec<u32>,
    /// Whether a point is where the surface was cut; such points stay.
    pub cut: Vec<bool>,
    /// For the copies of points, which come after all others, the points they are copies of.
    pub copies: Vec<u32>,
    pub wedges: Option<Wedges>,
    cost: C,
    queue: C::Line,
    ring: Ring,
    rim: Rim,
    /// So many faces are left when it is time to forget.
    forget_at: usize,
    /// So many were left when all edges were priced last.
    asked_at: usize,
    /// How many drawers dearer than thought an edge may be now and still not be put back.
    patience: u32,
}

impl<C: Cost> Run<C> {
    /// Prices every edge.
    pub(super) fn new(built: Built, wedges: Option<Wedges>, cost: impl Fn(&Surface) -> C) -> Self {
        let Built { surface, copies, cut } = built;
        let mut run = Self {
            queue: C::Line::new(surface.faces.len() * 4),
            parent: (0..surface.points.len() as u32).collect(),
            cut,
            copies,
            wedges,
            cost: cost(&surface),
            ring: Ring::default(),
            rim: Rim::default(),
            forget_at: share(surface.alive, FIRST_MEMORY),
            asked_at: surface.alive,
            patience: C::EARLY_PATIENCE,
            surface,
        };
        run.cost.price_all(&run.surface, |h, cost| run.queue.push(h, C::Line::turn(cost)));
        run
    }

    /// Goes on until at most `target` faces are left; false if no step is left before.
    pub(super) fn until(&mut self, target: usize) -> bool {
        while self.surface.alive > target {
            let steps = self.steps_until(target);
            let Some((h, turn)) = self.queue.pop(steps).or_else(|| self.again(steps)) else { return false };
            self.look_ahead();
            if self.surface.alive <= self.forget_at {
                self.cost.forget(&self.surface);
                self.forget_at = share(self.surface.alive, MEMORY);
                self.patience = C::PATIENCE;
            }
            if !self.surface.is_alive(h >> 2) {
                continue;
            }
            let offer = self.cost.price(&self.surface, h);
            let now = C::Line::turn(offer.cost);
            if now > C::Line::bear(turn, self.patience) {
                self.queue.push(h, now);
            } else {
                self.try_step(h, turn, &offer);
            }
        }
        true
    }

    /// What was refused may have become possible by what has gone since.
    #[cold]
    fn again(&mut self, steps: usize) -> Option<(u32, Turn<C>)> {
        let gone = self.asked_at - self.surface.alive;
        if !C::IS_QUICK || gone <= self.surface.alive / WORTHWHILE {
            return None;
        }
        self.asked_at = self.surface.alive;
        self.cost.price_all(&self.surface, |h, cost| self.queue.push(h, C::Line::turn(cost)));
        self.queue.pop(steps)
    }

    /// How many steps there are to so many faces, or to when it is time to forget.
    #[inline(always)]
    fn steps_until(&self, target: usize) -> usize {
        self.surface.alive.saturating_sub(target.max(self.forget_at)) / 2
    }

    /// Lets go of what only steps need.
    pub(super) fn let_go_of_prices(&mut self) {
        self.queue = C::Line::new(0);
        self.cost.let_go();
    }

    /// Lets go of what is left, of which there is a snapshot.
    pub(super) fn let_go_of_surface(&mut self) {
        (self.surface.faces, self.surface.points) = (Vec::new(), Vec::new());
    }

    /// The original point that a point stands for.
    pub(super) fn original(&self, point: u32) -> u32 {
        let originals = self.parent.len() - self.copies.len();
        (point as usize).checked_sub(originals).map_or(point, |copy| self.copies[copy])
    }

    #[inline(always)]
    fn look_ahead(&self) {
        let surface = &self.surface;
        if let Some(h) = self.queue.ahead(FACE_AHEAD) {
            prefetch(&surface.faces[(h >> 2) as usize..]);
        }
        if let Some(h) = self.queue.ahead(POINTS_AHEAD) {
            for point in [surface.start(h), surface.end(h)] {
                prefetch(&surface.points[point as usize..]);
                self.cost.prefetch(point);
            }
        }
    }

    /// What may not be drawn together leaves the queue until something near it changes; a tip waits for its turn.
    fn try_step(&mut self, h: u32, turn: Turn<C>, offer: &Offer) {
        let surface = &self.surface;
        let ends = [surface.start(h), surface.end(h)];
        if ends.iter().any(|&end| self.cut[end as usize]) {
            return;
        }
        let from = ends.map(|end| surface.at(end));
        let place = match self.wedges.as_ref().map_or(Where::Anywhere, |wedges| wedges.place(surface, h)) {
            Where::Anywhere => surface.round(self.cost.place(surface, h, offer)),
            Where::Start => surface.points[ends[0] as usize].at,
            Where::End => surface.points[ends[1] as usize].at,
            Where::Nowhere => return,
        };
        let mut ring = std::mem::take(&mut self.ring);
        if C::IS_QUICK && self.copies.is_empty() && self.rim.surely_keeps(surface, h, place) {
            self.step(h, place, from, &ring);
            self.queue_around(ends[0], turn);
            self.ring = ring;
            return;
        }
        ring.look(surface, h);
        let at = place.as_dvec3() * surface.scale;
        let place_of = (!self.copies.is_empty()).then_some(|point| self.original(point));
        if ring.keeps_topology(surface, h, place_of) && ring.keeps_shape(surface, at) {
            let now = C::Line::turn(offer.cost + C::lost(&ring, from, at));
            if now > C::Line::bear(turn, self.patience) {
                self.queue.push(h, now);
            } else {
                self.step(h, place, from, &ring);
                self.queue_around(ends[0], turn);
            }
        }
        self.ring = ring;
    }

    /// Draws an edge together at a place; `ring` is what was around its ends, which were at `from`.
    #[inline(always)]
    fn step(&mut self, h: u32, place: Vec3, from: [DVec3; 2], ring: &Ring) {
        let [kept, gone] = [self.surface.start(h), self.surface.end(h)];
        let at = place.as_dvec3() * self.surface.scale;
        if let Some(wedges) = &mut self.wedges {
            let edge = from[1] - from[0];
            let along = (at - from[0]).dot(edge) / edge.length_squared();
            wedges.merge(&self.surface, h, along.clamp(0.0, 1.0) as f32);
        }
        self.surface.collapse(h, place);
        self.parent[gone as usize] = kept;
        self.cost.merged(&self.surface, ring, &Merge { kept, gone, from, place: at });
    }

    /// The edges around a point have other prices now.
    fn queue_around(&mut self, point: u32, turn: Turn<C>) {
        let (surface, cost) = (&self.surface, &self.cost);
        let mut renew = |h: u32| {
            let twin = surface.twin(h);
            let other = Some(twin).filter(|twin| *twin != NONE);
            self.queue.renew(h, other, turn, || cost.price(surface, h).cost);
            twin
        };
        let first = surface.points[point as usize].out;
        let mut spoke = first;
        renew(first);
        loop {
            // What is opposite has the price that it had; but if it has been refused, it may be possible now.
            if !C::IS_QUICK {
                renew(next(spoke));
            }
            // On the way to the next face; the last edge of a closed fan is its first.
            let last = previous(spoke);
            spoke = surface.twin(last);
            if spoke == first {
                return;
            }
            renew(last);
            if spoke == NONE {
                return;
            }
        }
    }
}

fn share(count: usize, share: f64) -> usize {
    (count as f64 * share) as usize
}

#[cfg(test)]
mod tests;
