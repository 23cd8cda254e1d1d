//! A5T2: from cell to cell along a ray.
//!
//! The three-dimensional digital differential analyser of Amanatides & Woo (1987), with two
//! changes. The next crossing is worked out anew from the plane's position, never by adding a
//! step to the last one, so nothing accumulates. And where two crossings are too close for
//! `f64` to order, they are ordered exactly: the cells visited are those of exact arithmetic,
//! each once, and a ray through an edge or corner steps across it diagonally.

use crate::Cells;
use common::math::Interval;
use common::math::exact::Crossing;
use common::ray::Ray;
use std::cmp::Ordering;

/// One cell on the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Which cell.
    pub cell: [usize; 3],
    /// The ray is inside from here …
    pub enter: f64,
    /// … to here.
    pub exit: f64,
    /// The axis across which the cell was entered; `None` if the ray starts inside it.
    pub axis: Option<usize>,
}

/// An iterator over the cells that a ray passes through, in order.
pub struct March<'c> {
    cells: &'c Cells,
    origin: [f64; 3],
    direction: [f64; 3],
    inverse: [f64; 3],
    /// t at which each axis leaves the current cell; +∞ if the ray runs along the planes.
    next: [f64; 3],
    cell: [usize; 3],
    enter: f64,
    axis: Option<usize>,
    done: bool,
}

impl<'c> March<'c> {
    /// Starts where the ray enters the box, or at its origin if that is inside and the interval
    /// begins there. `None` if the ray passes the box by, or is not usable.
    pub fn new(cells: &'c Cells, ray: &Ray, interval: Interval) -> Option<Self> {
        if !ray.is_usable() {
            return None;
        }
        let direction = ray.direction.as_dvec3().to_array();
        let mut march = Self {
            cells,
            origin: ray.origin.as_dvec3().to_array(),
            direction,
            inverse: direction.map(|d| 1.0 / d),
            next: [f64::INFINITY; 3],
            cell: [0; 3],
            enter: 0.0,
            axis: None,
            done: false,
        };
        let forward = interval.min >= 0.0;
        if forward && (0..3).all(|a| march.low(a) <= march.origin[a] && march.origin[a] <= march.high(a)) {
            (0..3).for_each(|a| march.cell[a] = march.cell_of_origin(a));
        } else if !march.start_at_entry(forward) {
            return None;
        }
        (0..3).for_each(|a| march.next[a] = march.leaving(a));
        Some(march)
    }

    #[inline]
    fn low(&self, axis: usize) -> f64 {
        self.cells.planes[axis][0]
    }

    #[inline]
    fn high(&self, axis: usize) -> f64 {
        self.cells.planes[axis][self.cells.count[axis]]
    }

    /// Where the ray meets a plane; a difference, an inverse and a product, so three roundings.
    #[inline]
    fn crossing(&self, axis: usize, plane: f64) -> Crossing {
        let (origin, direction) = (self.origin[axis], self.direction[axis]);
        Crossing { plane, origin, direction, t: (plane - origin) * self.inverse[axis] }
    }

    /// The plane through which the ray leaves the current cell along one axis.
    #[inline]
    fn plane_ahead(&self, axis: usize) -> f64 {
        self.cells.planes[axis][self.cell[axis] + usize::from(self.direction[axis] > 0.0)]
    }

    /// When it does so.
    #[inline]
    fn leaving(&self, axis: usize) -> f64 {
        if self.direction[axis] == 0.0 {
            return f64::INFINITY;
        }
        (self.plane_ahead(axis) - self.origin[axis]) * self.inverse[axis]
    }

    /// The cell along one axis that the origin is in; on a plane between two, the one the ray
    /// goes into.
    fn cell_of_origin(&self, axis: usize) -> usize {
        let (planes, n) = (&self.cells.planes[axis], self.cells.count[axis]);
        let origin = self.origin[axis];
        let behind = match self.direction[axis] < 0.0 {
            true => planes[..n].partition_point(|p| *p < origin),
            false => planes[..n].partition_point(|p| *p <= origin),
        };
        behind.max(1) - 1
    }

