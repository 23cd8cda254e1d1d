//! The run: the cheapest edge is drawn together if nothing breaks, until few enough are left.
//!
//! Prices are not kept up to date. A step makes its neighbours dearer as a rule, so that what is
//! queued is too cheap if it is wrong; an edge whose turn comes is priced anew and put back if it
//! is dearer than that.

use crate::collapse::build::Built;
use crate::collapse::cost::{Cost, Merge, Offer};
use crate::collapse::queue::Line;
use crate::collapse::ring::Ring;
use crate::collapse::surface::{NONE, Surface, next, previous};
use crate::collapse::wedges::{Wedges, Where};
use common::math::{DVec3, Vec3};
use common::simd::prefetch;

/// How many turns before its own the face of an edge is asked for …
const FACE_AHEAD: usize = 24;
/// … and what is known of its ends.
const POINTS_AHEAD: usize = 12;

/// What share of the faces is left when what was before is forgotten, again and again.
const MEMORY: f64 = 0.7;

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
    /// So many faces are left when it is time to forget.
    forget_at: usize,
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
            forget_at: share(surface.alive, MEMORY),
            surface,
        };
        run.cost.price_all(&run.surface, |h, cost| run.queue.push(h, C::Line::turn(cost)));
        run
    }

    /// Goes on until at most `target` faces are left; false if no step is left before.
    pub(super) fn until(&mut self, target: usize) -> bool {
        while self.surface.alive > target {
            let steps = self.steps_until(target);
            let Some((h, turn)) = self.queue.pop(steps) else { return false };
            self.look_ahead();
            if self.surface.alive <= self.forget_at {
                self.cost.forget(&self.surface);
                self.forget_at = share(self.surface.alive, MEMORY);
            }
            if !self.surface.is_alive(h >> 2) {
                continue;
            }
            let offer = self.cost.price(&self.surface, h);
            let now = C::Line::turn(offer.cost);
            if now > C::Line::bear(turn, C::PATIENCE) {
                self.queue.push(h, now);
            } else {
                self.try_step(h, turn, &offer);
            }
        }
        true
    }

    /// How many steps there are to so many faces, or to when it is time to forget.
    #[inline(always)]
    fn steps_until(&self, target: usize) -> usize {
        self.surface.alive.saturating_sub(target.max(self.forget_at)) / 2
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
        ring.look(surface, h);
        let at = place.as_dvec3() * surface.scale;
        let place_of = (!self.copies.is_empty()).then_some(|point| self.original(point));
        if ring.keeps_topology(surface, h, place_of) && ring.keeps_shape(surface, at) {
            let now = C::Line::turn(offer.cost + C::lost(&ring, from, at));
            if now > C::Line::bear(turn, C::PATIENCE) {
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
            renew(next(spoke));
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

/// The last of the points that each point went into.
pub(super) fn roots(parent: &[u32]) -> Vec<u32> {
    let mut root = parent.to_vec();
    for point in 0..root.len() {
        let mut last = root[point];
        while root[last as usize] != last {
            last = root[last as usize];
        }
        // Whoever passes here later has a short way.
        let mut at = point;
        while root[at] != last {
            at = std::mem::replace(&mut root[at], last) as usize;
        }
    }
    root
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collapse::accumulated::Accumulated;
    use crate::collapse::against;
    use crate::collapse::against::CELL;
    use crate::collapse::build::build;
    use crate::collapse::lattice::Grid;
    use crate::collapse::melax::Curvature;
    use crate::collapse::memoryless::Memoryless;

    /// Bytes of a surface.
    fn of_surface(surface: &Surface) -> usize {
        surface.faces.capacity() * size_of_val(&surface.faces[0])
            + surface.points.capacity() * size_of_val(&surface.points[0])
    }

    /// Bytes for each triangle that are held at once by the mesh's points, the original surface, a run, and
    /// what looks for faces that are against the original.
    fn bytes<C: Cost>(n: u32, cost: impl Fn(&Surface) -> C) -> f64 {
        let height = |i: u32| ((i % 97) * (i % 89)) as f32 / 8633.0;
        let places: Vec<Vec3> =
            (0..n * n).map(|i| Vec3::new((i % n) as f32, height(i), (i / n) as f32)).collect();
        let square = |i: u32| [[i, i + n, i + 1], [i + 1, i + n, i + n + 1]];
        let triangles = (0..n * (n - 1)).filter(|i| i % n < n - 1).flat_map(square);
        let built = build(&places, triangles);
        let count = built.surface.faces.len();
        let mut run = Run::new(built.clone(), None, cost);
        let full = |run: &Run<C>| {
            let points = run.parent.capacity() * 4 + run.cut.capacity() + run.copies.capacity() * 4;
            of_surface(&run.surface) + points + run.queue.bytes() + run.cost.bytes()
        };
        let before = full(&run);
        run.until(count / 10);
        let looking = against::bytes(&Grid::new(&built.surface, CELL), run.surface.alive);
        let original = of_surface(&built.surface) + built.cut.capacity() + size_of_val(&places[..]);
        (before.max(full(&run)) + original + looking) as f64 / count as f64
    }

    #[test]
    fn no_more_than_250_bytes_are_held_for_a_triangle() {
        let all = [bytes(300, Memoryless::new), bytes(300, Accumulated::new), bytes(300, |_| Curvature)];
        // A run that held less than its faces would not have been counted right.
        assert!(all.iter().all(|&bytes| (64.0..250.0).contains(&bytes)), "{all:?}");
    }
}
