//! What the nodes that wait to be cut hold, one node on top of the other.
//!
//! A node's references and events are the last ones. Cut, it leaves the upper child's in their
//! place and has the lower child's on top, which is done with before the upper one is. So the
//! whole build needs no memory of its own for any node.

use super::event::{self, Event, Events, Fate};
use super::reference::Reference;
use super::sah::Split;

/// References and events of clipped boxes.
#[derive(Default)]
pub struct Fresh {
    /// In the order of their numbers.
    pub references: Vec<Reference>,
    /// In any order.
    pub events: Events,
}

/// Where what belongs to a node begins.
#[derive(Clone, Copy, Default)]
pub struct Base {
    /// In the references.
    pub references: usize,
    events: [usize; 3],
}

/// The pile of one thread, and what is needed while its uppermost node is cut.
#[derive(Default)]
pub struct Pile {
    /// References of all nodes.
    pub references: Vec<Reference>,
    /// Sorted in each node; empty if the rule does not ask for them.
    events: Events,
    /// Positions of references that the plane cuts.
    pub clipped: Vec<u32>,
    /// Their parts on both sides.
    pub fresh: [Fresh; 2],
    fates: Vec<Fate>,
    lower: Vec<Reference>,
    lower_events: Vec<Event>,
}

impl Pile {
    /// Of one node.
    pub fn new(references: Vec<Reference>, events: Events) -> Self {
        Self { references, events, ..Self::default() }
    }

    /// References and events of the uppermost node.
    pub fn references(&self, base: &Base) -> (&[Reference], [&[Event]; 3]) {
        let events = [0, 1, 2].map(|axis| &self.events[axis][base.events[axis]..]);
        (&self.references[base.references..], events)
    }

    /// Makes the uppermost node's events, of which there are none yet, as in the nodes below.
    pub fn sort(&mut self, base: &Base, is_solid: impl Fn(&Reference) -> bool) {
        for (i, reference) in self.references[base.references..].iter().enumerate() {
            event::push(&mut self.events, &reference.bounds, is_solid(reference), i);
        }
        for (events, start) in self.events.iter_mut().zip(base.events) {
            events[start..].sort_unstable();
        }
    }

    /// Removes the uppermost node.
    pub fn take_off(&mut self, base: &Base) {
        self.references.truncate(base.references);
        for (events, start) in self.events.iter_mut().zip(base.events) {
            events.truncate(start);
        }
    }

    /// The uppermost node, on a pile of its own.
    pub fn split_off(&mut self, base: &Base) -> Self {
        let mut events = Events::default();
        for (axis, own) in events.iter_mut().enumerate() {
            *own = self.events[axis].split_off(base.events[axis]);
        }
        Self::new(self.references.split_off(base.references), events)
    }

    /// Decides where the uppermost node's references go; returns how many go whole to either
    /// side. The rest is listed.
    pub fn judge(&mut self, base: &Base, split: &Split) -> [u32; 2] {
        let mut counts = [0; 3];
        let judge = |reference: &Reference| {
            let side = reference.side(split);
            counts[side] += 1;
            Fate::new(side, counts[side] - 1)
        };
        self.fates.clear();
        self.fates.extend(self.references[base.references..].iter().map(judge));
        self.clipped.clear();
        self.clipped.resize(counts[2] as usize + 1, 0);
        let mut last = 0;
        for (i, fate) in self.fates.iter().enumerate() {
            self.clipped[last] = (base.references + i) as u32;
            last += usize::from(fate.side() == 2);
        }
        self.clipped.truncate(last);
        [counts[0], counts[1]]
    }

    /// Puts the lower child on top of the upper one, as judged, and both with their fresh parts;
    /// returns where the lower child begins. Only those that `need` them get events.
    pub fn divide(&mut self, base: &Base, need: [bool; 2]) -> Base {
        let start = base.references;
        self.lower.clear();
        let mut upper = start;
        for (i, fate) in self.fates.iter().enumerate() {
            let reference = self.references[start + i];
            match fate.side() {
                0 => self.lower.push(reference),
                1 => {
                    self.references[upper] = reference;
                    upper += 1;
                }
                _ => {}
            }
        }
        self.references.truncate(upper);
        let [below, above] = &mut self.fresh;
        self.references.append(&mut above.references);
        let mut begin = Base { references: self.references.len(), events: [0; 3] };
        self.references.extend_from_slice(&self.lower);
        self.references.append(&mut below.references);
        for axis in 0..3 {
            let events = &mut self.events[axis];
            let (below, above) = (&mut below.events[axis], &mut above.events[axis]);
            if need != [false; 2] {
                event::hand_down(events, base.events[axis], &self.fates, &mut self.lower_events);
            }
            if need[1] {
                event::merge(events, base.events[axis], above);
            }
            begin.events[axis] = events.len();
            if need[0] {
                events.extend_from_slice(&self.lower_events);
                event::merge(events, begin.events[axis], below);
            }
            below.clear();
            above.clear();
        }
        begin
    }
}
