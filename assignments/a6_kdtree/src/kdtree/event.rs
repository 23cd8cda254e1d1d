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
    #[inline(always)]
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
    /// To child 0 or 1; 2: its old events are dropped.
    #[inline]
    pub fn new(side: usize, index: u32) -> Self {
        Self((side as u32) << 30 | index)
    }

    /// 0 or 1, or 2 if it is clipped.
    #[inline]
    pub fn side(self) -> usize {
        (self.0 >> 30) as usize
    }
}

/// Leaves the events of whole references that go to the upper child where they are, from `start`
/// on, and appends those of the lower child to `lower`; both stay sorted.
pub fn hand_down(events: &mut Vec<Event>, start: usize, fates: &[Fate], lower: &mut Vec<Event>) {
    let list = &mut events[start..];
    lower.clear();
    lower.resize(list.len(), Event::default());
    let (mut lowers, mut uppers) = (0, 0);
    // Written to both and counted for one: which side comes next cannot be predicted.
    for i in 0..list.len() {
        let fate = fates[list[i].index()];
        let renumbered = list[i].renumbered(fate.0 & INDEX as u32);
        lower[lowers] = renumbered;
        list[uppers] = renumbered;
        lowers += usize::from(fate.side() == 0);
        uppers += usize::from(fate.side() == 1);
    }
    lower.truncate(lowers);
    events.truncate(start + uppers);
}

/// Merges the few events of clipped boxes, `new`, into the many old ones from `start` on, which
/// are sorted; leaves `new` empty.
pub fn merge(events: &mut Vec<Event>, start: usize, new: &mut Vec<Event>) {
    new.sort_unstable();
    let (mut from, mut left) = (events.len() - start, new.len());
    events.resize(events.len() + left, Event::default());
    let list = &mut events[start..];
    while left > 0 && from > 0 {
        let (old, fresh) = (list[from - 1], new[left - 1]);
        let later = old < fresh;
        list[from + left - 1] = if later { fresh } else { old };
        left -= usize::from(later);
        from -= usize::from(!later);
    }
    list[..left].copy_from_slice(&new[..left]);
    new.clear();
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
        let fates: Vec<Fate> = (0..9).map(|i| Fate::new(i % 3, i as u32 / 3)).collect();
        let (mut events, mut lower) = ([vec![event(9, 5)], events].concat(), Vec::new());
        hand_down(&mut events, 1, &fates, &mut lower);
        assert_eq!(lower, [event(0, 0), event(3, 1), event(6, 2)]);
        assert_eq!(events, [event(9, 5), event(1, 0), event(4, 1), event(7, 2)]);
        merge(&mut events, 1, &mut vec![event(8, 4), event(2, 3)]);
        assert_eq!(events[1..], [event(1, 0), event(2, 3), event(4, 1), event(7, 2), event(8, 4)]);
        merge(&mut events, 1, &mut vec![event(0, 5)]);
        assert_eq!(events[..3], [event(9, 5), event(0, 5), event(1, 0)]);
    }
}