    /// The cell behind the point where the ray enters the box. False if it passes the box by,
    /// or if the box lies behind the origin of a ray that only looks forward.
    fn start_at_entry(&mut self, forward: bool) -> bool {
        let Some((axis, entry)) = self.entry() else { return false };
        for a in 0..3 {
            if self.direction[a] == 0.0 {
                if self.origin[a] < self.low(a) || self.origin[a] > self.high(a) {
                    return false;
                }
                self.cell[a] = self.cell_of_origin(a);
                continue;
            }
            let far = if self.direction[a] > 0.0 { self.high(a) } else { self.low(a) };
            let exit = self.crossing(a, far);
            if exit.order(&entry) == Ordering::Less || (forward && exit.t < 0.0) {
                return false;
            }
        }
        for a in (0..3).filter(|&a| self.direction[a] != 0.0) {
            self.cell[a] = self.cell_after(a, &entry);
        }
        (self.enter, self.axis) = (entry.t, Some(axis));
        true
    }

    /// The last of the sides that face the ray to be crossed, and its axis.
    fn entry(&self) -> Option<(usize, Crossing)> {
        let sides = (0..3).filter(|&a| self.direction[a] != 0.0).map(|a| {
            let near = if self.direction[a] > 0.0 { self.low(a) } else { self.high(a) };
            (a, self.crossing(a, near))
        });
        sides.reduce(|last, side| if side.1.order(&last.1) == Ordering::Greater { side } else { last })
    }

    /// The cell along `axis` that the ray is in just after `entry`: as many planes lie behind
    /// as are crossed no later than it. Guessed from the position, then put right exactly.
    fn cell_after(&self, axis: usize, entry: &Crossing) -> usize {
        let (planes, last) = (&self.cells.planes[axis], self.cells.count[axis] - 1);
        let crossed = |p: usize| self.crossing(axis, planes[p]).order(entry) != Ordering::Greater;
        let position = self.origin[axis] + self.direction[axis] * entry.t;
        let share = (position - planes[0]) / (planes[last + 1] - planes[0]);
        let mut cell = ((share * (last + 1) as f64) as usize).min(last);
        if self.direction[axis] > 0.0 {
            while cell < last && crossed(cell + 1) {
                cell += 1;
            }
            while cell > 0 && !crossed(cell) {
                cell -= 1;
            }
        } else {
            while cell > 0 && crossed(cell) {
                cell -= 1;
            }
            while cell < last && !crossed(cell + 1) {
                cell += 1;
            }
        }
        cell
    }

    /// Which axes cross first, as bits: more than one only if they cross exactly together.
    #[inline]
    fn first(&self) -> (f64, u32) {
        let [x, y, z] = self.next;
        let least = x.min(y).min(z);
        let near = least + least.abs() * 2f64.powi(-49);
        let close = u32::from(x <= near) | u32::from(y <= near) << 1 | u32::from(z <= near) << 2;
        if close.is_power_of_two() { (least, close) } else { (least, self.exactly_first(close)) }
    }

    #[cold]
    fn exactly_first(&self, close: u32) -> u32 {
        let candidates = || (0..3).filter(|a| close >> a & 1 == 1);
        let ahead = |a: usize| self.crossing(a, self.plane_ahead(a));
        let first = |a: usize| candidates().all(|b| ahead(a).order(&ahead(b)) != Ordering::Greater);
        candidates().filter(|&a| first(a)).fold(0, |bits, a| bits | 1 << a)
    }
}

impl Iterator for March<'_> {
    type Item = Step;

    #[inline(always)]
    fn next(&mut self) -> Option<Step> {
        if self.done {
            return None;
        }
        let (exit, axes) = self.first();
        // Crossings are in order, their rounded t may be an ulp out of it.
        let exit = exit.max(self.enter);
        let step = Step { cell: self.cell, enter: self.enter, exit, axis: self.axis };
        for a in 0..3 {
            if axes >> a & 1 == 0 {
                continue;
            }
            let (cell, forward) = (&mut self.cell[a], self.direction[a] > 0.0);
            if *cell == if forward { self.cells.count[a] - 1 } else { 0 } {
                self.done = true;
                break;
            }
            *cell = if forward { *cell + 1 } else { *cell - 1 };
            self.next[a] = self.leaving(a);
            self.axis = Some(a);
        }
        self.enter = exit;
        Some(step)
    }
}
