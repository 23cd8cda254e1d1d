//! Where boxes begin and end along an axis, in order: the events of the sweep.

use common::math::Bounds;

/// What happens at an event's position. In order: boxes that end come before those that begin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A box ends.
    End = 0,
    /// A box without thickness lies here.
    Planar = 1,
    /// A box begins.
    Start = 2,
}

/// Position, kind, whether it is a solid, and the number of the reference in its node, packed
/// so that comparing the integers sorts by position, then kind: 32, 2, 1 and 29 bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Event(u64);

const SOLID: u64 = 1 << 29;
/// Most references in a node.
pub const MAX_REFERENCES: usize = 1 << 29;
const INDEX: u64 = SOLID - 1;

/// The bits of an `f32` as an integer that sorts the same way; −0 and +0 are one.
fn ordered(x: f32) -> u32 {
    let bits = (x + 0.0).to_bits();
    if bits >> 31 == 1 { !bits } else { bits | 1 << 31 }
}

impl Event {
    fn new(position: f32, kind: Kind, solid: bool, index: usize) -> Self {
        let tag = (u64::from(solid) * SOLID) | (index as u64 & INDEX);
        Self(u64::from(ordered(position)) << 32 | (kind as u64) << 30 | tag)
    }

    /// The position in the order of positions.
    #[inline]
    pub fn place(self) -> u32 {
        (self.0 >> 32) as u32
    }

    /// The coordinate that a place stands for.
    pub fn position(place: u32) -> f32 {
        f32::from_bits(if place >> 31 == 1 { place & !(1 << 31) } else { !place })
    }

    /// 0, 1, 2: an end, a planar box, a start.
    #[inline]
    pub fn kind(self) -> u32 {
        (self.0 >> 30) as u32 & 3
    }

    /// Whether it belongs to a solid.
    #[inline]
    pub fn is_solid(self) -> bool {
        self.0 & SOLID != 0
    }

    /// The number of the reference in its node.
    #[inline]
    pub fn index(self) -> usize {
        (self.0 & INDEX) as usize
    }

    #[inline]
    fn renumbered(self, index: u32) -> Self {
        Self(self.0 & !INDEX | u64::from(index))
    }
}

/// The events of one node along the three axes, each sorted.
pub type Events = [Vec<Event>; 3];

/// Adds the events of a box.
pub fn push(events: &mut Events, bounds: &Bounds, solid: bool, index: usize) {
    for (axis, list) in events.iter_mut().enumerate() {
        let (low, high) = (bounds.min[axis], bounds.max[axis]);
        if low == high {
            list.push(Event::new(low, Kind::Planar, solid, index));
        } else {
            list.push(Event::new(low, Kind::Start, solid, index));
            list.push(Event::new(high, Kind::End, solid, index));
        }
    }
}

/// Where a reference of a node goes: to one child, under a new number there, or (clipped, with
/// new events) to both.
#[derive(Clone, Copy, Debug)]
pub struct Fate(u32);

impl Fate {
    /// Its old events are dropped.
    pub const CLIPPED: Self = Self(3 << 30);

    /// To child 0 or 1.
    pub fn child(side: usize, index: usize) -> Self {
        Self((side as u32) << 30 | index as u32)
    }
}

/// Hands the events of whole references down to the children, still sorted.
pub fn hand_down(events: &[Event], fates: &[Fate]) -> [Vec<Event>; 2] {
    let n = events.len();
    let (mut left, mut right) = (vec![Event::default(); n], vec![Event::default(); n]);
    let (mut lefts, mut rights) = (0, 0);
    // Written to both and counted for one: which side comes next cannot be predicted.
    for event in events {
        let fate = fates[event.index()].0;
        let renumbered = event.renumbered(fate & INDEX as u32);
        left[lefts] = renumbered;
        right[rights] = renumbered;
        lefts += usize::from(fate >> 30 == 0);
        rights += usize::from(fate >> 30 == 1);
    }
    left.truncate(lefts);
    right.truncate(rights);
    [left, right]
}

/// Merges the few events of clipped boxes into the many old ones, both sorted.
pub fn merge(events: &mut Vec<Event>, mut new: Vec<Event>) {
    new.sort_unstable();
    let mut from = events.len();
    events.resize(from + new.len(), Event::default());
    for to in (0..events.len()).rev() {
        match new.last() {
            None => return,
            Some(last) if from == 0 || events[from - 1] < *last => {
                events[to] = *last;
                new.pop();
            }
            Some(_) => {
                from -= 1;
                events[to] = events[from];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a6t1_integers_sort_like_positions() {
        let x = [f32::MIN, -1.0, -1e-40, 0.0, 1e-40, 1.0, f32::MAX];
        assert!(x.windows(2).all(|p| ordered(p[0]) < ordered(p[1])));
        assert!(x.iter().all(|x| Event::position(ordered(*x)) == *x));
        assert_eq!(ordered(-0.0), ordered(0.0));
        let end = Event::new(1.0, Kind::End, true, 9);
        assert!(
            end < Event::new(1.0, Kind::Start, false, 3) && end > Event::new(0.5, Kind::Start, false, 11)
        );
        assert!(end.is_solid() && end.index() == 9 && end.kind() == Kind::End as u32);
    }

    #[test]
    fn a6t1_handing_down_and_merging_keep_the_order() {
        let event = |x: usize, index: usize| Event::new(x as f32, Kind::Start, false, index);
        let events: Vec<Event> = (0..9).map(|x| event(x, x)).collect();
        let fates: Vec<Fate> =
            (0..9).map(|i| if i % 3 == 2 { Fate::CLIPPED } else { Fate::child(i % 3, i / 3) }).collect();
        let [mut left, right] = hand_down(&events, &fates);
        assert_eq!(left, [event(0, 0), event(3, 1), event(6, 2)]);
        assert_eq!(right, [event(1, 0), event(4, 1), event(7, 2)]);
        merge(&mut left, vec![event(8, 4), event(2, 3)]);
        assert_eq!(left, [event(0, 0), event(2, 3), event(3, 1), event(6, 2), event(8, 4)]);
    }
}
