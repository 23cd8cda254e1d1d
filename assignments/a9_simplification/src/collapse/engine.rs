//! The run.

use crate::collapse::build::Built;
use crate::collapse::queue::{Drawer, Queue};
use crate::collapse::ring::Ring;
use crate::collapse::surface::{NONE, Surface, next, previous};
use common::math::DVec3;
use common::simd::prefetch;

#[derive(Clone, Copy)]
pub(super) struct Offer {
    pub cost: f64,
    pub place: DVec3,
}

pub(super) trait Cost {
    fn prefetch(&self, point: u32);
    fn price(&self, surface: &Surface, h: u32) -> Offer;
    fn collapsed(&mut self, surface: &Surface, ring: &Ring, kept: u32);
}

pub(super) struct Engine<C> {
    pub surface: Surface,
    pub parent: Vec<u32>,
    cut: Vec<bool>,
    copies: Vec<u32>,
    originals: u32,
    cost: C,
    queue: Queue,
    ring: Ring,
    pub stats: [usize; 8],
}

impl<C: Cost> Engine<C> {
    pub(super) fn new(built: Built, cost: C) -> Self {
        let mut engine = Self {
            queue: Queue::new(built.surface.faces.len() * 4),
            parent: (0..built.surface.points.len() as u32).collect(),
            originals: (built.surface.points.len() - built.copies.len()) as u32,
            surface: built.surface,
            cut: built.cut,
            copies: built.copies,
            cost,
            ring: Ring::default(),
            stats: [0; 8],
        };
        for face in 0..engine.surface.faces.len() as u32 {
            for h in 4 * face..4 * face + 3 {
                let twin = engine.surface.twin(h);
                if twin == NONE || h < twin {
                    let offer = engine.cost.price(&engine.surface, h);
                    engine.queue.push(h, Drawer::of(offer.cost));
                }
            }
        }
        engine
    }

    #[inline(always)]
    fn look_ahead(&self) {
        let surface = &self.surface;
        if let Some(h) = self.queue.ahead(24) {
            prefetch(&surface.faces[(h >> 2) as usize..]);
        }
        if let Some(h) = self.queue.ahead(12) {
            for p in [surface.start(h), surface.end(h)] {
                prefetch(&surface.points[p as usize..]);
                self.cost.prefetch(p);
            }
        }
    }

    /// false when stuck
    pub(super) fn run(&mut self, target: usize) -> bool {
        while self.surface.alive > target {
            let Some((h, drawer)) = self.queue.pop() else { return false };
            self.look_ahead();
            if !self.surface.is_alive(h >> 2) {
                continue;
            }
            self.stats[0] += 1;
            let offer = self.cost.price(&self.surface, h);
            let now = Drawer::of(offer.cost);
            if now > drawer {
                self.stats[1] += 1;
                self.queue.push(h, now);
                continue;
            }
            self.try_collapse(h, drawer, &offer);
        }
        true
    }

    fn try_collapse(&mut self, h: u32, drawer: Drawer, offer: &Offer) {
        let place = self.surface.round(offer.place);
        let (start, end) = (self.surface.start(h), self.surface.end(h));
        if self.cut[start as usize] || self.cut[end as usize] {
            return;
        }
        self.ring.look(&self.surface, h);
        let (copies, originals) = (&self.copies, self.originals);
        let place_of = |v: u32| if v < originals { v } else { copies[(v - originals) as usize] };
        if !self.ring.keeps_topology(&self.surface, h, place_of) {
            self.stats[2] += 1;
            return;
        }
        if !self.ring.keeps_shape(&self.surface, place.as_dvec3() * self.surface.scale) {
            self.stats[3] += 1;
            return;
        }
        self.surface.collapse(h, place);
        self.parent[end as usize] = start;
        self.cost.collapsed(&self.surface, &self.ring, start);
        let mut spoke = self.surface.points[start as usize].out;
        let first = spoke;
        loop {
            for g in [spoke, next(spoke), previous(spoke)] {
                let twin = self.surface.twin(g);
                if !self.queue.contains(g) && (twin == NONE || !self.queue.contains(twin)) {
                    self.stats[4] += 1;
                    self.queue.push(g, drawer);
                }
            }
            spoke = self.surface.turn(spoke);
            if spoke == first || spoke == NONE {
                break;
            }
        }
    }
}
