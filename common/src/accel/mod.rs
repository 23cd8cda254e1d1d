//! The seam that every acceleration structure fills, and its first implementer, the list.
//!
//! All structures answer with the same bits: the primitive test decides, equal t goes to the
//! lowest primitive number, and a structure only chooses which primitives to ask. [`List`] asks
//! all of them, and stays the oracle for every other.

mod list;

pub use list::{Job, List};

use crate::counters::Counters;
use crate::geometry::{Geometry, Hit};
use crate::math::{Bounds, Interval};
use crate::ray::Ray;

/// Finds what rays hit.
pub trait Accel: Sync {
    /// The first hit with t inside `interval`: smallest t, then lowest primitive number.
    fn nearest(&self, ray: &Ray, interval: Interval, counters: &mut Counters) -> Option<Hit>;

    /// Whether anything is hit with t inside `interval`: the same as `nearest(…).is_some()`, but
    /// free to stop at the first hit it meets.
    fn any(&self, ray: &Ray, interval: Interval, counters: &mut Counters) -> bool;

    /// The first hits of many rays, in their order. Structures that follow several rays at a time
    /// gain where neighbours in the slice run alongside each other.
    ///
    /// # Panics
    /// If the slices differ in length.
    fn nearest_many(
        &self,
        rays: &[Ray],
        interval: Interval,
        hits: &mut [Option<Hit>],
        counters: &mut Counters,
    ) {
        assert_eq!(rays.len(), hits.len());
        for (ray, hit) in rays.iter().zip(hits) {
            *hit = self.nearest(ray, interval, counters);
        }
    }

    /// Whether each of many rays hits anything, in their order.
    ///
    /// # Panics
    /// If the slices differ in length.
    fn any_many(&self, rays: &[Ray], interval: Interval, hit: &mut [bool], counters: &mut Counters) {
        assert_eq!(rays.len(), hit.len());
        for (ray, hit) in rays.iter().zip(hit) {
            *hit = self.any(ray, interval, counters);
        }
    }

    /// The geometry that it was built for.
    fn geometry(&self) -> &Geometry;

    /// The box of everything finite in it; `None` if there is nothing finite.
    fn bounds(&self) -> Option<Bounds> {
        self.geometry().bounds()
    }

    /// Checks every invariant of the structure.
    ///
    /// # Errors
    /// The first invariant that does not hold, in words.
    fn validate(&self) -> Result<(), String>;
}
