//! The run.

use crate::collapse::knob::knob;
use crate::collapse::queue::{Drawer, Queue};
use crate::collapse::ring::{Limits, Ring};
use crate::collapse::surface::{NONE, Surface};
use common::math::DVec3;

#[derive(Clone, Copy)]
pub(super) struct Offer {
    pub cost: f64,
    pub place: DVec3,
}

pub(super) trait Cost {
    fn price(&mut self, surface: &Surface, h: u32) -> Offer;
    fn collapsed(&mut self, surface: &Surface, kept: u32, gone: u32);
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
    limits: Limits,
    pub stats: [usize; 8],
}

impl<C: Cost> Engine<C> {
    pub(super) fn new(built: crate::collapse::build::Built, cost: C) -> Self {
        let q = knob("SLIVER", 0.001);
        let mut engine = Self {
            queue: Queue::new(built.surface.faces.len() * 4),
            parent: (0..built.surface.points.len() as u32).collect(),
            originals: (built.surface.points.len() - built.copies.len()) as u32,
            surface: built.surface,
            cut: built.cut,
            copies: built.copies,
            cost,
            ring: Ring::default(),
            limits: Limits { cos2: knob("COS", 0.2).powi(2), sliver: (q / (2.0 * 3f64.sqrt())).powi(2) },
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

    /// false when stuck
    pub(super) fn run(&mut self, target: usize) -> bool {
        while self.surface.alive > target {
            let Some((h, drawer)) = self.queue.pop() else { return false };
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
            let place = self.surface.round(offer.place);
            let (start, end) = (self.surface.start(h), self.surface.end(h));
            if self.cut[start as usize] || self.cut[end as usize] {
                continue;
            }
            self.ring.look(&self.surface, h);
            let (copies, originals) = (&self.copies, self.originals);
            let canon = |v: u32| if v < originals { v } else { copies[(v - originals) as usize] };
            if !self.ring.keeps_topology(&self.surface, h, canon) {
                self.stats[2] += 1;
                continue;
            }
            if !self.ring.keeps_shape(place.as_dvec3() * self.surface.scale, &self.limits) {
                self.stats[3] += 1;
                continue;
            }
            self.surface.collapse(h, place);
            self.parent[end as usize] = start;
            self.cost.collapsed(&self.surface, start, end);
            for spoke in self.surface.fan(start) {
                for g in [spoke, super::surface::next(spoke), super::surface::previous(spoke)] {
                    let twin = self.surface.twin(g);
                    if !self.queue.contains(g) && (twin == NONE || !self.queue.contains(twin)) {
                        self.stats[4] += 1;
                        self.queue.push(g, drawer);
                    }
                }
            }
        }
        true
    }
}
