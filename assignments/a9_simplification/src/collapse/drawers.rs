//! Drawers for costs, one for each eighth of an octave.

/// Bits of the mantissa that count.
const FINENESS: u32 = 3;
/// How many drawers there are for positive, finite `f32`.
const DRAWERS: usize = 255 << FINENESS;

/// A drawer of costs; less is cheaper.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Drawer(u32);

/// Entries in drawers.
#[derive(Clone)]
pub(super) struct Drawers {
    entries: Vec<Vec<u32>>,
    /// All before this are empty.
    lowest: usize,
}

impl Drawer {
    /// That of what is not a number.
    pub(super) const LAST: Self = Self(DRAWERS as u32 - 1);

    /// That of what costs nothing.
    pub(super) const FIRST: Self = Self(0);

    /// So many drawers further on.
    #[inline(always)]
    pub(super) fn dearer(self, by: u32) -> Self {
        Self(self.0 + by)
    }

    /// The drawer for a cost; what is not a number goes to the last.
    #[inline(always)]
    pub(super) fn of(cost: f64) -> Self {
        // The last octave holds infinities and NaN.
        let bits = (cost.max(0.0) as f32).to_bits() >> (23 - FINENESS);
        if cost.is_nan() { Self::LAST } else { Self(bits).min(Self::LAST) }
    }
}

impl Default for Drawers {
    fn default() -> Self {
        Self { entries: vec![Vec::new(); DRAWERS], lowest: DRAWERS }
    }
}

impl Drawers {
    /// At the end of a drawer.
    #[inline(always)]
    pub(super) fn put(&mut self, entry: u32, drawer: Drawer) {
        let drawer = drawer.0 as usize;
        self.entries[drawer].push(entry);
        self.lowest = self.lowest.min(drawer);
    }

    /// The cheapest that is not empty and not after `last`.
    pub(super) fn cheapest(&mut self, last: Drawer) -> Option<Drawer> {
        while self.lowest <= last.0 as usize {
            if !self.entries[self.lowest].is_empty() {
                return Some(Drawer(self.lowest as u32));
            }
            self.lowest += 1;
        }
        None
    }

    /// How many entries there are in a drawer.
    pub(super) fn count(&self, drawer: Drawer) -> usize {
        self.entries[drawer.0 as usize].len()
    }

    /// Takes all entries out of a drawer.
    pub(super) fn empty(&mut self, drawer: Drawer) -> impl Iterator<Item = u32> {
        std::mem::take(&mut self.entries[drawer.0 as usize]).into_iter()
    }

    /// Puts other entries in the place of those of a drawer, and those in theirs.
    pub(super) fn exchange(&mut self, drawer: Drawer, entries: &mut Vec<u32>) {
        std::mem::swap(entries, &mut self.entries[drawer.0 as usize]);
    }

    #[cfg(test)]
    pub(super) fn bytes(&self) -> usize {
        let entries: usize = self.entries.iter().map(Vec::capacity).sum();
        entries * size_of::<u32>() + self.entries.capacity() * size_of::<Vec<u32>>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drawers_are_an_eighth_of_an_octave() {
        let costs = (0..8000).map(|i| 1e-6 * 1.003f64.powi(i));
        let mut last = (0.0, Drawer::of(0.0));
        for cost in costs {
            let drawer = Drawer::of(cost);
            assert!(drawer >= last.1);
            if drawer != last.1 {
                assert!(last.0 == 0.0 || cost / last.0 < 1.13, "{cost}");
                last = (cost, drawer);
            }
        }
    }
}
