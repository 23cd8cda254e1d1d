//! A queue that lets what lies side by side go together.
//!
//! Strictly by cost, one step is here and the next one far away, and each waits for the memory. But as
//! long as everything up to some cost will go anyhow, its order matters only among neighbours: so all drawers
//! of a [`Queue`] that are sure to be emptied are a band, and that is emptied region by region. As the
//! goal comes near, bands become as narrow as a drawer.

use crate::collapse::drawers::{Drawer, Drawers};
use crate::collapse::queue::{Line, Queue};

/// Entries of a region, as a power of two: what is known of them fits into a processor's cache.
const REGION: u32 = 14;

/// How many entries a step takes out of the band: three edges vanish with it. With four, bands hold what had better wait.
const EACH: usize = 3;

/// Entries are numbers below a limit, each at most once in the queue; what is near by number should be near in memory.
#[derive(Clone)]
pub(super) struct Banded {
    /// What is dearer than the band.
    far: Drawers,
    /// The region that is being emptied, and what is dearer in it but in the band.
    near: Queue,
    /// The dearest drawer of the band.
    top: Drawer,
    /// The band, sorted by regions, and how much of it is out.
    band: Vec<(u32, Drawer)>,
    out: usize,
}

impl Line for Banded {
    type Turn = Drawer;

    fn new(limit: usize) -> Self {
        let (far, near) = (Drawers::default(), Queue::new(limit));
        Self { far, near, top: Drawer::of(0.0), band: Vec::new(), out: 0 }
    }

    #[inline(always)]
    fn turn(cost: f64) -> Drawer {
        Queue::turn(cost)
    }

    #[inline(always)]
    fn bear(turn: Drawer, patience: u32) -> Drawer {
        Queue::bear(turn, patience)
    }

    #[inline(always)]
    fn push(&mut self, entry: u32, drawer: Drawer) {
        if drawer > self.top {
            self.near.expect(entry);
            self.far.put(entry, drawer);
        } else {
            self.near.push(entry, drawer);
        }
    }

    #[inline(always)]
    fn pop(&mut self, steps: usize) -> Option<(u32, Drawer)> {
        loop {
            if let Some(popped) = self.near.pop_until(self.top) {
                return Some(popped);
            }
            self.next_region(steps)?;
        }
    }

    #[inline(always)]
    fn ahead(&self, further: usize) -> Option<u32> {
        self.near.ahead(further)
    }

    #[inline(always)]
    fn renew(&mut self, entry: u32, twin: Option<u32>, drawer: Drawer, price: impl FnOnce() -> f64) {
        self.near.renew(entry, twin, drawer, price);
    }

    #[cfg(test)]
    fn bytes(&self) -> usize {
        self.far.bytes() + self.near.bytes() + self.band.capacity() * size_of::<(u32, Drawer)>()
    }
}

impl Banded {
    #[cold]
    #[inline(never)]
    fn next_region(&mut self, steps: usize) -> Option<()> {
        if self.out == self.band.len() {
            self.next_band(steps)?;
        }
        let region = self.band[self.out].0 >> REGION;
        let rest = self.band[self.out..].iter().take_while(|(entry, _)| entry >> REGION == region);
        rest.for_each(|&(entry, drawer)| {
            self.near.push(entry, drawer);
            self.out += 1;
        });
        Some(())
    }

    /// Takes as many drawers as `steps` will empty, but one at least.
    fn next_band(&mut self, steps: usize) -> Option<()> {
        let first = self.far.cheapest(Drawer::LAST)?;
        let (mut band, mut next) = (Vec::new(), Some(first));
        while let Some(drawer) = next {
            self.top = drawer;
            band.extend(self.far.empty(drawer).map(|entry| (entry, drawer)));
            let room = (EACH * steps).saturating_sub(band.len());
            next = self.far.cheapest(Drawer::LAST).filter(|&drawer| self.far.count(drawer) <= room);
        }
        (self.band, self.out) = (by_region(&band, self.near.limit()), 0);
        Some(())
    }
}

/// Sorted by regions, those of one in their order.
fn by_region(band: &[(u32, Drawer)], limit: usize) -> Vec<(u32, Drawer)> {
    let mut first = vec![0usize; (limit >> REGION) + 2];
    for (entry, _) in band {
        first[(entry >> REGION) as usize + 1] += 1;
    }
    for i in 1..first.len() {
        first[i] += first[i - 1];
    }
    let mut sorted = vec![(0, Drawer::of(0.0)); band.len()];
    for &(entry, drawer) in band {
        let slot = &mut first[(entry >> REGION) as usize];
        sorted[*slot] = (entry, drawer);
        *slot += 1;
    }
    sorted
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where in memory and at what cost: two regions, each with costs of 1 and 2, and entries for 100.
    fn filled() -> Banded {
        let mut queue = Banded::new(3 << REGION);
        for (entry, cost) in [(1 << REGION, 2.0), (5, 2.0), (1 << REGION | 1, 1.0), (6, 1.0)] {
            queue.push(entry, Banded::turn(cost));
        }
        [7, 9, 10].into_iter().for_each(|entry| queue.push(entry, Banded::turn(100.0)));
        queue
    }

    fn order(mut queue: Banded, steps: usize) -> Vec<u32> {
        std::iter::from_fn(|| queue.pop(steps)).map(|(entry, _)| entry).collect()
    }

    #[test]
    fn a_band_goes_region_by_region_and_each_by_cost() {
        assert_eq!(order(filled(), 2), [6, 5, 1 << REGION | 1, 1 << REGION, 7, 9, 10]);
    }

    #[test]
    fn near_the_goal_cost_comes_before_region() {
        assert_eq!(order(filled(), 0), [6, 1 << REGION | 1, 5, 1 << REGION, 7, 9, 10]);
    }

    #[test]
    fn what_is_dearer_than_the_band_waits_and_what_is_cheaper_does_not() {
        let mut queue = filled();
        assert_eq!(queue.pop(2), Some((6, Banded::turn(1.0))));
        queue.push(6, Banded::turn(50.0));
        queue.push(8, Banded::turn(1.5));
        queue.renew(6, None, Banded::turn(1.0), || unreachable!());
        assert_eq!(order(queue, 2), [8, 5, 1 << REGION | 1, 1 << REGION, 6, 7, 9, 10]);
    }
}
