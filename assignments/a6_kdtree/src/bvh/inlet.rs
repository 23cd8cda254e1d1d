//! Where rays join those that wait for a stream.

use super::packet::RAYS;
use super::pool::Pool;

/// Where some of all rays join those that wait.
pub struct Inlet<'p> {
    /// Those that wait.
    pub pool: &'p mut Pool,
    /// Which of all rays is the first at hand …
    pub first: usize,
    /// … and how far behind it the others are, if they are not one after the other.
    pub numbers: &'p [u32],
}

impl Inlet<'_> {
    /// Which of all rays those at hand are from `first` on, up to the eighth or the last of `rays`,
    /// which is repeated.
    #[inline(always)]
    pub fn eight(&self, first: usize, rays: usize) -> [u32; RAYS] {
        let number = |lane: usize| {
            let ray = first + lane.min(rays - 1);
            let behind = if self.numbers.is_empty() { ray as u32 } else { self.numbers[ray] };
            self.first as u32 + behind
        };
        [number(0), number(1), number(2), number(3), number(4), number(5), number(6), number(7)]
    }
}
